#include "attachments.hpp"

#include <algorithm>

#include <doctest/doctest.h>

#include <dsc/sdk/surfaces.hpp>

#include "solver.hpp"

using dsc::Vec3;
using namespace dsc::strategies::fit;

namespace {

/// The two triangles of a square, and the nearest places of the points on them.
struct Square {
    explicit Square(std::vector<Vec3> p) : points(std::move(p)) {
        dsc::surface::TriangleMesh mesh;
        mesh.points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};
        mesh.faces = {{0, 1, 2}, {0, 2, 3}};
        view = dsc::sdk::view_of(mesh);
        dsc::surface::nearest_faces(view, points, places, nullptr);
    }
    std::vector<std::uint32_t> attached(double reach) const {
        std::vector<std::uint32_t> out;
        attach_vertices(view, points, places, std::vector<double>(4, 1.0), reach, out);
        return out;
    }
    std::vector<Vec3> points;
    dsc::surface::SurfaceView view;
    std::vector<dsc::surface::FacePoint> places;
};

}  // namespace

TEST_CASE("a vertex is attached to the nearest of the points at it, within its reach, and every "
          "point to one vertex at most") {
    const Square square(
        {Vec3(0.3, 0.1, 0), Vec3(0.1, 0.05, 0.1), Vec3(0.9, 0.5, 0), Vec3(0.2, 0.95, 0)});
    std::vector<std::uint32_t> expected(4, no_point);
    const auto vertex = [&](const Vec3& at) {
        std::size_t v = 0;
        while ((square.view.positions[v] - at).norm() > 1e-12) ++v;
        return v;
    };
    expected[vertex(Vec3(0, 0, 0))] = 1;
    expected[vertex(Vec3(0, 1, 0))] = 3;
    CHECK(square.attached(0.4) == expected);
    const auto wide = square.attached(0.7);
    CHECK(std::count(wide.begin(), wide.end(), 2U) == 1);
}

TEST_CASE("an attached vertex moves to its point, and the others stay") {
    const Square square({Vec3(0.1, 0.05, 0.1)});
    const auto attached = square.attached(0.7);
    RowSystem system;
    system.rows.resize(12);
    system.wanted.resize(12);
    system.holds.assign(4, Hold{1e-9, Vec3::Zero()});
    attachment_rows(square.view, square.points, attached, std::vector<double>(4, 0.5), 0, system,
                    nullptr);
    gather_rows(system, square.view.movable);
    Solver solver;
    std::vector<Vec3> u;
    solver.solve(system, {}, nullptr, u);
    for (std::size_t v = 0; v < 4; ++v) {
        const Vec3 place = square.view.positions[v] + u[v];
        const Vec3 wanted =
            attached[v] == no_point ? square.view.positions[v] : square.points[attached[v]];
        CHECK((place - wanted).norm() < 1e-6);
    }
    CHECK(std::count(attached.begin(), attached.end(), no_point) == 3);
}
