#pragma once
// Works with standard streams of any kind: closed, full, a pipe without a reader, or a file of
// another program.

#include <iosfwd>
#include <string_view>

namespace dsc::app {

/// To be called before any file is opened. A closed descriptor of 0 to 2 becomes /dev/null, so that
/// no file of ours ever gets its number and what is written to it is dropped. The data of the
/// command, data_out(), goes to the stdout that the caller gave; all else in this process that
/// writes to descriptor 1, such as a plugin or its library, writes to stderr. A pipe whose reader
/// has closed does not end a job. [setup]
void take_standard_streams();

/// The data of the command, buffered. [setup]
std::ostream& data_out();

/// Writes the buffered data. Throws IoError "io.write" if it cannot be written. If the reader of
/// the pipe has closed, the process ends by SIGPIPE, as it does for any other program. [setup]
void flush_data();

/// Writes text on stderr. Text that cannot be written is dropped: a log never ends a job.
/// [parallel]
void tell(std::string_view text) noexcept;

/// Whether stderr is a terminal that can rewrite a line; false for TERM=dumb. [setup]
bool stderr_rewrites();

/// Number of columns of the terminal on stderr; 80 if it is unknown. [setup]
unsigned stderr_columns();

}  // namespace dsc::app
