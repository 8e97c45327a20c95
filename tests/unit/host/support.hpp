#pragma once
// What the tests of the host share.

#include <filesystem>
#include <string>

#include <dsc/base/error.hpp>
#include <dsc/host/host.hpp>

namespace support {

/// A library of tests/plugins, without symbolic links: "good" is .../libdsc_good.so.
std::filesystem::path fixture(const std::string& name);

/// A folder of its own below the system's temporary folder, removed at the end.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    /// Copies a fixture into the folder; only the owner may write the copy.
    std::filesystem::path copy(const std::string& name) const;
    /// Writes a file of these bytes.
    std::filesystem::path write(const std::string& name, const std::string& bytes) const;

private:
    std::filesystem::path path_;
};

struct Refusal {
    std::string code;
    std::string text;
};

/// How a new host refuses the file; both texts are empty if it takes it.
Refusal refusal(const std::filesystem::path& file);

std::string read(const std::filesystem::path& file);

}  // namespace support
