// Distances and nearest points of simple solids, and the labels that they give.
#include "dsc/generate/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dsc::generate {
namespace {

mesh::Label label_inside(const Shape& shape) {
    return shape.action == ShapeAction::add ? shape.label : 0;
}

}  // namespace

double excess(const Shape& shape, const Vec3& point) {
    const Vec3 p = point - shape.centre;
    switch (shape.shape) {
        case ShapeKind::sphere: return p.norm() - shape.radius;
        case ShapeKind::box: return (p.cwiseAbs() - shape.half_size).maxCoeff();
        case ShapeKind::cylinder: {
            const Vec3 axis = shape.axis.normalized();
            const double along = p.dot(axis);
            return std::max((p - along * axis).norm() - shape.radius,
                            std::abs(along) - shape.half_length);
        }
    }
    return std::numeric_limits<double>::infinity();
}

namespace {

Vec3 nearest_on_box(const Vec3& half, Vec3 p) {
    const Vec3 inside = p.cwiseMax(-half).cwiseMin(half);
    if (inside != p) return inside;
    Eigen::Index axis = 0;
    (half - p.cwiseAbs()).minCoeff(&axis);
    p[axis] = std::copysign(half[axis], p[axis]);
    return p;
}

/// `p` is relative to the centre of the cylinder.
Vec3 nearest_on_cylinder(const Shape& shape, const Vec3& p) {
    const Vec3 axis = shape.axis.normalized();
    const double along = p.dot(axis);
    const Vec3 across = p - along * axis;
    const double radius = across.norm();
    const Vec3 outwards = radius > 0 ? Vec3(across / radius) : axis.unitOrthogonal();
    // In the half-plane through the axis the cylinder is a box.
    const Vec3 flat =
        nearest_on_box(Vec3(shape.radius, shape.half_length, 1e300), Vec3(radius, along, 0));
    return flat.x() * outwards + flat.y() * axis;
}

/// Label at a point that lies on no border, according to the shapes before `end`.
mesh::Label label_at(std::span<const Shape> shapes, std::size_t end, const Vec3& point) {
    for (std::size_t i = end; i-- > 0;) {
        if (excess(shapes[i], point) < 0) return label_inside(shapes[i]);
    }
    return 0;
}

/// Whether the border of shape i separates two labels at a point of the border.
bool shows(std::span<const Shape> shapes, std::size_t i, const Vec3& point, double tolerance) {
    for (std::size_t later = i + 1; later < shapes.size(); ++later) {
        if (excess(shapes[later], point) < -tolerance) return false;
    }
    return label_at(shapes, i, point) != label_inside(shapes[i]);
}

}  // namespace

Vec3 nearest_on_border(const Shape& shape, const Vec3& point) {
    const Vec3 p = point - shape.centre;
    switch (shape.shape) {
        case ShapeKind::sphere: {
            const double length = p.norm();
            return shape.centre +
                   (length > 0 ? Vec3(p * (shape.radius / length)) : Vec3(shape.radius, 0, 0));
        }
        case ShapeKind::box: return shape.centre + nearest_on_box(shape.half_size, p);
        case ShapeKind::cylinder: return shape.centre + nearest_on_cylinder(shape, p);
    }
    return point;
}

Shape grown(Shape shape, double by) {
    shape.radius += by;
    shape.half_size.array() += by;
    shape.half_length += by;
    return shape;
}

Vec3 nearest_on_surface(std::span<const Shape> shapes, const Vec3& point) {
    constexpr int visits = 60;
    constexpr double rounding = 1e-12;
    Vec3 best = point;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t first = 0; first < shapes.size(); ++first) {
        std::size_t i = first;
        Vec3 p = nearest_on_border(shapes[i], point);
        for (int visit = 0; visit < visits && !shows(shapes, i, p, rounding); ++visit) {
            // This point is hidden: continue with the nearest border that hides it, or inside which
            // it lies without a difference of labels.
            std::size_t other = i;
            double least = std::numeric_limits<double>::infinity();
            for (std::size_t k = 0; k < shapes.size(); ++k) {
                const double away = std::abs(excess(shapes[k], p));
                if (k != i && away < least) {
                    least = away;
                    other = k;
                }
            }
            if (other == i) break;
            i = other;
            p = nearest_on_border(shapes[i], p);
        }
        const double distance = (p - point).norm();
        if (distance < nearest && shows(shapes, i, p, rounding)) {
            nearest = distance;
            best = p;
        }
    }
    return best;
}

bool holds(const Shape& shape, const std::array<Vec3, 4>& corners) {
    if (shape.rule == ShapeRule::barycentre) {
        return excess(shape, 0.25 * (corners[0] + corners[1] + corners[2] + corners[3])) < 0;
    }
    return std::all_of(corners.begin(), corners.end(),
                       [&](const Vec3& p) { return excess(shape, p) <= 0; });
}

mesh::Label label_of(std::span<const Shape> shapes, const std::array<Vec3, 4>& corners) {
    mesh::Label label = 0;
    for (const Shape& shape : shapes) {
        if (holds(shape, corners)) label = label_inside(shape);
    }
    return label;
}

bool same_label_within(std::span<const Shape> shapes, const Vec3& centre, double radius) {
    bool same = true;
    mesh::Label label = 0;
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

}  // namespace dsc::generate
