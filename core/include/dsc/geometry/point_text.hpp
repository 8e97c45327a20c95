#pragma once
// A point as messages name it.

#include <string>

#include <dsc/geometry/vec.hpp>
#include <dsc/text/numbers.hpp>

namespace dsc::geometry {

/// "(0.1, 2, -3.5)": every coordinate with at most `digits` significant digits.
inline std::string point_text(const Vec3& p, int digits = 6) {
    return "(" + text::rounded(p.x(), digits) + ", " + text::rounded(p.y(), digits) + ", " +
           text::rounded(p.z(), digits) + ")";
}

}  // namespace dsc::geometry
