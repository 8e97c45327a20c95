// Nothing to call.
#include <dsc/plugin/entry.hpp>

constinit const dsc::plugin::PluginEntry dsc_plugin_entry =
    dsc::plugin::make_entry(nullptr, "bad_no_enroll", "1.0.0", "MIT", "Has no enroll function");
