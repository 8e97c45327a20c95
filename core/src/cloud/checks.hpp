#pragma once
// Checks that several files of this module share.

#include <span>
#include <string>
#include <string_view>

#include <dsc/geometry/vec.hpp>

namespace dsc::cloud {

/// The name of a cloud for a message; "cloud" if it has no name.
std::string named(std::string_view name);

/// Box of the points. Throws GeometryError "cloud.non_finite" for NaN, infinity and coordinates
/// above 1e100.
Box3 require_finite(std::span<const Vec3> points, std::string_view name);

/// Throws GeometryError "cloud.large" for more points than an int can count, and
/// "cloud.non_finite" for NaN and infinity. `where` names the search in messages.
void require_searchable(std::span<const Vec3> points, const std::string& where);

}  // namespace dsc::cloud
