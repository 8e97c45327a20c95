// Its entry starts with another number.
#include <dsc/plugin/entry.hpp>

#include "tripwire.hpp"

static void enroll(dsc::plugin::Registrar&) { std::abort(); }

static constexpr dsc::plugin::PluginEntry wrong() {
    dsc::plugin::PluginEntry entry =
        dsc::plugin::make_entry(&enroll, "bad_magic", "1.0.0", "MIT", "Wrong on purpose");
    entry.magic = 0x21435344U;
    return entry;
}

constinit const dsc::plugin::PluginEntry dsc_plugin_entry = wrong();
