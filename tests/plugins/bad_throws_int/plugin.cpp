// Fails with something that says nothing.
#include "velocity.hpp"

DSC_PLUGIN("bad_throws_int", "1.0.0", "MIT", "Throws a number") { throw 42; }
