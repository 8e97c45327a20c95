// Registers nothing.
#include "velocity.hpp"

DSC_PLUGIN("bad_empty", "1.0.0", "MIT", "Has no strategy") {}
