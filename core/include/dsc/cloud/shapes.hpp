#pragma once
// Built-in shapes: clouds sampled from them, and their triangle meshes for comparison.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <dsc/cloud/cloud.hpp>

namespace dsc::cloud {

/// Plain arrays; faces are counter-clockwise seen from outside.
struct ShapeMesh {
    std::vector<Vec3> points;
    std::vector<std::array<std::uint32_t, 3>> faces;
};

/// "teapot", "sphere" (radius 1), "torus" (radii 1 and 0.4, axis z), "box_tunnel" (box 2 x 2 x 1.2
/// with a hole of radius 0.5 along z). [parallel]
std::span<const std::string_view> shape_names();

/// Samples `n` points uniformly by area from the shape. `noise` is the standard deviation of a
/// normal displacement of each coordinate, as a fraction of the diagonal of the shape's box. Of the
/// n points, the last round(outliers * n) are instead uniform in the shape's box enlarged 1.2
/// times. The result depends only on the arguments. The teapot is sampled as seen from outside: the
/// ends of spout and handle inside the body, and the part of the body's wall inside them, are left
/// out. Throws UsageError "shape.unknown", "shape.option"; IoError if the teapot's data file is
/// missing. [setup]
Cloud sample_shape(std::string_view name, std::size_t n, std::uint64_t seed, double noise = 0.0,
                   double outliers = 0.0);

/// A fine mesh with its points on the shape. Closed and 2-manifold for sphere, torus and
/// box_tunnel. For the teapot it is the part of its open patches that sample_shape uses, joined
/// along their borders. Throws UsageError "shape.unknown", IoError as sample_shape. [setup]
ShapeMesh shape_mesh(std::string_view name);

}  // namespace dsc::cloud
