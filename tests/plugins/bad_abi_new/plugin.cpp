// Needs what a later minor version of the ABI added.
#include <dsc/plugin/entry.hpp>

#include "tripwire.hpp"

static void enroll(dsc::plugin::Registrar&) { std::abort(); }

static constexpr dsc::plugin::PluginEntry wrong() {
    dsc::plugin::PluginEntry entry =
        dsc::plugin::make_entry(&enroll, "bad_abi_new", "1.0.0", "MIT", "Wrong on purpose");
    entry.abi_minor = DSC_ABI_MINOR + 1;
    return entry;
}

constinit const dsc::plugin::PluginEntry dsc_plugin_entry = wrong();
