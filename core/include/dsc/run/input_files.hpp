#pragma once
// The files that a command reads; each is read from the disk once.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <dsc/cloud/cloud.hpp>
#include <dsc/cloud/read.hpp>

namespace dsc::run {

/// A cloud and what the reader found.
struct ReadCloud {
    cloud::Cloud cloud;
    cloud::ReadReport report;
};

/// Remembers what was read. If a file changes while the command runs, its content at the first call
/// is used.
class InputFiles {
public:
    /// SHA-256 of the file's content. The content of a cloud file is kept in memory until its
    /// points are requested. Throws what read_file() throws. [setup]
    const std::string& sha256(const std::filesystem::path& file);

    /// The points of a cloud file; this object keeps them until take_cloud(). Throws what
    /// cloud::read_cloud() throws. [setup]
    const ReadCloud& cloud(const std::filesystem::path& file,
                           const std::vector<std::string>& columns);

    /// The same, moved to the caller; a later call reads the file again. [setup]
    ReadCloud take_cloud(const std::filesystem::path& file,
                         const std::vector<std::string>& columns);

private:
    struct Entry {
        std::string sha256{};
        std::optional<std::string> content{};
        std::optional<ReadCloud> cloud{};
        std::vector<std::string> columns{};  ///< columns with which the cloud was read
    };

    Entry& entry(const std::filesystem::path& file);

    std::map<std::filesystem::path, Entry> entries_;  ///< by path without symbolic links
};

}  // namespace dsc::run
