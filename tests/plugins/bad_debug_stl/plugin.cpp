// Compiled with _GLIBCXX_DEBUG: the containers of the standard library are laid out in another way.
#include <dsc/plugin/entry.hpp>

#include "tripwire.hpp"

DSC_PLUGIN("bad_debug_stl", "1.0.0", "MIT", "Built in another way") { std::abort(); }
