// Witness of lib.entry: a version that is none.
#include "velocity.hpp"

DSC_PLUGIN("bad_version", "first", "MIT", "Has a version that cannot be compared") {
    registrar.add<Still>("still", "does not move");
}
