#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include <doctest/doctest.h>

#include <dsc/cloud/search.hpp>
#include <dsc/cloud/shapes.hpp>
#include <dsc/geometry/quality.hpp>

#include "files.hpp"

using dsc::Vec3;
using namespace dsc::cloud;
using std::numbers::pi;

namespace {

struct Census {
    double volume = 0.0, area = 0.0;
    std::size_t edges = 0, boundary = 0;
    std::size_t wrong = 0;  ///< edges used more than once in one direction
    long euler = 0;
};

Census census(const ShapeMesh& mesh) {
    Census result;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> directed;
    std::vector<bool> used(mesh.points.size(), false);
    for (const auto& face : mesh.faces) {
        const Vec3 &a = mesh.points[face[0]], &b = mesh.points[face[1]], &c = mesh.points[face[2]];
        result.volume += a.cross(b).dot(c) / 6.0;
        result.area += dsc::geometry::triangle_area(a, b, c);
        for (std::size_t k = 0; k < 3; ++k) {
            ++directed[{face[k], face[(k + 1) % 3]}];
            used[face[k]] = true;
        }
    }
    for (const auto& [edge, count] : directed) {
        if (count > 1) ++result.wrong;
        const bool twin = directed.count({edge.second, edge.first}) > 0;
        if (!twin) ++result.boundary;
        if (!twin || edge.first < edge.second) ++result.edges;
    }
    CHECK(std::find(used.begin(), used.end(), false) == used.end());
    result.euler = static_cast<long>(mesh.points.size()) - static_cast<long>(result.edges) +
                   static_cast<long>(mesh.faces.size());
    return result;
}

/// Distance to the true surface of sphere, torus or box_tunnel.
double off_surface(std::string_view name, const Vec3& p) {
    const double r = std::hypot(p.x(), p.y());
    if (name == "sphere") return std::abs(p.norm() - 1.0);
    if (name == "torus") return std::abs(std::hypot(r - 1.0, p.z()) - 0.4);
    const double wall = std::max(std::abs(p.x()), std::abs(p.y()));
    double best = std::min(std::abs(wall - 1.0), std::abs(r - 0.5));
    if (r >= 0.5 - 1e-9) best = std::min(best, std::abs(std::abs(p.z()) - 0.6));
    return best;
}

template <class Inside>
double share_of(const Cloud& cloud, const Inside& inside) {
    const auto count = std::count_if(cloud.points.begin(), cloud.points.end(), inside);
    return static_cast<double>(count) / static_cast<double>(cloud.points.size());
}

}  // namespace

TEST_CASE("the meshes of sphere, torus and box_tunnel are closed and true") {
    struct Truth {
        const char* name;
        double area, volume;
        long euler;
    };
    const double lids = 2.0 * (4.0 - pi * 0.25);
    for (const Truth& truth :
         {Truth{"sphere", 4.0 * pi, 4.0 * pi / 3.0, 2},
          Truth{"torus", 4.0 * pi * pi * 0.4, 2.0 * pi * pi * 0.16, 0},
          Truth{"box_tunnel", 4.0 * 2.4 + lids + pi * 1.2, 1.2 * (4.0 - pi * 0.25), 0}}) {
        CAPTURE(truth.name);
        const ShapeMesh mesh = shape_mesh(truth.name);
        const Census found = census(mesh);
        CHECK(found.boundary == 0);
        CHECK(found.wrong == 0);
        CHECK(found.euler == truth.euler);
        CHECK(found.area == doctest::Approx(truth.area).epsilon(1e-3));
        CHECK(found.volume == doctest::Approx(truth.volume).epsilon(1e-3));
        for (const Vec3& p : mesh.points) REQUIRE(off_surface(truth.name, p) < 1e-12);
    }
}

TEST_CASE("samples lie on the shape, uniform by area") {
    constexpr std::size_t n = 40000;  // four standard deviations of a share of one half are 0.01
    const Cloud sphere = sample_shape("sphere", n, 1);
    CHECK(share_of(sphere, [](const Vec3& p) { return p.z() > 0.5; }) ==
          doctest::Approx(0.25).epsilon(0.04));
    CHECK(share_of(sphere, [](const Vec3& p) { return p.x() + p.y() > 0.0; }) ==
          doctest::Approx(0.5).epsilon(0.02));
    const Cloud torus = sample_shape("torus", n, 1);
    CHECK(share_of(torus, [](const Vec3& p) { return std::hypot(p.x(), p.y()) > 1.0; }) ==
          doctest::Approx(0.5 + 0.4 / pi).epsilon(0.02));
    const Cloud tunnel = sample_shape("box_tunnel", n, 1);
    const double lids = 2.0 * (4.0 - pi * 0.25), all = 9.6 + lids + pi * 1.2;
    CHECK(share_of(tunnel, [](const Vec3& p) { return std::hypot(p.x(), p.y()) < 0.5 + 1e-9; }) ==
          doctest::Approx(pi * 1.2 / all).epsilon(0.05));
    CHECK(share_of(tunnel, [](const Vec3& p) { return p.z() == 0.6; }) ==
          doctest::Approx(0.5 * lids / all).epsilon(0.06));
    CHECK(share_of(tunnel, [](const Vec3& p) { return p.x() == -1.0; }) ==
          doctest::Approx(2.4 / all).epsilon(0.06));
    for (const char* name : {"sphere", "torus", "box_tunnel"})
        for (const Vec3& p : sample_shape(name, 5000, 2).points)
            REQUIRE(off_surface(name, p) < 1e-12);
}

