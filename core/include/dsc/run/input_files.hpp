#pragma once
// The files that a command reads, each once, and clouds and texts in memory that take the place of
// files.

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <dsc/cloud/cloud.hpp>
#include <dsc/cloud/read.hpp>

namespace dsc::run {

/// A cloud and what the reader found.
struct ReadCloud {
    cloud::Cloud cloud;
    cloud::ReadReport report;
};

/// Begins the names of what is only in memory. No file has such a name.
inline constexpr std::string_view memory_folder = "/memory";

/// Whether the name is one of something in memory. [parallel]
bool is_memory(const std::filesystem::path& file);

/// Remembers what was read. If a file changes while the command runs, its content at the first call
/// is used.
class InputFiles {
public:
    /// Makes a cloud in memory readable as the file that is returned, "/memory/NAME". Its SHA-256
    /// is that of the little-endian doubles of the points, then of the normals if there are any,
    /// then of the bytes of the colours. [setup]
    std::filesystem::path add_cloud(const std::string& name, cloud::Cloud cloud);
    /// Makes a text in memory known by the name of a file that does not exist. [setup]
    void add_text(const std::filesystem::path& name, const std::string& text);

    /// Whether sha256() would find something: a file, or something in memory. [setup]
    bool exists(const std::filesystem::path& file) const;
    /// Size of the file, or of what is in memory, in bytes. Throws IoError "io.open". [setup]
    std::uintmax_t bytes(const std::filesystem::path& file);

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
        std::vector<std::string> columns{};            ///< columns with which the cloud was read
        std::optional<std::uintmax_t> memory_bytes{};  ///< size of something in memory
    };

    Entry& entry(const std::filesystem::path& file);

    std::map<std::filesystem::path, Entry> entries_;  ///< by path without symbolic links
};

}  // namespace dsc::run
