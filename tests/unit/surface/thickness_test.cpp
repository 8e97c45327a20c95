// Thickness under the vertices of surfaces whose thickness is known.
#include <cmath>

#include <doctest/doctest.h>

#include <dsc/geometry/quality.hpp>
#include <dsc/surface/thickness.hpp>

#include "shapes.hpp"

using namespace dsc;
using surface::SurfaceView;
using surface::TriangleMesh;

namespace {

void add(SurfaceView& view, const TriangleMesh& mesh, bool inwards) {
    const auto first = static_cast<std::uint32_t>(view.positions.size());
    view.positions.insert(view.positions.end(), mesh.points.begin(), mesh.points.end());
    for (auto face : mesh.faces) {
        if (inwards) std::swap(face[0], face[1]);
        view.faces.push_back({first + face[0], first + face[1], first + face[2]});
    }
}

void finish(SurfaceView& view) {
    view.vertex_ids.resize(view.positions.size());
    view.normals.assign(view.positions.size(), Vec3::Zero());
    for (const auto& [a, b, c] : view.faces) {
        const Vec3 n =
            geometry::triangle_normal(view.positions[a], view.positions[b], view.positions[c]);
        view.face_normals.push_back(n);
        for (const auto v : {a, b, c}) view.normals[v] += n;
    }
    for (Vec3& n : view.normals) n.normalize();
}

std::vector<double> thickness(const SurfaceView& view, double most, Workers* workers = nullptr) {
    std::vector<double> out;
    surface::measure_thickness(view, most, 0.7, out, workers);
    return out;
}

}  // namespace

TEST_CASE(
    "a hollow ball is as thick as its wall, seen from both sides, for any number of threads") {
    SurfaceView view;
    add(view, surface::test::sphere(4, 1.0), false);
    add(view, surface::test::sphere(4, 0.8), true);
    finish(view);
    const std::vector<double> wall = thickness(view, 1.0);
    REQUIRE(wall.size() == view.positions.size());
    for (const double t : wall) CHECK(t == doctest::Approx(0.2).epsilon(0.03));
    for (const unsigned threads : {2U, 3U}) {
        Workers workers(threads);
        CHECK(thickness(view, 1.0, &workers) == wall);
    }
    for (const double t : thickness(view, 0.15)) CHECK(std::isinf(t));  // thicker than asked for
}

TEST_CASE("a ball is as thick as it is wide, a void inside does not count the other way round") {
    SurfaceView ball;
    add(ball, surface::test::sphere(3, 0.7), false);
    finish(ball);
    for (const double t : thickness(ball, 5.0)) CHECK(t == doctest::Approx(1.4).epsilon(0.02));
    SurfaceView hole;  // of a solid that fills all space round it
    add(hole, surface::test::sphere(3, 0.7), true);
    finish(hole);
    for (const double t : thickness(hole, 5.0)) CHECK(std::isinf(t));
}

TEST_CASE("the sides of a wedge are not opposite to each other") {
    // Two planes from the z axis, 60 degrees apart, the solid between them.
    SurfaceView view;
    const auto at = [](double angle, double r, double z) {
        return Vec3(r * std::cos(angle), r * std::sin(angle), z);
    };
    constexpr int n = 20;
    for (const double angle : {0.0, 1.0471975511965976}) {
        const auto first = static_cast<std::uint32_t>(view.positions.size());
        for (int i = 0; i <= n; ++i) {
            for (int j = 0; j <= n; ++j)
                view.positions.push_back(at(angle, 0.05 * (i + 1), 0.05 * j - 0.5));
        }
        for (std::uint32_t i = 0; i < n; ++i) {
            for (std::uint32_t j = 0; j < n; ++j) {
                const std::uint32_t a = first + i * (n + 1) + j, b = a + n + 1;
                std::array<std::array<std::uint32_t, 3>, 2> faces = {
                    {{a, b, b + 1}, {a, b + 1, a + 1}}};
                for (auto& face : faces) {
                    if (angle > 0.0) std::swap(face[0], face[1]);
                    view.faces.push_back(face);
                }
            }
        }
    }
    finish(view);
    REQUIRE(view.face_normals.front().y() * view.face_normals.back().y() < 0.0);
    REQUIRE(view.face_normals.front().dot(view.face_normals.back()) == doctest::Approx(-0.5));
    for (const double t : thickness(view, 5.0)) CHECK(std::isinf(t));
    std::vector<double> any;
    surface::measure_thickness(view, 5.0, -1.0, any);
    std::size_t hits = 0;
    for (const double t : any) hits += std::isinf(t) ? 0 : 1;
    CHECK(hits > 100);
}

TEST_CASE("a surface without faces has no thickness") {
    std::vector<double> out(3, 1.0);
    surface::measure_thickness(SurfaceView{}, 1.0, 0.7, out);
    CHECK(out.empty());
}
