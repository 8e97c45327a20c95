// The centre that a format of floats subtracts from surfaces far from the origin.
#include "io/float_centre.hpp"

#include <dsc/surface/measure.hpp>

namespace dsc::io {

Vec3 centre_to_subtract(const surface::TriangleMesh& mesh) {
    const Box3 box = surface::used_box(mesh);
    if (box.empty() || box.centre().norm() <= box.diagonal()) return Vec3::Zero();
    return box.centre().cast<float>().cast<double>();
}

}  // namespace dsc::io
