// Its own name is malformed.
#include "velocity.hpp"

DSC_PLUGIN("Bad Name", "1.0.0", "MIT", "Has a name with a blank") {
    registrar.add<Still>("named", "does not move");
}
