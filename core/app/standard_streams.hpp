#pragma once
// The three standard streams of any kind: closed, full, a pipe without a reader, or a file of another program.

#include <iosfwd>
#include <string_view>

namespace dsc::app {

/// To be called before anything is opened. A closed descriptor of 0 to 2 becomes /dev/null, so that no file of ours ever gets
/// its number and what is written to it is dropped. The data of the command, data_out(), goes to the stdout that the caller
/// gave; all else in this process that writes to descriptor 1, such as a plugin or its library, writes to stderr. A pipe
/// whose reader has gone ends no job. [setup]
void take_standard_streams();

/// The data of the command, buffered. [setup]
std::ostream& data_out();

/// Writes what is buffered. Throws IoError "io.write" where it cannot be written. Where the reader of the pipe has gone, the
/// process ends by SIGPIPE, as it does for any other program. [setup]
void flush_data();

/// Writes text on stderr. Text that cannot be written is dropped: a log never decides over a job. [parallel]
void tell(std::string_view text) noexcept;

/// Whether stderr is a terminal that can rewrite a line: not one of TERM=dumb. [setup]
bool stderr_rewrites();

/// Columns of the terminal that stderr is; 80 where it does not tell. [setup]
unsigned stderr_columns();

}  // namespace dsc::app
