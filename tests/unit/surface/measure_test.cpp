#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/surface/measure.hpp>

#include "shapes.hpp"

using namespace dsc;
using namespace dsc::surface;

TEST_CASE("area, volume, box of a cube, near and far") {
    for (const Vec3& centre : {Vec3(0, 0, 0), Vec3(5e6, -3e6, 1e6)}) {
        const TriangleMesh m = test::cube(centre, 0.5);
        CHECK(area(m) == doctest::Approx(6.0).epsilon(1e-12));
        CHECK(volume(m) == doctest::Approx(1.0).epsilon(1e-12));
        CHECK(volume(test::inside_out(m)) == doctest::Approx(-1.0).epsilon(1e-12));
        CHECK((used_box(m).low - centre + Vec3::Constant(0.5)).norm() == 0.0);
        CHECK((used_box(m).high - centre - Vec3::Constant(0.5)).norm() == 0.0);
    }
    CHECK(volume(TriangleMesh{}) == 0.0);
    CHECK(used_box(TriangleMesh{}).empty());
}

TEST_CASE("the box leaves unused points out") {
    TriangleMesh m = test::cube();
    m.points.emplace_back(100, 100, 100);
    CHECK(used_box(m).high == Vec3(1, 1, 1));
}

TEST_CASE("normals of a sphere point outwards") {
    const TriangleMesh m = test::sphere(3);
    const auto at_points = vertex_normals(m), at_faces = face_normals(m);
    for (std::size_t i = 0; i < m.points.size(); ++i) CHECK(at_points[i].dot(m.points[i]) > 0.999);
    for (std::size_t f = 0; f < m.faces.size(); ++f) {
        const Vec3 centre =
            m.points[m.faces[f][0]] + m.points[m.faces[f][1]] + m.points[m.faces[f][2]];
        CHECK(at_faces[f].dot(centre.normalized()) > 0.99);
    }
}

TEST_CASE("vertex normals of a cube do not depend on how its squares are cut") {
    for (const Vec3& n : vertex_normals(test::cube())) {
        for (int k = 0; k < 3; ++k) CHECK(std::abs(n[k]) == doctest::Approx(1.0 / std::sqrt(3.0)));
    }
}

TEST_CASE("a point without faces and a degenerate face have a zero normal") {
    TriangleMesh m;
    m.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 9}};
    m.faces = {{0, 1, 2}};
    CHECK(face_normals(m)[0] == Vec3::Zero());
    for (const Vec3& n : vertex_normals(m)) CHECK(n == Vec3::Zero());
}

TEST_CASE("welding a soup of triangles gives the mesh back") {
    const TriangleMesh m = test::torus();
    TriangleMesh soup;
    for (const auto& f : m.faces) {
        const auto base = static_cast<std::uint32_t>(soup.points.size());
        for (const std::uint32_t v : f) soup.points.push_back(m.points[v]);
        soup.faces.push_back({base, base + 1, base + 2});
    }
    soup.points.emplace_back(7, 7, 7);
    soup.faces.push_back({0, 0, 1});
    const TriangleMesh back = weld(soup);
    CHECK(back.points.size() == m.points.size());
    REQUIRE(back.faces.size() == m.faces.size());
    for (std::size_t f = 0; f < m.faces.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k)
            CHECK(back.points[back.faces[f][k]] == m.points[m.faces[f][k]]);
    }
}

TEST_CASE("welding takes -0 and 0 for the same place and neighbouring doubles for two") {
    TriangleMesh m;
    m.points = {{0.0, 0, 0},  {1, 0, 0},    {0, 1, 0},
                {-0.0, 0, 0}, {1, -0.0, 0}, {std::nextafter(0.0, 1.0), 1, 0}};
    m.faces = {{0, 1, 2}, {3, 5, 4}};
    CHECK(weld(m).points.size() == 4);
}

TEST_CASE("what is not sound is named") {
    TriangleMesh m = test::cube();
    m.faces.push_back({0, 1, 8});
    CHECK_THROWS_WITH_AS(
        require_sound(m),
        "surface: face 12 refers to point 8 of 8; remove the face or add the point", GeometryError);
    m.points[3].y() = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH_AS(require_sound(m),
                         "surface: point 3 is NaN or infinite; remove it or repair the file",
                         GeometryError);
}
