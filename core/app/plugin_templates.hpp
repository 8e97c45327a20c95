#pragma once
// The files in share/template/plugin, which are part of the program.

#include <span>

#include <dsc/base/embedded_file.hpp>

namespace dsc::app {

/// All of them, sorted by path. The build writes its source.
std::span<const EmbeddedFile> plugin_templates();

}  // namespace dsc::app
