#pragma once
// A folder that is gone when its owner is.

#include <filesystem>
#include <string>

namespace dsc::app {

class TemporaryFolder {
public:
    /// In the system's folder for such. Throws IoError "io.temporary".
    TemporaryFolder();
    /// In `parent`, its name beginning with `name`. Throws IoError "io.folder".
    TemporaryFolder(const std::filesystem::path& parent, const std::string& name);
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const noexcept { return path_; }
    /// It stays.
    void keep() noexcept { kept_ = true; }

private:
    std::filesystem::path path_;
    bool kept_ = false;
};

}  // namespace dsc::app
