#pragma once
// Built-in shapes: clouds sampled from them, and their triangle meshes as truth.

#include <array>
#include <cstddef>
#include <cstdint>
#include <dsc/cloud/cloud.hpp>
#include <span>
#include <string_view>
#include <vector>

namespace dsc::cloud {

/// Plain arrays; faces are counter-clockwise seen from outside.
struct ShapeMesh {
    std::vector<Vec3> points;
    std::vector<std::array<std::uint32_t, 3>> faces;
};

/// "teapot", "sphere" (radius 1), "torus" (radii 1 and 0.4, axis z), "box_tunnel" (box 2 x 2 x 1.2 with a
/// cylinder of radius 0.5 cut through along z). [parallel]
std::span<const std::string_view> shape_names();

/// Samples `n` points uniformly by area from the shape. `noise` is the standard deviation of a normal
/// displacement of each coordinate, as a fraction of the shape's box diagonal. Of the n points, the last
/// round(outliers * n) are uniform in the shape's box grown 1.2 times instead. Depends on the arguments only.
/// The teapot is scanned from outside: the ends of spout and handle inside the body are left out, and so is the
/// body's wall inside of them.
/// Throws UsageError "shape.unknown", "shape.option"; IoError if the teapot's data file is missing. [setup]
Cloud sample_shape(std::string_view name, std::size_t n, std::uint64_t seed, double noise = 0.0,
                   double outliers = 0.0);

/// A fine mesh with its points on the shape. Closed and 2-manifold for sphere, torus and box_tunnel; the
/// teapot is what sample_shape sees of its open patches, joined along their borders. Throws UsageError
/// "shape.unknown", IoError as sample_shape. [setup]
ShapeMesh shape_mesh(std::string_view name);

}  // namespace dsc::cloud
