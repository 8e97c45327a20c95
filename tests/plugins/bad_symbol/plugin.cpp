// Needs a function that no library has.
#include "velocity.hpp"

extern "C" int dsc_test_missing_function();

DSC_PLUGIN("bad_symbol", "1.0.0", "MIT", "Does not link") {
    if (dsc_test_missing_function() == 0) registrar.add<Still>("unlinked", "does not move");
}
