// Ends the program that loads it.
#include <cstdlib>

#include "velocity.hpp"

DSC_PLUGIN("bad_exit", "1.0.0", "MIT", "ends the program when it is loaded") {
    registrar.add<Still>("still", "does not move");
    std::_Exit(0);
}
