#pragma once
// The readers behind read_cloud, one a format. Each throws IoError.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <dsc/cloud/read.hpp>

namespace dsc::cloud {

/// Where the check of a header ended.
struct FileCheck {
    std::size_t points = 0;  ///< as the header promises and the file's size allows
    std::vector<std::string> names{};  ///< of the points' properties
    std::optional<Sensor> sensor{};
    std::size_t body = 0;  ///< of a PCD: the byte behind its header
    /// Byte offsets of the words "obj_info" that tell the size of a grid: PCL would believe them.
    std::vector<std::size_t> grid_comments{};
};

/// `names` receives what the columns are called, as far as they have names.
Cloud read_obj(const std::string& file, std::string_view text, std::vector<std::string>& names);
Cloud read_table(const std::string& file, std::string_view text, const ReadOptions& options, std::vector<std::string>& names);

/// Colours as they stand in a text, of which `largest_value` is full light, as bytes.
std::vector<std::array<std::uint8_t, 3>> to_bytes(const std::vector<Vec3>& colours, double largest_value);

/// A coordinate of a text. Throws "io.syntax", "io.non_finite" naming the line.
double coordinate(const std::string& file, std::size_t line, std::string_view word);

/// Refuses a word that is not a number; a decimal comma gets its own remedy.
[[noreturn]] void not_a_number(const std::string& file, std::size_t line, std::string_view word, std::string_view remedy);

/// Prove that a file holds all that its header promises, so that PCL may be trusted with it: PCL allocates
/// what a header asks for and its readers do not all notice a missing end.
FileCheck check_pcd(const std::string& file, std::string_view bytes);
FileCheck check_ply(const std::string& file, std::string_view bytes);

/// Read with PCL what the checks accept. Points with NaN or infinity are left out and counted. A PCD is read header and body apart: PCL's
/// reader of whole files looks for further lines of the header in the body.
Cloud read_pcd(const std::string& file, const std::string& bytes, ReadReport& report, std::vector<std::string>& names);
Cloud read_ply(const std::string& file, std::string bytes, ReadReport& report, std::vector<std::string>& names);

/// Refuses a file without points.
[[noreturn]] void no_points(const std::string& file, std::string_view remedy);

}  // namespace dsc::cloud
