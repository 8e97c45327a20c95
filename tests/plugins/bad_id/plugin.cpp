// The id cannot be written in an experiment.
#include "velocity.hpp"

DSC_PLUGIN("bad_id", "1.0.0", "MIT", "Has a malformed id") {
    registrar.add<Still>("Stand-Still", "does not move");
}
