#pragma once
// Memory for the input of a strategy, with memory behind it that nobody may use: who reads beyond
// the end of the input ends the test at that moment, and the report names the input.

#include <functional>
#include <string>
#include <string_view>

namespace dsc::conformance {

/// From now on input is guarded in this process, and `on_fault` is called for a read or write
/// beyond an input, with what happened: "it uses memory beyond the end of the positions of the
/// surface, in evaluate at step 1". It must end the process. Does nothing in a build with a
/// sanitizer, which finds such faults itself. To be called only in a process that runs one test.
/// [setup]
void guard_input(void (*on_fault)(const std::string& what));
bool input_is_guarded();

/// During the lifetime of the object the memory that this thread requests is guarded: it ends where
/// the guard begins, and is never used again after it is freed. [setup]
class GuardedMemory {
public:
    GuardedMemory();
    ~GuardedMemory();
    GuardedMemory(const GuardedMemory&) = delete;
    GuardedMemory& operator=(const GuardedMemory&) = delete;
};

/// The result of `make`, in guarded memory.
template <class Make>
auto in_guarded_memory(const Make& make) {
    const GuardedMemory guarded;
    return make();
}

/// Names the memory that begins at `data`; `name` must exist as long as the process. [setup]
void name_memory(const void* data, const char* name);

}  // namespace dsc::conformance
