// What is derived from a view: its edges with their faces, and the nearest faces of points.
#include <cmath>

#include <doctest/doctest.h>

#include <dsc/base/random.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/surface/face_points.hpp>
#include <dsc/surface/support.hpp>

using namespace dsc;
using surface::SurfaceView;

namespace {

SurfaceView octahedron() {
    SurfaceView view;
    view.positions = {Vec3(1, 0, 0),  Vec3(-1, 0, 0), Vec3(0, 1, 0),
                      Vec3(0, -1, 0), Vec3(0, 0, 1),  Vec3(0, 0, -1)};
    view.vertex_ids = {0, 1, 2, 3, 4, 5};
    view.faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                  {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    return view;
}

}  // namespace

TEST_CASE("every edge of a closed surface is there once, with its two faces") {
    const SurfaceView view = octahedron();
    std::vector<surface::ViewEdge> edges(3);
    surface::build_edges(view, edges);
    CHECK(edges.size() == 12);
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const auto& e = edges[i];
        CHECK(e.vertices[0] < e.vertices[1]);
        if (i > 0) CHECK(edges[i - 1].vertices < e.vertices);
        CHECK(e.face_count == 2);
        CHECK(e.faces[0] < e.faces[1]);
        for (const std::uint32_t f : e.faces) {
            for (const std::uint32_t v : e.vertices)
                CHECK(std::count(view.faces[f].begin(), view.faces[f].end(), v) == 1);
        }
    }
}

TEST_CASE("edges at a rim have one face, where sheets meet they have more") {
    SurfaceView view = octahedron();
    view.faces = {{0, 2, 4}};
    std::vector<surface::ViewEdge> edges;
    surface::build_edges(view, edges);
    REQUIRE(edges.size() == 3);
    CHECK(edges[0].face_count == 1);
    CHECK(edges[0].faces == std::array<std::uint32_t, 2>{0, mesh::none});
    view.faces = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
    surface::build_edges(view, edges);
    REQUIRE(edges.size() == 7);
    CHECK(edges[0].face_count == 3);
    CHECK(edges[0].faces == std::array<std::uint32_t, 2>{0, 1});
}

TEST_CASE("the nearest face, the place in it and the distance are those of a search over all "
          "faces, for any number of threads") {
    const SurfaceView view = octahedron();
    RandomStream random(RandomKey{11, 0, 0, 0});
    std::vector<Vec3> points;
    for (int i = 0; i < 700; ++i)
        points.emplace_back(random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5),
                            random.uniform(-1.5, 1.5));
    points.emplace_back(0, 0, 2);  // equally near to four faces
    std::vector<surface::FacePoint> found;
    surface::nearest_faces(view, points, found);
    REQUIRE(found.size() == points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        double least = INFINITY;
        for (const auto& [a, b, c] : view.faces) {
            const Vec3 q = geometry::closest_point_on_triangle(
                points[i], view.positions[a], view.positions[b], view.positions[c]);
            least = std::min(least, (q - points[i]).norm());
        }
        const surface::FacePoint& f = found[i];
        CHECK(f.distance == doctest::Approx(least).epsilon(1e-12));
        CHECK(f.weights[0] + f.weights[1] + f.weights[2] == doctest::Approx(1.0).epsilon(1e-12));
        Vec3 place = Vec3::Zero();
        for (std::size_t k = 0; k < 3; ++k) {
            CHECK(f.weights[k] >= 0.0);
            place += f.weights[k] * view.positions[view.faces[f.face][k]];
        }
        CHECK((place - points[i]).norm() == doctest::Approx(least).epsilon(1e-9));
    }
    CHECK(found.back().face == 0);
    Workers three(3);
    std::vector<surface::FacePoint> shared;
    surface::nearest_faces(view, points, shared, &three);
    for (std::size_t i = 0; i < points.size(); ++i) {
        CHECK(shared[i].face == found[i].face);
        CHECK(shared[i].weights == found[i].weights);
        CHECK(shared[i].distance == found[i].distance);
    }
}

TEST_CASE("faces without area are no trouble, and without faces there are no answers") {
    SurfaceView view;
    view.positions = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)};
    view.faces = {{0, 1, 2}};
    std::vector<surface::FacePoint> found;
    surface::nearest_faces(view, std::vector<Vec3>{Vec3(0.5, 1, 0)}, found);
    REQUIRE(found.size() == 1);
    CHECK(found[0].distance == doctest::Approx(1.0));
    CHECK(found[0].weights[0] == doctest::Approx(0.75));
    CHECK(found[0].weights[2] == doctest::Approx(0.25));
    view.faces.clear();
    surface::nearest_faces(view, std::vector<Vec3>{Vec3(0.5, 1, 0)}, found);
    CHECK(found.empty());
}

TEST_CASE("the support of a vertex is the area of its points over its own area, at most 1") {
    // Two triangles of area 1/2 with a common side: the vertices 1 and 2 have 1/3, 0 and 3 have
    // 1/6.
    SurfaceView view;
    view.vertex_ids = {0, 1, 2, 3};
    view.positions = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)};
    view.faces = {{0, 1, 2}, {1, 3, 2}};
    view.face_areas = {0.5, 0.5};
    view.face_offsets = {0, 1, 3, 5, 6};
    view.vertex_faces = {0, 0, 1, 0, 1, 1};
    const std::vector<surface::FacePoint> places = {{0, {0.5, 0.5, 0.0}, 0.0},
                                                    {1, {0.25, 0.0, 0.75}, 0.1},
                                                    {1, {0.0, 1.0, 0.0}, 9.0},
                                                    {0, {1.0, 0.0, 0.0}, 9.0}};
    const std::vector<double> areas = {0.1, 0.2, 5.0, 0.0};  // the last one does not count
    std::vector<double> support = {7.0};
    surface::vertex_support(view, places, areas, support);
    REQUIRE(support.size() == 4);
    CHECK(support[0] == doctest::Approx(0.05 * 6));
    CHECK(support[1] == doctest::Approx((0.05 + 0.05) * 3));
    CHECK(support[2] == doctest::Approx(0.15 * 3));
    CHECK(support[3] == 1.0);
    surface::vertex_support(view, {}, {}, support);
    CHECK(support == std::vector<double>(4, 0.0));
}
