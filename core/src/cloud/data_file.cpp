// Finds the data files of the project.
#include "dsc/cloud/data_file.hpp"

#include <cstdlib>
#include <string>
#include <vector>

#include <dsc/base/error.hpp>

namespace dsc::cloud {
namespace fs = std::filesystem;

namespace {

/// Folder of the running program; empty if unknown.
fs::path program_folder() {
    std::error_code error;
    const fs::path path = fs::read_symlink("/proc/self/exe", error);
    return error ? fs::path{} : path.parent_path();
}

}  // namespace

fs::path data_file(std::string_view name) {
    std::vector<fs::path> places;
    const char* const chosen = std::getenv("DSC_SHARE");
    if (chosen && *chosen) {
        places.emplace_back(chosen);
    } else {
        const fs::path folder = program_folder();
        if (!folder.empty()) places.push_back(folder.parent_path() / "share/dsc");
        places.emplace_back(DSC_SOURCE_SHARE);
    }
    std::string tried;
    for (const fs::path& place : places) {
        const fs::path path = place / "data" / name;
        std::error_code error;
        if (fs::is_regular_file(path, error)) return path;
        if (tried.find(path.string()) == std::string::npos)
            tried += (tried.empty() ? "" : ", ") + path.string();
    }
    throw IoError("io.data_file", name, "", "this data file of the project is not at " + tried,
                  "set the environment variable DSC_SHARE to the folder that contains data/" +
                      std::string(name));
}

}  // namespace dsc::cloud
