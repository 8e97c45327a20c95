// Made for the ABI before this one.
#include <dsc/plugin/entry.hpp>

#include "tripwire.hpp"

static void enroll(dsc::plugin::Registrar&) { std::abort(); }

static constexpr dsc::plugin::PluginEntry wrong() {
    dsc::plugin::PluginEntry entry =
        dsc::plugin::make_entry(&enroll, "bad_abi_old", "1.0.0", "MIT", "Wrong on purpose");
    entry.abi_major = DSC_ABI_MAJOR - 1;
    return entry;
}

constinit const dsc::plugin::PluginEntry dsc_plugin_entry = wrong();
