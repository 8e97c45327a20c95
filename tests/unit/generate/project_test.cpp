// Interfaces on the surface of shapes, and the nearest points that they go to.
#include <cmath>
#include <set>

#include <doctest/doctest.h>

#include <dsc/base/random.hpp>
#include <dsc/generate/project.hpp>
#include <dsc/mesh/adopt.hpp>
#include <dsc/mesh/validate.hpp>

#include "../mesh/meshes.hpp"

using namespace dsc;
using namespace dsc::mesh;
using namespace dsc::generate;

namespace {

Shape sphere(const Vec3& centre, double radius, ShapeAction action = ShapeAction::add) {
    Shape shape;
    shape.centre = centre;
    shape.radius = radius;
    shape.action = action;
    return shape;
}

Shape box(const Vec3& centre, const Vec3& half, ShapeAction action = ShapeAction::add) {
    Shape shape;
    shape.shape = ShapeKind::box;
    shape.centre = centre;
    shape.half_size = half;
    shape.action = action;
    return shape;
}

std::vector<Vec3> random_points(std::size_t count, double half) {
    RandomStream random(RandomKey{7, stream_id("points"), 0, 0});
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < count; ++i)
        points.emplace_back(random.uniform(-half, half), random.uniform(-half, half),
                            random.uniform(-half, half));
    return points;
}

/// A lattice labelled by shapes, projected on them.
Complex projected(std::span<const Shape> shapes, int cells) {
    const auto make = [&](std::span<const Shape> reached) {
        TetMesh mesh = test::grid(cells, 1.5, [](const Vec3&) { return 0; });
        for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
            std::array<Vec3, 4> corners;
            for (std::size_t i = 0; i < 4; ++i) corners[i] = mesh.points[mesh.tets[t][i]];
            mesh.labels[t] = label_of(reached, corners);
        }
        return mesh;
    };
    return adopt(make_projected(make, shapes, 3.0 / cells, "lattice"), "projected");
}

double largest_distance(const Complex& complex, std::span<const Shape> shapes) {
    double largest = 0;
    for (const VertexId v : complex.interface_vertices()) {
        const Vec3& p = complex.position(v);
        largest = std::max(largest, (nearest_on_surface(shapes, p) - p).norm());
    }
    return largest;
}

}  // namespace

TEST_CASE("the nearest point of a border lies on it, and no other sampled point of it is nearer") {
    Shape cylinder;
    cylinder.shape = ShapeKind::cylinder;
    cylinder.axis = Vec3(1, 2, -1);
    cylinder.radius = 0.4;
    cylinder.half_length = 0.7;
    for (const Shape& shape :
         {sphere(Vec3(0.1, 0, 0), 0.6), box(Vec3(0, 0.2, 0), Vec3(0.5, 0.3, 0.8)), cylinder}) {
        std::vector<Vec3> border;
        for (const Vec3& p : random_points(4000, 1.2)) {
            border.push_back(nearest_on_border(shape, p));
            CHECK(std::abs(excess(shape, border.back())) < 1e-14);
        }
        for (const Vec3& p : random_points(50, 1.2)) {
            const double distance = (nearest_on_border(shape, p) - p).norm();
            for (const Vec3& q : border) REQUIRE((q - p).norm() > distance - 1e-12);
        }
    }
}

TEST_CASE("a border that a later shape covers is not part of the surface") {
    const std::vector<Shape> pair = {sphere(Vec3(-0.3, 0, 0), 0.5), sphere(Vec3(0.3, 0, 0), 0.5)};
    for (const Vec3& p : random_points(300, 1.2)) {
        const Vec3 q = nearest_on_surface(pair, p);
        const double first = excess(pair[0], q);
        const double second = excess(pair[1], q);
        // On one of them and not inside the other, whatever the order.
        CHECK(std::min(std::abs(first), std::abs(second)) < 1e-11);
        CHECK(std::min(first, second) > -1e-11);
    }
    // The circle where they meet is nearest to this point, 0.1 away; going to and fro ends a little
    // beyond it.
    CHECK((nearest_on_surface(pair, Vec3(0, 0.3, 0)) - Vec3(0, 0.3, 0)).norm() < 0.12);
}

