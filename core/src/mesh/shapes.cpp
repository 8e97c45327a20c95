#include <algorithm>
#include <cmath>
#include <dsc/mesh/shapes.hpp>
#include <limits>

namespace dsc::mesh {
namespace {

Label label_inside(const Shape& shape) { return shape.action == ShapeAction::add ? shape.label : 0; }

}  // namespace

double excess(const Shape& shape, const Vec3& point) {
    const Vec3 p = point - shape.centre;
    switch (shape.shape) {
        case ShapeKind::sphere:
            return p.norm() - shape.radius;
        case ShapeKind::box:
            return (p.cwiseAbs() - shape.half_size).maxCoeff();
        case ShapeKind::cylinder: {
            const Vec3 axis = shape.axis.normalized();
            const double along = p.dot(axis);
            return std::max((p - along * axis).norm() - shape.radius, std::abs(along) - shape.half_length);
        }
    }
    return std::numeric_limits<double>::infinity();
}

bool holds(const Shape& shape, const std::array<Vec3, 4>& corners) {
    if (shape.rule == ShapeRule::barycentre) {
        return excess(shape, 0.25 * (corners[0] + corners[1] + corners[2] + corners[3])) < 0;
    }
    return std::all_of(corners.begin(), corners.end(), [&](const Vec3& p) { return excess(shape, p) <= 0; });
}

Label label_of(std::span<const Shape> shapes, const std::array<Vec3, 4>& corners) {
    Label label = 0;
    for (const Shape& shape : shapes) {
        if (holds(shape, corners)) label = label_inside(shape);
    }
    return label;
}

bool same_label_within(std::span<const Shape> shapes, const Vec3& centre, double radius) {
    bool same = true;
    Label label = 0;
    for (const Shape& shape : shapes) {
        const double outside = excess(shape, centre);
        if (outside > radius) continue;
        if (outside < -radius) {
            same = true;
            label = label_inside(shape);
        } else {
            same = same && label == label_inside(shape);
        }
    }
    return same;
}

}  // namespace dsc::mesh
