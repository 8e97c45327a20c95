#pragma once
// Child processes for trials: how the child is isolated, and what the parent learns about its end.

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

namespace dsc::host {

/// To be called first in the child: it ends with its parent, writes no core file, reads nothing,
/// writes its standard output and error to `output`, and every signal has the default action of the
/// system. [setup]
void keep_to_itself(int output);

/// In the child: writes; returns false if the parent no longer reads. [setup]
bool write_all(int to, std::string_view bytes);

/// The result of a read: everything was read, the other end was closed before, or the time limit
/// was reached before.
enum class ReadEnd { all, closed, late };

/// In the parent: reads exactly `size` bytes. [setup]
ReadEnd read_all(int from, void* data, std::size_t size,
                 std::chrono::steady_clock::time_point until);
/// In the parent: reads until the other end is closed; returns `closed` or `late`. [setup]
ReadEnd read_to_end(int from, std::string& bytes, std::chrono::steady_clock::time_point until);

/// In the parent: waits for the child and returns its status as waitpid() gives it. [setup]
int wait_for(int process);
/// "signal 11 (Segmentation fault)" for a status with a signal, else "exit code 3".
std::string end_text(int status);

}  // namespace dsc::host
