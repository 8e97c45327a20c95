// Compiled with the address sanitizer, whose runtime would end a process that lacks it.
#include <dsc/plugin/entry.hpp>

#include "tripwire.hpp"

DSC_PLUGIN("bad_sanitizer", "1.0.0", "MIT", "Built in another way") { std::abort(); }
