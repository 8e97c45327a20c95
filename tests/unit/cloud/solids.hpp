#pragma once
// Clouds on solids whose normals and insides are known, drawn at random with a seed.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <dsc/base/random.hpp>
#include <dsc/cloud/cloud.hpp>

namespace dsc::cloud::known {

/// Points with the normals that point out of their solid, and the area that each stands for.
struct Solid {
    std::vector<Vec3> points;
    std::vector<Vec3> normals;
    double area = 0.0;  ///< per point
};

inline Solid sphere(std::size_t count, std::uint64_t seed = 1) {
    RandomStream random({seed, 0, 0, 0});
    Solid solid;
    for (std::size_t i = 0; i < count; ++i) {
        solid.normals.push_back(
            Vec3(random.normal(), random.normal(), random.normal()).normalized());
        solid.points.push_back(solid.normals.back());
    }
    solid.area = 4.0 * std::acos(-1.0) / static_cast<double>(count);
    return solid;
}

/// Radii 1 and 0.4 round the z axis.
inline Solid torus(std::size_t count, std::uint64_t seed = 1) {
    const double pi = std::acos(-1.0);
    RandomStream random({seed, 1, 0, 0});
    Solid solid;
    while (solid.points.size() < count) {
        const double u = 2.0 * pi * random.uniform(), v = 2.0 * pi * random.uniform();
        if (random.uniform() > (1.0 + 0.4 * std::cos(v)) / 1.4)
            continue;  // more area on the outer side
        const Vec3 normal(std::cos(u) * std::cos(v), std::sin(u) * std::cos(v), std::sin(v));
        solid.normals.push_back(normal);
        solid.points.push_back(Vec3(std::cos(u), std::sin(u), 0.0) + 0.4 * normal);
    }
    solid.area = 4.0 * pi * pi * 0.4 / static_cast<double>(count);
    return solid;
}

/// Side 2.
inline Solid cube(std::size_t count, std::uint64_t seed = 1) {
    RandomStream random({seed, 2, 0, 0});
    Solid solid;
    for (std::size_t i = 0; i < count; ++i) {
        const auto axis = static_cast<Eigen::Index>(i % 3);
        const double sign = i % 6 < 3 ? 1.0 : -1.0;
        Vec3 p(2.0 * random.uniform() - 1.0, 2.0 * random.uniform() - 1.0,
               2.0 * random.uniform() - 1.0);
        p[axis] = sign;
        solid.points.push_back(p);
        solid.normals.push_back(sign * Vec3::Unit(axis));
    }
    solid.area = 24.0 / static_cast<double>(count);
    return solid;
}

inline std::vector<SurfaceSample> samples_of(const Solid& solid) {
    std::vector<SurfaceSample> samples;
    for (std::size_t i = 0; i < solid.points.size(); ++i)
        samples.push_back({solid.points[i], solid.area * solid.normals[i], std::sqrt(solid.area)});
    return samples;
}

/// Share of normals that point to the wrong side.
inline double wrong_share(std::span<const Vec3> normals, std::span<const Vec3> truth) {
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < truth.size(); ++i)
        wrong += normals[i].dot(truth[i]) > 0.0 ? 0U : 1U;
    return static_cast<double>(wrong) / static_cast<double>(truth.size());
}

/// Median angle between normals, whatever their sign, in degrees.
inline double median_error(std::span<const Vec3> normals, std::span<const Vec3> truth) {
    std::vector<double> angles;
    for (std::size_t i = 0; i < truth.size(); ++i)
        angles.push_back(std::acos(std::min(1.0, std::abs(normals[i].dot(truth[i])))) * 180.0 /
                         std::acos(-1.0));
    std::nth_element(angles.begin(),
                     angles.begin() + static_cast<std::ptrdiff_t>(angles.size() / 2), angles.end());
    return angles[angles.size() / 2];
}

}  // namespace dsc::cloud::known
