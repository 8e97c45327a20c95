#pragma once
// Plugins that are scripts: the part that runs the scripts of a language registers itself here, and
// the host asks it.

#include <filesystem>
#include <memory>
#include <string>

#include <dsc/plugin/catalogue.hpp>
#include <dsc/plugin/registrar.hpp>

namespace dsc::plugin {

/// Runs scripts. [setup]
class ScriptLoader {
public:
    virtual ~ScriptLoader();
    /// Runs the script `file`, registers the strategies that it defines, and returns what the
    /// script declares about itself. Each call runs it again. Throws PluginError "plugin.script".
    virtual PluginInfo load(const std::filesystem::path& file, Registrar& registrar) = 0;
};

/// Whether the file is a script by its extension: ".py". [parallel]
bool is_script(const std::filesystem::path& file);

/// Sets the loader of this process. [setup]
void set_script_loader(std::shared_ptr<ScriptLoader> loader);
/// The loader of this process; null if there is none. [setup]
std::shared_ptr<ScriptLoader> script_loader();

}  // namespace dsc::plugin
