#pragma once
// Common parts of the checks of PCD and PLY headers.

#include <cstddef>
#include <limits>
#include <string>

namespace dsc::cloud {

[[noreturn]] void header_error(const std::string& file, std::size_t line, const std::string& cause);

/// "the header announces N points, the file contains M".
[[noreturn]] void truncated(const std::string& file, const std::string& promised, std::size_t held);

/// The largest count of a header that can still be multiplied by sizes; PCL counts points in 31
/// bits.
inline constexpr std::size_t most_points = std::numeric_limits<int>::max();

}  // namespace dsc::cloud
