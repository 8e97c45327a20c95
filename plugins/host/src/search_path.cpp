#include "dsc/host/search_path.hpp"

#include <dlfcn.h>

#include <fmt/format.h>

#include <dsc/base/error.hpp>
#include <dsc/plugin/fingerprint.hpp>

namespace dsc::host {
namespace {

namespace fs = std::filesystem;

void add_variable(std::vector<SearchEntry>& entries, const std::string& list) {
    std::size_t begin = 0;
    while (begin <= list.size()) {
        const std::size_t end = std::min(list.find(':', begin), list.size());
        const fs::path path = list.substr(begin, end - begin);
        begin = end + 1;
        if (path.empty()) continue;
        if (path.is_relative()) {
            throw PluginError(
                "plugin.search_path", "DSC_PLUGIN_PATH",
                fmt::format("'{}' is relative, so its meaning would depend on the current folder",
                            path.string()),
                "write an absolute path");
        }
        entries.push_back({path, "DSC_PLUGIN_PATH", true});
    }
}

fs::path user_folder(const config::Environment& environment) {
    const fs::path data = environment("XDG_DATA_HOME").value_or("");
    if (data.is_absolute()) return data / "dsc" / "plugins";
    const fs::path home = environment("HOME").value_or("");
    return home.is_absolute() ? home / ".local" / "share" / "dsc" / "plugins" : fs::path();
}

}  // namespace

fs::path installed_folder() {
    Dl_info info{};
    if (dladdr(plugin::core_address(), &info) == 0 || info.dli_fname == nullptr) return {};
    std::error_code error;
    const fs::path library = fs::canonical(info.dli_fname, error);
    return error ? fs::path() : library.parent_path() / "dsc" / "plugins";
}

std::vector<SearchEntry> search_path(const SearchOptions& options) {
    std::vector<SearchEntry> entries;
    for (const fs::path& path : options.command_line)
        entries.push_back({fs::absolute(path), "--plugin", true});
    for (const fs::path& path : options.experiment) entries.push_back({path, "plugins", true});
    add_variable(entries, options.environment("DSC_PLUGIN_PATH").value_or(""));
    std::error_code error;
    for (const auto& [path, origin] : {std::pair{user_folder(options.environment), "user folder"},
                                       std::pair{installed_folder(), "installed folder"}}) {
        if (!path.empty() && fs::is_directory(path, error))
            entries.push_back({path, origin, false});
    }
    return entries;
}

}  // namespace dsc::host
