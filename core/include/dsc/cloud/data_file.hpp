#pragma once
// Finds the data files that come with the project.

#include <filesystem>
#include <string_view>

namespace dsc::cloud {

/// Path of the file data/NAME in the project's shared folder. That folder is the value of the
/// environment variable DSC_SHARE if it is set; else ../share/dsc relative to the folder of the
/// running program; else share/ of the source tree of the build. Throws IoError "io.data_file" with
/// the places that were searched. [setup]
std::filesystem::path data_file(std::string_view name);

}  // namespace dsc::cloud
