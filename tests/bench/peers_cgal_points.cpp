// What CGAL makes of points: its alpha wrap, and consistent directions of normals. Parts of CGAL
// are under the GPL, so it is in tests only.
#include <algorithm>
#include <cstdint>
#include <utility>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>
#include <CGAL/mst_orient_normals.h>
#include <CGAL/property_map.h>

#include "peers.hpp"

namespace dsc::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

surface::TriangleMesh plain(const Mesh& mesh) {
    surface::TriangleMesh result;
    std::vector<std::uint32_t> number(mesh.number_of_vertices() +
                                      mesh.number_of_removed_vertices());
    for (const Mesh::Vertex_index v : mesh.vertices()) {
        number[v] = static_cast<std::uint32_t>(result.points.size());
        const Point& p = mesh.point(v);
        result.points.emplace_back(p.x(), p.y(), p.z());
    }
    for (const Mesh::Face_index f : mesh.faces()) {
        std::array<std::uint32_t, 3> corners{};
        std::size_t i = 0;
        for (const Mesh::Vertex_index v : mesh.vertices_around_face(mesh.halfedge(f)))
            corners.at(i++) = number[v];
        result.faces.push_back(corners);
    }
    return result;
}

}  // namespace

Reconstructed wrap_with_cgal(std::span<const Vec3> points, double alpha, double offset) {
    std::vector<Point> cloud;
    for (const Vec3& p : points) cloud.emplace_back(p.x(), p.y(), p.z());
    const double diagonal = bounding_box(points).diagonal();
    Mesh wrap;
    Reconstructed result;
    result.cost =
        cost_of([&] { CGAL::alpha_wrap_3(cloud, alpha * diagonal, offset * diagonal, wrap); });
    result.surface = plain(wrap);
    return result;
}

void orient_with_cgal(std::vector<Vec3>& points, std::vector<Vec3>& normals, unsigned neighbours) {
    using Oriented = std::pair<Point, Kernel::Vector_3>;
    std::vector<Oriented> cloud;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3 &p = points[i], &n = normals[i];
        cloud.emplace_back(Point(p.x(), p.y(), p.z()), Kernel::Vector_3(n.x(), n.y(), n.z()));
    }
    const auto maps = CGAL::parameters::point_map(CGAL::First_of_pair_property_map<Oriented>())
                          .normal_map(CGAL::Second_of_pair_property_map<Oriented>());
    cloud.erase(CGAL::mst_orient_normals(cloud, neighbours, maps), cloud.end());
    points.clear();
    normals.clear();
    for (const auto& [p, n] : cloud) {
        points.emplace_back(p.x(), p.y(), p.z());
        normals.emplace_back(n.x(), n.y(), n.z());
    }
}

}  // namespace dsc::bench
