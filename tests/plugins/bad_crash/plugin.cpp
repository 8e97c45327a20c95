// Follows a null pointer while it is loaded.
#include "velocity.hpp"

namespace {
struct NullReader {
    NullReader() {
        const volatile int* volatile nowhere = nullptr;
        value = *nowhere;
    }
    int value = 0;
};
[[maybe_unused]] const NullReader reader;
}  // namespace

DSC_PLUGIN("bad_crash", "1.0.0", "MIT", "crashes when it is loaded") {
    registrar.add<Still>("still", "does not move");
}
