// The symbol is there, but it is four bytes long.
#include "tripwire.hpp"

extern "C" __attribute__((visibility("default"))) const unsigned dsc_plugin_entry;
const unsigned dsc_plugin_entry = 0x31435344U;
