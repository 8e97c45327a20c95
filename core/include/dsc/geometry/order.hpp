#pragma once
// An order of points that depends on their coordinates alone.

#include <algorithm>

#include <dsc/geometry/vec.hpp>

namespace dsc::geometry {

/// Whether `a` comes before `b` by x, then y, then z. The points must not contain a NaN. [parallel]
inline bool lexicographically_before(const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

}  // namespace dsc::geometry
