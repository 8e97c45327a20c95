// The centre that a format of floats subtracts from surfaces far from the origin.
#include "io/float_centre.hpp"

#include <dsc/surface/measure.hpp>

namespace dsc::io {
namespace {

/// g++ 12 with -O3 leaves out a conversion to float and back if it converts two numbers at once;
/// the volatile variable prevents this.
double rounded_to_float(double value) {
    const volatile float rounded = static_cast<float>(value);
    return static_cast<double>(rounded);
}

}  // namespace

Vec3 centre_to_subtract(const surface::TriangleMesh& mesh) {
    const Box3 box = surface::used_box(mesh);
    if (box.empty() || box.centre().norm() <= box.diagonal()) return Vec3::Zero();
    const Vec3 centre = box.centre();
    return {rounded_to_float(centre.x()), rounded_to_float(centre.y()),
            rounded_to_float(centre.z())};
}

}  // namespace dsc::io
