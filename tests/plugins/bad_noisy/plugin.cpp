// Witness of lib.scan: prints while it is loaded.
#include <cstdio>

#include "velocity.hpp"

DSC_PLUGIN("bad_noisy", "1.0.0", "MIT", "Prints when it is loaded") {
    std::puts("thank you for loading me");
    registrar.add<Still>("still", "does not move");
}
