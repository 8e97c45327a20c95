// Samples and meshes of the built-in shapes.
#include "dsc/cloud/shapes.hpp"

#include <cmath>
#include <string>

#include <fmt/format.h>

#include <dsc/base/error.hpp>
#include <dsc/text/numbers.hpp>
#include <dsc/text/words.hpp>

#include "surfaces.hpp"

namespace dsc::cloud {

namespace {

struct NamedShape {
    std::string_view name;
    std::unique_ptr<Shape> (*make)();
};

constexpr std::array<NamedShape, 4> shapes{{
    {"teapot", make_teapot},
    {"sphere", make_sphere},
    {"torus", make_torus},
    {"box_tunnel", make_box_tunnel},
}};
constexpr std::array<std::string_view, 4> names{shapes[0].name, shapes[1].name, shapes[2].name,
                                                shapes[3].name};

std::unique_ptr<Shape> make_shape(std::string_view name) {
    for (const NamedShape& shape : shapes)
        if (shape.name == name) return shape.make();
    std::string accepted;
    for (const std::string_view known : names)
        accepted.append(accepted.empty() ? "" : ", ").append(known);
    throw UsageError("shape.unknown", "shape",
                     fmt::format("there is no built-in shape {}", text::in_quotes(name)),
                     fmt::format("use one of these: {}", accepted));
}

void require_fraction(bool valid, std::string_view what, double value, std::string_view range) {
    if (!valid)
        throw UsageError("shape.option", what,
                         fmt::format("{} is out of range", text::rounded(value)),
                         fmt::format("use a number in {}", range));
}

}  // namespace

std::span<const std::string_view> shape_names() { return names; }

Cloud sample_shape(std::string_view name, std::size_t n, std::uint64_t seed, double noise,
                   double outliers) {
    if (n == 0)
        throw UsageError("shape.option", "number of points", "0 points are requested",
                         "request at least 1");
    require_fraction(noise >= 0.0 && noise <= 1.0, "noise", noise, "[0, 1]");
    require_fraction(outliers >= 0.0 && outliers <= 1.0, "outliers", outliers, "[0, 1]");
    const std::unique_ptr<Shape> shape = make_shape(name);
    const Box3 box = shape->box();
    const Vec3 centre = box.centre();
    const Vec3 half = 0.5 * 1.2 * box.size();
    const double sigma = noise * box.diagonal();
    const std::size_t on_shape =
        n - static_cast<std::size_t>(std::llround(outliers * static_cast<double>(n)));

    Cloud cloud;
    cloud.source = name;
    cloud.points.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        // Each point has its own random stream: with or without noise, a larger sample begins with
        // the same points.
        RandomStream random({seed, stream_id("sample_shape"), stream_id(name), i});
        Vec3& p = cloud.points[i];
        if (i < on_shape) {
            p = shape->sample(random);
            if (sigma > 0.0)
                for (int k = 0; k < 3; ++k) p[k] += sigma * random.normal();
        } else {
            for (int k = 0; k < 3; ++k)
                p[k] = random.uniform(centre[k] - half[k], centre[k] + half[k]);
        }
    }
    return cloud;
}

ShapeMesh shape_mesh(std::string_view name) { return make_shape(name)->mesh(); }

}  // namespace dsc::cloud
