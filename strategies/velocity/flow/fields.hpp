#pragma once
// Velocity fields in closed form, defined at every point in space and time.

#include <dsc/geometry/vec.hpp>

namespace dsc::strategies {

enum class FieldKind { translate, rotate, shear, part, enright };

/// The kind decides which members are used; r = x - centre, a is the unit vector along `axis`. All
/// fields are divergence-free.
struct Field {
    FieldKind kind = FieldKind::translate;
    Vec3 centre = Vec3::Zero();
    Vec3 axis = Vec3(1, 0, 0);  ///< direction of translate and shear, axis of rotate, line of part
    Vec3 across = Vec3(0, 1, 0);  ///< the direction in which the speed of shear grows
    double speed = 1.0;   ///< of translate and part, length/time; of shear and rotate per length,
                          ///< radians/time
    double width = 0.25;  ///< of the layer between the two sides of part
    double period = 3.0;  ///< of enright
};

/// Velocity at a point and a time:
///  translate  speed a
///  rotate     speed a x r
///  shear      speed (r.b) a, b the unit vector along `across`
///  part       speed tanh(s/w) a - speed/(2w) sech^2(s/w) (r - s a), s = r.a: the two sides go
///             apart (together where the speed is negative) as rigid bodies, what lies between them
///             is drawn thin (squeezed flat)
///  enright    the deformation field of [Enright2002] on the unit cube, from [LeVeque1996], times
///             cos(pi t / period): it brings everything back at t = period
Vec3 velocity(const Field& field, const Vec3& point, double time);

/// Displacement during `step` of a point that moves with the field from `time` on: `parts` steps of
/// the classical Runge-Kutta method of order 4.
Vec3 displacement(const Field& field, const Vec3& point, double time, double step, int parts);

}  // namespace dsc::strategies
