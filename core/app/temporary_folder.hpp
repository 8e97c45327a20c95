#pragma once
// A folder that is gone when its owner is.

#include <filesystem>

namespace dsc::app {

class TemporaryFolder {
public:
    /// Throws IoError "io.temporary".
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const noexcept { return path_; }

private:
    std::filesystem::path path_;
};

}  // namespace dsc::app
