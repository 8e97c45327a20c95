#pragma once
// What is tried in a process of its own: how the child keeps to itself, and what the parent learns of its end.

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

namespace dsc::host {

/// In the child, first of all: it dies with its parent, leaves no core file, reads nothing, writes its standard output and
/// error to `output`, and every signal does what the system does with it. [setup]
void keep_to_itself(int output);

/// In the child: false where the parent does not read any more. [setup]
bool write_all(int to, std::string_view bytes);

/// How far a read came: all of it, the other end was closed before, or the time was over before.
enum class ReadEnd { all, closed, late };

/// In the parent: exactly `size` bytes. [setup]
ReadEnd read_all(int from, void* data, std::size_t size, std::chrono::steady_clock::time_point until);
/// In the parent: all that comes until the other end is closed; `closed`, or `late`. [setup]
ReadEnd read_to_end(int from, std::string& bytes, std::chrono::steady_clock::time_point until);

/// In the parent: waits for the child and returns its status as waitpid() gives it. [setup]
int wait_for(int process);
/// "signal 11 (Segmentation fault)" for a status with a signal, else "exit code 3".
std::string end_text(int status);

}  // namespace dsc::host
