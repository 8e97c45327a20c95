#include "fields.hpp"

#include <cmath>

namespace dsc::strategies {
namespace {

constexpr double pi = 3.14159265358979323846;

Vec3 part(const Field& field, const Vec3& r, const Vec3& axis) {
    const double along = r.dot(axis);
    const double tanh = std::tanh(along / field.width);
    const double narrowing = 0.5 * (1 - tanh * tanh) / field.width;
    return field.speed * (tanh * axis - narrowing * (r - along * axis));
}

Vec3 enright(const Vec3& p, double phase) {
    const Eigen::Array3d sine = (pi * p.array()).sin();
    const Eigen::Array3d squared = sine * sine;
    const Eigen::Array3d doubled = (2 * pi * p.array()).sin();
    return std::cos(pi * phase) * Vec3(2 * squared.x() * doubled.y() * doubled.z(),
                                       -doubled.x() * squared.y() * doubled.z(),
                                       -doubled.x() * doubled.y() * squared.z());
}

}  // namespace

Vec3 velocity(const Field& field, const Vec3& point, double time) {
    const Vec3 r = point - field.centre;
    switch (field.kind) {
        case FieldKind::translate: return field.speed * field.axis.normalized();
        case FieldKind::rotate: return field.speed * field.axis.normalized().cross(r);
        case FieldKind::shear:
            return field.speed * r.dot(field.across.normalized()) * field.axis.normalized();
        case FieldKind::part: return part(field, r, field.axis.normalized());
        case FieldKind::enright: return enright(point, time / field.period);
    }
    return Vec3::Zero();
}

Vec3 displacement(const Field& field, const Vec3& point, double time, double step, int parts) {
    const double h = step / parts;
    Vec3 p = point;
    for (int i = 0; i < parts; ++i) {
        const double t = time + i * h;
        const Vec3 k1 = velocity(field, p, t);
        const Vec3 k2 = velocity(field, p + 0.5 * h * k1, t + 0.5 * h);
        const Vec3 k3 = velocity(field, p + 0.5 * h * k2, t + 0.5 * h);
        const Vec3 k4 = velocity(field, p + h * k3, t + h);
        p += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return p - point;
}

}  // namespace dsc::strategies
