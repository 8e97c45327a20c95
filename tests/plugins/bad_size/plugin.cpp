// Its entry has another size than the host's.
#include <dsc/plugin/entry.hpp>

#include "tripwire.hpp"

static void enroll(dsc::plugin::Registrar&) { std::abort(); }

static constexpr dsc::plugin::PluginEntry wrong() {
    dsc::plugin::PluginEntry entry =
        dsc::plugin::make_entry(&enroll, "bad_size", "1.0.0", "MIT", "Wrong on purpose");
    entry.struct_size -= 8;
    return entry;
}

constinit const dsc::plugin::PluginEntry dsc_plugin_entry = wrong();
