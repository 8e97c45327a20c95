#pragma once
// The files below share/template/plugin, part of the program: an installation may be moved anywhere.

#include <span>
#include <string_view>

namespace dsc::app {

struct TemplateFile {
    std::string_view path;  ///< "velocity/strategy.cpp"
    std::string_view text;
};

/// All of them, sorted by path. The build writes its source.
std::span<const TemplateFile> plugin_templates();

}  // namespace dsc::app
