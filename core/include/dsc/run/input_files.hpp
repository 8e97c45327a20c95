#pragma once
// The files that a command reads, each from the disk once.

#include <dsc/cloud/cloud.hpp>
#include <dsc/cloud/read.hpp>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dsc::run {

/// A cloud and what reading it met.
struct ReadCloud {
    cloud::Cloud cloud;
    cloud::ReadReport report;
};

/// Remembers what was read. A file that changes while the command runs is used as it was at the first call.
class InputFiles {
public:
    /// SHA-256 of the file's content. The content of a cloud's file stays in memory until its points are asked for. Throws what
    /// read_file() does. [setup]
    const std::string& sha256(const std::filesystem::path& file);

    /// The points of a cloud's file, which stay here until they are taken. Throws what cloud::read_cloud() does. [setup]
    const ReadCloud& cloud(const std::filesystem::path& file, const std::vector<std::string>& columns);

    /// The same, handed over; a later call reads the file again. [setup]
    ReadCloud take_cloud(const std::filesystem::path& file, const std::vector<std::string>& columns);

private:
    struct Entry {
        std::string sha256{};
        std::optional<std::string> content{};
        std::optional<ReadCloud> cloud{};
        std::vector<std::string> columns{};  ///< that the cloud was read by
    };

    Entry& entry(const std::filesystem::path& file);

    std::map<std::filesystem::path, Entry> entries_;  ///< by the path without links
};

}  // namespace dsc::run
