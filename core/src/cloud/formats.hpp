#pragma once
// The readers used by read_cloud, one per format. Each throws IoError.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <dsc/cloud/read.hpp>
#include <dsc/text/reading.hpp>

namespace dsc::cloud {

/// Result of the check of a header.
struct FileCheck {
    std::size_t points = 0;            ///< as the header says and the size of the file allows
    std::vector<std::string> names{};  ///< of the points' properties
    std::optional<Sensor> sensor{};
    std::size_t body = 0;  ///< of a PCD: position of the byte after its header
    /// Byte offsets of the words "obj_info" that give the size of a grid; PCL would trust them.
    std::vector<std::size_t> grid_comments{};
};

/// `names` receives the names of the columns that have one.
Cloud read_obj(const std::string& file, std::string_view text, std::vector<std::string>& names);
Cloud read_table(const std::string& file, std::string_view text, const ReadOptions& options,
                 std::vector<std::string>& names);

/// A coordinate of a text. Throws "io.syntax", "io.non_finite" naming the line.
double coordinate(std::string_view word, const text::Place& place);

/// Throws for a word that is not a number; a decimal comma gets its own remedy.
[[noreturn]] void not_a_number(std::string_view word, const text::Place& place,
                               std::string_view remedy);

/// Check that a file contains everything that its header announces, before PCL reads it: PCL
/// allocates what a header announces, and not all its readers notice a missing end.
FileCheck check_pcd(const std::string& file, std::string_view bytes);
FileCheck check_ply(const std::string& file, std::string_view bytes);

/// Throws because the file has no points.
[[noreturn]] void no_points(const std::string& file, std::string_view remedy);

}  // namespace dsc::cloud
