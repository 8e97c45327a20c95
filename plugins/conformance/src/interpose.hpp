#pragma once
// Replaces functions of the C library and of the C++ runtime for the rest of this process. Only
// processes that run one test do this.

#include <span>

namespace dsc::conformance {

struct Replacement {
    const char* symbol;  ///< as the linker sees it
    void* function;
};

/// Whatever loaded library, or the program, calls one of these symbols by its name from now on
/// calls the replacement; libraries that are loaded later are not changed. Calls inside the C
/// library stay as they are. [setup]
void interpose(std::span<const Replacement> replacements);

}  // namespace dsc::conformance
