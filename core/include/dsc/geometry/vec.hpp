#pragma once
// Vectors and boxes that the whole project uses.

#include <limits>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace dsc {

/// A point or a vector in space. 24 bytes without over-alignment, so std::vector and plain structs
/// can store it.
using Vec3 = Eigen::Vector3d;

/// Axis-parallel box; empty when low > high.
struct Box3 {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
    Vec3 high = Vec3::Constant(-std::numeric_limits<double>::infinity());

    bool empty() const { return !(low.array() <= high.array()).all(); }
    void extend(const Vec3& p) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    Vec3 centre() const { return 0.5 * (low + high); }
    Vec3 size() const { return high - low; }
    /// Length of the diagonal; 0 when empty.
    double diagonal() const { return empty() ? 0.0 : size().norm(); }
    bool contains(const Vec3& p) const {
        return (low.array() <= p.array()).all() && (p.array() <= high.array()).all();
    }
};

/// Box of a range of points.
template <class Range>
Box3 bounding_box(const Range& points) {
    Box3 box;
    for (const auto& p : points) box.extend(p);
    return box;
}

}  // namespace dsc
