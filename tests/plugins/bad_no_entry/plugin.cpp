// A library, but no plugin.
#include "tripwire.hpp"

extern "C" __attribute__((visibility("default"))) int dsc_something_else();
int dsc_something_else() { return 1; }
