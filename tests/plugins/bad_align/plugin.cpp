// Compiled with -mavx: Eigen's types are aligned in another way.
#include <dsc/plugin/entry.hpp>

#include "tripwire.hpp"

DSC_PLUGIN("bad_align", "1.0.0", "MIT", "Built in another way") { std::abort(); }
