#pragma once
// A strategy may crash during a run. The user must learn which one, and keep what was reached.

#include <vector>

#include <dsc/plugin/catalogue.hpp>

namespace dsc::app {

/// From now on SIGSEGV, SIGBUS, SIGFPE, SIGILL and SIGABRT end the process like this: one message
/// names plugin, strategy, call and step; the folders of the runs say "failed" and keep the last
/// good state; the exit code is 4, or 1 if neither a strategy nor a plugin caused it. With the
/// environment variable DSC_CORE_DUMP=1 the process then ends by the signal, so that the system
/// writes a core file. Does nothing in a build with a sanitizer, which reports crashes itself.
/// To be called by the main thread, before plugins are loaded and again with them. [setup]
void guard_crashes(std::vector<plugin::PluginInfo> plugins);

}  // namespace dsc::app
