#include <doctest/doctest.h>

#include <dsc/base/random.hpp>
#include <dsc/surface/winding.hpp>

#include "shapes.hpp"

using namespace dsc;
using namespace dsc::surface;

namespace {

/// Inside a polyhedron whose faces all look away from its middle: below every face's plane by more
/// than rounding.
bool inside_convex(const TriangleMesh& mesh, const Vec3& p, double margin, bool& sure) {
    double highest = -1e300;
    for (const auto& [a, b, c] : mesh.faces) {
        const Vec3 normal =
            (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]).normalized();
        highest = std::max(highest, normal.dot(p - mesh.points[a]));
    }
    sure = std::abs(highest) > margin;
    return highest < 0;
}

}  // namespace

TEST_CASE("random points: in a convex polyhedron below all its faces, and nowhere else") {
    const TriangleMesh mesh = test::sphere(3, 0.9, {0.05, -0.02, 0.01});
    const WindingNumber winding(mesh);
    RandomStream random(RandomKey{5, 0, 0, 0});
    std::size_t inside = 0;
    for (int i = 0; i < 4000; ++i) {
        const Vec3 p(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        bool sure = false;
        const bool in = inside_convex(mesh, p, 1e-12, sure);
        if (!sure) continue;
        REQUIRE(winding.at(p) == (in ? 1 : 0));
        inside += in ? 1 : 0;
    }
    CHECK(inside > 1000);
    CHECK(inside < 2500);
}

TEST_CASE("a torus, analytically, with rays through its vertices and along its edges") {
    const int n = 48, m = 24;
    const TriangleMesh mesh = test::torus(n, m, 1.0, 0.4);
    const WindingNumber winding(mesh);
    // Points at the heights and depths of vertices: their rays pass exactly through vertices and
    // along edges.
    std::size_t exact = 0;
    for (const Vec3& v : mesh.points) {
        for (const double x : {-1.8, -0.9, -0.31, 0.0, 0.47, 1.1, 1.9}) {
            const Vec3 p(x, v.y(), v.z());
            const double tube = std::hypot(std::hypot(p.x(), p.y()) - 1.0, p.z());
            if (std::abs(tube - 0.4) < 0.02) continue;  // between the polyhedron and the torus
            REQUIRE(winding.at(p) == (tube < 0.4 ? 1 : 0));
            ++exact;
        }
    }
    CHECK(exact > 5000);
}

TEST_CASE(
    "a cube: points on its planes, edges and corners belong to one side, each place to the same") {
    const WindingNumber winding(test::cube());
    // As if moved by a little along +x, less along +y, less still along +z.
    for (const double x : {-1.5, -1.0, 0.0, 0.3, 1.0, 1.5}) {
        for (const double y : {-1.5, -1.0, 0.0, 0.3, 1.0, 1.5}) {
            for (const double z : {-1.5, -1.0, 0.0, 0.3, 1.0, 1.5}) {
                const auto within = [](double c) { return c >= -1.0 && c < 1.0; };
                CAPTURE(Vec3(x, y, z).transpose());
                CHECK(winding.at({x, y, z}) == (within(x) && within(y) && within(z) ? 1 : 0));
            }
        }
    }
}

TEST_CASE("cavities, overlaps, surfaces turned inside out") {
    TriangleMesh hollow = test::cube(Vec3::Zero(), 1.0);
    test::append(hollow, test::inside_out(test::cube(Vec3::Zero(), 0.5)));
    CHECK(WindingNumber(hollow).at({0.1, 0.2, 0.3}) == 0);
    CHECK(WindingNumber(hollow).at({0.7, 0.2, 0.3}) == 1);
    TriangleMesh both = test::cube({0, 0, 0}, 1.0);
    test::append(both, test::cube({1, 0, 0}, 0.75));
    CHECK(WindingNumber(both).at({0.5, 0.1, 0.2}) == 2);
    CHECK(WindingNumber(both).at({0.1, 0.1, 0.2}) == 1);
    CHECK(WindingNumber(both).at({1.5, 0.1, 0.2}) == 1);
    CHECK(WindingNumber(test::inside_out(test::cube())).at({0.1, 0.2, 0.3}) == -1);
}

TEST_CASE("triangles without an area do no harm") {
    TriangleMesh mesh = test::cube();
    // Split an edge on one side only and close the gap with a flat triangle.
    mesh.points.emplace_back(0.25, -1.0, -1.0);
    const auto middle = static_cast<test::Index>(mesh.points.size() - 1);
    for (auto& face : mesh.faces) {
        if (face == std::array<test::Index, 3>{0, 1, 5}) face = {middle, 1, 5};
    }
    mesh.faces.push_back({0, middle, 5});
    mesh.faces.push_back({0, 1, middle});
    const WindingNumber winding(mesh);
    for (const double z : {-1.0, -0.99, 0.0, 0.5}) {
        CHECK(winding.at({-2.0, 0.0, z}) == 0);
        CHECK(winding.at({-0.5, 0.0, z}) == 1);
        CHECK(winding.at({0.25, -1.0, z}) == 1);
        CHECK(winding.at({1.5, 0.0, z}) == 0);
    }
}
