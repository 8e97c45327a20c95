#include "dsc/sdk/surfaces.hpp"

#include <cmath>
#include <map>
#include <utility>

#include <dsc/geometry/quality.hpp>
#include <dsc/surface/measure.hpp>

namespace dsc::sdk {
namespace {

using Face = std::array<std::uint32_t, 3>;

surface::TriangleMesh icosahedron() {
    const double g = 0.5 * (1.0 + std::sqrt(5.0));
    surface::TriangleMesh mesh;
    mesh.points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                   {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    mesh.faces = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                  {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                  {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                  {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    for (Vec3& p : mesh.points) p.normalize();
    return mesh;
}

surface::TriangleMesh split_in_four(const surface::TriangleMesh& mesh) {
    surface::TriangleMesh fine{mesh.points, {}};
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [place, is_new] =
            middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(fine.points.size()));
        if (is_new) fine.points.push_back((mesh.points[a] + mesh.points[b]).normalized());
        return place->second;
    };
    for (const auto& [a, b, c] : mesh.faces) {
        const std::uint32_t ab = middle(a, b);
        const std::uint32_t bc = middle(b, c);
        const std::uint32_t ca = middle(c, a);
        fine.faces.insert(fine.faces.end(),
                          {Face{a, ab, ca}, Face{ab, b, bc}, Face{ca, bc, c}, Face{ab, bc, ca}});
    }
    return fine;
}

void fill_faces(const surface::TriangleMesh& mesh, surface::SurfaceView& view) {
    view.faces = mesh.faces;
    view.face_tets.assign(mesh.faces.size(), mesh::none);
    view.face_labels.assign(mesh.faces.size(), {0, 1});
    for (const auto& [a, b, c] : mesh.faces) {
        const Vec3& p = mesh.points[a];
        const Vec3& q = mesh.points[b];
        const Vec3& r = mesh.points[c];
        view.face_normals.push_back(geometry::triangle_normal(p, q, r));
        view.face_areas.push_back(geometry::triangle_area(p, q, r));
    }
    view.mean_edge = surface::mean_edge(mesh.points, mesh.faces);
}

void fill_vertex_faces(surface::SurfaceView& view) {
    std::vector<std::vector<std::uint32_t>> around(view.positions.size());
    for (std::uint32_t f = 0; f < view.faces.size(); ++f) {
        for (const std::uint32_t v : view.faces[f]) around[v].push_back(f);
    }
    view.face_offsets.push_back(0);
    for (const auto& list : around) {
        view.vertex_faces.insert(view.vertex_faces.end(), list.begin(), list.end());
        view.face_offsets.push_back(static_cast<std::uint32_t>(view.vertex_faces.size()));
    }
}

}  // namespace

surface::TriangleMesh icosphere(unsigned level, double radius) {
    surface::TriangleMesh mesh = icosahedron();
    for (unsigned i = 0; i < level; ++i) mesh = split_in_four(mesh);
    for (Vec3& p : mesh.points) p *= radius;
    return mesh;
}

surface::TriangleMesh square(unsigned n, double half) {
    surface::TriangleMesh mesh;
    const auto at = [n](unsigned i, unsigned j) { return j * (n + 1) + i; };
    for (unsigned j = 0; j <= n; ++j) {
        for (unsigned i = 0; i <= n; ++i)
            mesh.points.emplace_back(half * (2.0 * i / n - 1), half * (2.0 * j / n - 1), 0.0);
    }
    for (unsigned j = 0; j < n; ++j) {
        for (unsigned i = 0; i < n; ++i) {
            mesh.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            mesh.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
    return mesh;
}

surface::SurfaceView view_of(const surface::TriangleMesh& mesh) {
    surface::SurfaceView view;
    const std::size_t count = mesh.points.size();
    view.vertex_ids.assign(count, mesh::none);
    for (std::uint32_t i = 0; i < count; ++i) view.births.push_back(i);
    view.positions = mesh.points;
    view.movable.assign(count, 1);
    view.previous_positions = view.positions;
    view.arrived.assign(count, 1);
    view.age.assign(count, 0);
    fill_faces(mesh, view);
    fill_vertex_faces(view);
    for (std::size_t i = 0; i < count; ++i) {
        Vec3 sum = Vec3::Zero();
        for (const std::uint32_t f : view.faces_of(i)) sum += view.face_normals[f];
        view.normals.push_back(sum.norm() < 1e-8 ? Vec3::Zero() : Vec3(sum.normalized()));
    }
    return view;
}

surface::TriangleMesh moved(surface::TriangleMesh mesh,
                            const std::function<Vec3(const Vec3&)>& move) {
    for (Vec3& p : mesh.points) p = move(p);
    return mesh;
}

}  // namespace dsc::sdk
