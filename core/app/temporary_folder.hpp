#pragma once
// A folder that is removed together with its owner.

#include <filesystem>
#include <string>

namespace dsc::app {

class TemporaryFolder {
public:
    /// Creates it in the system's folder for temporary files. Throws IoError "io.temporary".
    TemporaryFolder();
    /// Creates it in `parent`; its name begins with `name`. Throws IoError "io.folder".
    TemporaryFolder(const std::filesystem::path& parent, const std::string& name);
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const noexcept { return path_; }
    /// Keeps the folder.
    void keep() noexcept { kept_ = true; }

private:
    std::filesystem::path path_;
    bool kept_ = false;
};

}  // namespace dsc::app
