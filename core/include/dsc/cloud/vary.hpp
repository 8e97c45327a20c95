#pragma once
// Seeded variations of a cloud, so that repeated runs on the same file differ.

#include <array>
#include <cstdint>

#include <dsc/base/workers.hpp>
#include <dsc/cloud/cloud.hpp>
#include <dsc/cloud/normalize.hpp>

namespace dsc::cloud {

/// How a cloud is varied.
struct Variation {
    double subsample = 0.9;  ///< fraction of the points that is kept, above 0 and at most 1
    double jitter = 0.0;     ///< standard deviation of each coordinate, in spacings
    bool rotate = true;      ///< by a rotation that is uniform over all rotations

    bool nothing() const { return subsample == 1.0 && jitter == 0.0 && !rotate; }
};

/// A varied cloud and what was done to it.
struct Varied {
    Cloud cloud;
    std::size_t left_out = 0;    ///< number of points
    double jitter = 0.0;         ///< standard deviation of each coordinate, in the cloud's units
    Vec3 centre = Vec3::Zero();  ///< of the rotation
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< varied - centre = rotation *
                                                             ///< (given - centre)
};

/// Unit quaternion w, x, y, z of the rotation that a seed draws: uniform over all rotations
/// [Shoemake1992]. [setup]
std::array<double, 4> drawn_rotation(std::uint64_t seed);
/// The same as a matrix. [setup]
Eigen::Matrix3d drawn_rotation_matrix(std::uint64_t seed);

/// Leaves out points, then moves the others, then rotates all of them round the centre of their
/// box. The points stay in their order. `round(subsample * n)` points are kept; which points, and
/// how a point moves, depends only on the seed and on the point's index in the given cloud. A
/// spacing is the square root of the area per point, its median over the given points
/// (Statistics::width). The result does not depend on `workers`, which may be null: one thread.
/// Throws GeometryError as measure_cloud if `jitter` is above 0. [setup]
Varied vary(Cloud given, const Variation& variation, std::uint64_t seed,
            Workers* workers = nullptr);

/// Rotates the points and all attributes round `centre`. [setup]
void rotate(Cloud& cloud, const Eigen::Matrix3d& rotation, const Vec3& centre);

/// The transform from the given cloud's units, for `after`, the transform of the varied cloud.
/// [setup]
Transform before_variation(const Transform& after, const Varied& varied);

}  // namespace dsc::cloud
