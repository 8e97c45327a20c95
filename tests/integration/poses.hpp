#pragma once
// Random poses for clouds.

#include <dsc/base/random.hpp>
#include <dsc/geometry/vec.hpp>

namespace dsc::test {

/// A rotation that depends on the seed only, uniform over all rotations.
inline Eigen::Matrix3d random_rotation(std::uint64_t seed) {
    RandomStream random(RandomKey{seed, stream_id("rotation"), 0, 0});
    Eigen::Vector4d q;
    for (int i = 0; i < 4; ++i) q[i] = random.normal();
    q.normalize();
    return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
}

}  // namespace dsc::test
