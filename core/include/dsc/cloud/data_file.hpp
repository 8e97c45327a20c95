#pragma once
// Finds the data files that come with the project.

#include <filesystem>
#include <string_view>

namespace dsc::cloud {

/// Path of share/data/NAME. Looked for in the folder named by the environment variable DSC_SHARE (if set, only there),
/// then beside the running library or program (../share/dsc), then in the source tree of the build.
/// Throws IoError "io.data_file" naming the places tried. [setup]
std::filesystem::path data_file(std::string_view name);

}  // namespace dsc::cloud
