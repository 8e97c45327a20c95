#include "plugin_project.hpp"

#include <algorithm>
#include <cctype>
#include <map>

#include <fmt/core.h>

#include <dsc/base/error.hpp>
#include <dsc/base/version.hpp>
#include <dsc/io/atomic_file.hpp>
#include <dsc/plugin/entry.hpp>
#include <dsc/text/words.hpp>

#include "plugin_templates.hpp"
#include "temporary_folder.hpp"

namespace dsc::app {
namespace {

namespace fs = std::filesystem;

using Values = std::map<std::string, std::string, std::less<>>;

/// my_flow becomes MyFlow.
std::string in_camel_case(std::string_view name) {
    std::string out;
    bool begins = true;
    for (const char c : name) {
        if (c == '_') {
            begins = true;
            continue;
        }
        out += begins ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
        begins = false;
    }
    return out;
}

/// The kind at the end avoids conflicts with macros and with the names of the hooks.
std::string class_name(const std::string& name, plugin::Kind kind) {
    const std::string ending = in_camel_case(plugin::kind_name(kind));
    std::string out = in_camel_case(name);
    const bool ends_so = out.size() > ending.size() &&
                         out.compare(out.size() - ending.size(), ending.size(), ending) == 0;
    return ends_so ? out : out + ending;
}

/// Replaces @NAME@ and similar words by their values. Throws if a word between two @ is not the
/// name of a value.
std::string filled(const EmbeddedFile& file, const Values& values) {
    std::string out;
    std::string_view rest = file.text;
    for (std::size_t at = rest.find('@'); at != std::string_view::npos; at = rest.find('@')) {
        const std::size_t end = rest.find('@', at + 1);
        const auto value = end == std::string_view::npos
                               ? values.end()
                               : values.find(rest.substr(at + 1, end - at - 1));
        if (value == values.end()) {
            throw Error(ExitCode::internal, "internal.template",
                        fmt::format("template {}", file.path),
                        "it contains an @ that does not belong to a value",
                        "please report it with the command");
        }
        out.append(rest.substr(0, at)).append(value->second);
        rest.remove_prefix(end + 1);
    }
    return out.append(rest);
}

}  // namespace

void require_plugin_name(const std::string& name) {
    constexpr std::size_t longest = sizeof(plugin::PluginEntry::name) - 1;
    if (text::is_id(name) && name.size() <= longest) return;
    throw UsageError(
        "usage.plugin_name", "dsc plugin new",
        fmt::format("'{}' cannot be the name of a plugin", name),
        fmt::format("use at most {} lower case letters, digits and _, with a letter first",
                    longest));
}

std::vector<ProjectFile> plugin_project(const std::string& name, plugin::Kind kind) {
    Values values = {
        {"NAME", name}, {"CLASS", class_name(name, kind)}, {"DSC_VERSION", DSC_VERSION}};
    const std::string own = std::string(plugin::kind_name(kind)) + "/";
    for (const EmbeddedFile& file : plugin_templates()) {
        if (file.path == own + "page.md") values["PAGE"] = filled(file, values);
    }
    std::vector<ProjectFile> files;
    for (const EmbeddedFile& file : plugin_templates()) {
        const std::size_t slash = file.path.find('/');
        const std::string_view folder = file.path.substr(0, slash + 1);
        const std::string_view base = file.path.substr(slash + 1);
        if ((folder == own && base != "page.md") || folder == "shared/")
            files.push_back({std::string(base), filled(file, values)});
    }
    std::sort(files.begin(), files.end(),
              [](const ProjectFile& a, const ProjectFile& b) { return a.name < b.name; });
    return files;
}

void write_project(const fs::path& place, const std::vector<ProjectFile>& files) {
    const TemporaryFolder beside(place.parent_path(), "." + place.filename().string());
    const fs::path whole = beside.path() / place.filename();
    std::error_code error;
    fs::create_directory(whole, error);
    for (const ProjectFile& file : files) io::write_file(whole / file.name, file.text);
    fs::rename(whole, place, error);
    if (error) {
        throw IoError("io.write", place.string(), "",
                      fmt::format("cannot be created ({})", error.message()),
                      "use another name or another folder");
    }
}

}  // namespace dsc::app