TEST_CASE("the teapot is seen from outside") {
    const ShapeMesh mesh = shape_mesh("teapot");
    const Census found = census(mesh);
    CHECK(found.wrong == 0);      // patches joined, all with the same side out
    CHECK(found.volume > 10.0);   // and that side is the outer one
    CHECK(found.boundary > 100);  // open at the rim, the lid, the spout's tip and where spout and
                                  // handle enter the body
    const dsc::Box3 box = dsc::bounding_box(mesh.points);
    CHECK(box.low.x() == doctest::Approx(-3.0).epsilon(1e-3));
    CHECK(box.high.x() == doctest::Approx(3.434).epsilon(1e-3));
    CHECK(box.low.z() == 0.0);
    CHECK(box.high.z() == doctest::Approx(3.15));

    const Cloud cloud = sample_shape("teapot", 20000, 3);
    const NearestSearch surface(mesh.points);
    for (const Vec3& p : cloud.points) {
        REQUIRE(box.contains(p));
        REQUIRE(surface.nearest(p).distance < 0.1);  // cells are up to 0.16 long
        // The body's radius between these heights; spout and handle start at 1.5 and 1.7, well
        // inside.
        const double r = std::hypot(p.x(), p.y());
        if (p.z() > 0.7 && p.z() < 1.5) REQUIRE(r > 1.88);
        if (p.z() > 1.8 && p.z() < 2.2) REQUIRE(r > 1.58);
        // The wall behind the handle's upper end and behind the spout: no scanner sees it.
        if (std::abs(p.y()) < 0.08 && p.z() > 2.06 && p.z() < 2.2 && p.x() < 0.0)
            REQUIRE(p.x() < -2.5);
        if (std::abs(p.y()) < 0.3 && p.z() > 0.8 && p.z() < 1.2 && p.x() > 0.0)
            REQUIRE(p.x() > 2.05);
    }
    // Area-uniform: shares of the visible area.
    const auto upper = [](const Vec3& p) { return p.z() > 1.2; };
    double area = 0.0;
    for (const auto& face : mesh.faces) {
        const Vec3 &a = mesh.points[face[0]], &b = mesh.points[face[1]], &c = mesh.points[face[2]];
        if (upper((a + b + c) / 3.0)) area += dsc::geometry::triangle_area(a, b, c);
    }
    CHECK(share_of(cloud, upper) == doctest::Approx(area / found.area).epsilon(0.02));
}

TEST_CASE("noise and outliers are what was asked for") {
    constexpr std::size_t n = 20000;
    const Cloud noisy = sample_shape("sphere", n, 4, 0.01);
    double squares = 0.0;
    for (const Vec3& p : noisy.points) squares += (p.norm() - 1.0) * (p.norm() - 1.0);
    CHECK(std::sqrt(squares / n) == doctest::Approx(0.01 * std::sqrt(12.0)).epsilon(0.03));

    const Cloud wild = sample_shape("sphere", n, 4, 0.0, 0.1);
    REQUIRE(wild.points.size() == n);
    std::size_t outside = 0;
    for (std::size_t i = 0; i < n; ++i) {
        REQUIRE((off_surface("sphere", wild.points[i]) > 1e-12) == (i >= n - 2000));
        REQUIRE(wild.points[i].cwiseAbs().maxCoeff() <= 1.2);
        outside += wild.points[i].cwiseAbs().maxCoeff() > 1.0;
    }
    CHECK(static_cast<double>(outside) / 2000.0 ==
          doctest::Approx(1.0 - 1.0 / (1.2 * 1.2 * 1.2)).epsilon(0.1));
}

TEST_CASE("samples depend on the arguments only") {
    for (const std::string_view name : shape_names()) {
        const Cloud first = sample_shape(name, 300, 5, 0.01, 0.05);
        CHECK(sample_shape(name, 300, 5, 0.01, 0.05).points == first.points);
        CHECK(sample_shape(name, 300, 6, 0.01, 0.05).points != first.points);
        CHECK(first.source == name);
        const Cloud more = sample_shape(name, 400, 5);
        const Cloud less = sample_shape(name, 300, 5);
        CHECK(std::equal(less.points.begin(), less.points.end(), more.points.begin()));
    }
    CHECK(sample_shape("sphere", 1, 1).points != sample_shape("torus", 1, 1).points);
}

TEST_CASE("wrong requests are refused") {
    CHECK(test::error_of([] { sample_shape("cup", 10, 1); }) ==
          "shape.unknown 2: shape: there is no built-in shape 'cup'; use one of these: teapot, "
          "sphere, "
          "torus, "
          "box_tunnel");
    CHECK(test::error_of([] { shape_mesh(""); }) ==
          "shape.unknown 2: shape: there is no built-in shape ''; use one of these: teapot, "
          "sphere, torus, "
          "box_tunnel");
    CHECK(test::error_of([] { sample_shape("sphere", 0, 1); }) ==
          "shape.option 2: number of points: 0 points are requested; request at least 1");
    CHECK(test::error_of([] { sample_shape("sphere", 10, 1, -0.5); }) ==
          "shape.option 2: noise: -0.5 is out of range; use a number in [0, 1]");
    CHECK(test::error_of([] { sample_shape("sphere", 10, 1, 0.0, 1.5); }) ==
          "shape.option 2: outliers: 1.5 is out of range; use a number in [0, 1]");
}
