// Witness of lib.twice: knows whether it has been loaded before.
#include "velocity.hpp"

DSC_PLUGIN("bad_once", "1.0.0", "MIT", "Registers less the second time") {
    static bool first = true;
    registrar.add<Still>("still", "does not move");
    if (first) registrar.add<Still>("still_too", "does not move either");
    first = false;
}
