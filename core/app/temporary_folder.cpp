#include "temporary_folder.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include <fmt/format.h>

#include <dsc/base/error.hpp>

namespace dsc::app {

TemporaryFolder::TemporaryFolder() {
    std::error_code error;
    const std::filesystem::path parent = std::filesystem::temp_directory_path(error);
    std::string pattern = ((error ? std::filesystem::path(".") : parent) / "dsc-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) {
        throw IoError("io.temporary", pattern, "", "a temporary folder cannot be created there",
                      "set TMPDIR to a writable folder");
    }
    path_ = pattern;
}

TemporaryFolder::TemporaryFolder(const std::filesystem::path& parent, const std::string& name) {
    std::string pattern = (parent / (name + "-XXXXXX")).string();
    if (mkdtemp(pattern.data()) == nullptr) {
        throw IoError("io.folder", parent.string(), "",
                      fmt::format("no folder can be created there ({})", std::strerror(errno)),
                      "change to a writable folder");
    }
    path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
    if (kept_) return;
    std::error_code error;
    std::filesystem::remove_all(path_, error);
}

}  // namespace dsc::app