TEST_CASE("what is cut away has its own walls, and its rim is found") {
    const std::vector<Shape> notched = {sphere(Vec3::Zero(), 1.0),
                                        box(Vec3(0, -0.6, 0), Vec3(0.2, 0.6, 2), ShapeAction::cut)};
    CHECK(nearest_on_surface(notched, Vec3(0.25, -0.3, 0)).isApprox(Vec3(0.2, -0.3, 0), 1e-12));
    CHECK(nearest_on_surface(notched, Vec3(0, 0.1, 0)).norm() < 1e-12);
    // Below the notch there is no sphere left: the nearest point is on the rim.
    const Vec3 rim = nearest_on_surface(notched, Vec3(0.1, -1.1, 0));
    CHECK(rim.x() == doctest::Approx(0.2));
    CHECK(rim.norm() == doctest::Approx(1.0));
    CHECK(nearest_on_surface({}, Vec3(1, 2, 3)) == Vec3(1, 2, 3));
}

TEST_CASE("a sphere's interface goes to the radius, tets stay good, at every resolution") {
    for (const int cells : {14, 16, 20, 24, 30}) {
        CAPTURE(cells);
        const std::vector<Shape> shapes = {sphere(Vec3::Zero(), 0.9)};
        const Complex complex = projected(shapes, cells);
        CHECK(validate(complex).faults == std::vector<std::string>{});
        CHECK(count_interface(complex).shells == 1);
        CHECK(count_interface(complex).genus() == 0);
        CHECK(largest_distance(complex, shapes) < 1e-9);
        CHECK(complex.least_quality() >= 0.019F);
        // A polyhedron with its vertices on the sphere lies inside, and near to it.
        const double exact = 4.0 / 3 * 3.14159265358979 * 0.9 * 0.9 * 0.9;
        CHECK(labelled_volume(complex) < exact);
        CHECK(labelled_volume(complex) > exact * (1 - 10.0 / (cells * cells)));
    }
}

TEST_CASE("a notch and a bar with two ends come out with their topology") {
    const std::vector<Shape> notched = {
        sphere(Vec3::Zero(), 0.9), box(Vec3(0, -0.5, 0), Vec3(0.25, 0.6, 1.2), ShapeAction::cut)};
    const Complex notch = projected(notched, 24);
    CHECK(validate(notch).faults == std::vector<std::string>{});
    CHECK(count_interface(notch).genus() == 0);
    CHECK(largest_distance(notch, notched) < 0.02);

    Shape bar;
    bar.shape = ShapeKind::cylinder;
    bar.axis = Vec3(1, 0, 0);
    bar.radius = 0.2;
    bar.half_length = 0.6;
    const std::vector<Shape> dumbbell = {sphere(Vec3(-0.6, 0, 0), 0.4),
                                         sphere(Vec3(0.6, 0, 0), 0.4), bar};
    const Complex bell = projected(dumbbell, 24);
    CHECK(count_interface(bell).shells == 1);
    CHECK(count_interface(bell).genus() == 0);
    const Complex apart = projected(std::span(dumbbell).first(2), 24);
    CHECK(count_interface(apart).shells == 2);
}

TEST_CASE("where there is no way, a vertex stays as near as it got and no tet inverts") {
    // A surface that folds the lattice: one sheet for both sides of a thin slab.
    Complex complex = adopt(
        test::grid(12, 1.5,
                   [](const Vec3& c) { return std::abs(c.z()) < 0.3 && c.norm() < 1 ? 1 : 0; }),
        "slab");
    const ProjectReport report = project_interface(
        complex, [](const Vec3& p) { return Vec3(p.x(), p.y(), 0.0); }, {.rounds = 10});
    CHECK(report.off_surface > 0);
    CHECK(validate(complex).faults == std::vector<std::string>{});
    CHECK(report.min_quality > 0.0);
}

TEST_CASE("projecting twice gives the same bits") {
    const std::vector<Shape> shapes = {sphere(Vec3(0.05, 0, 0), 0.8)};
    CHECK(projected(shapes, 16).to_mesh().points == projected(shapes, 16).to_mesh().points);
}
