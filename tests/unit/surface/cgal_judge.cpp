#include "cgal_judge.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/intersections.h>

namespace dsc::surface::test {
namespace {

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using Face = std::array<std::uint32_t, 3>;

std::vector<std::uint32_t> common(const Face& f, const Face& g) {
    std::vector<std::uint32_t> out;
    for (const std::uint32_t v : f) {
        if (std::find(g.begin(), g.end(), v) != g.end()) out.push_back(v);
    }
    return out;
}

/// Constructs the intersection exactly and compares it with the simplex that the faces share.
bool meet(const std::vector<Exact::Point_3>& points, const Face& f, const Face& g) {
    const Exact::Triangle_3 s(points[f[0]], points[f[1]], points[f[2]]),
        t(points[g[0]], points[g[1]], points[g[2]]);
    if (s.is_degenerate() || t.is_degenerate() || !CGAL::do_overlap(s.bbox(), t.bbox()))
        return false;
    const auto shared = common(f, g);
    if (shared.empty()) return CGAL::do_intersect(s, t);
    const auto result = CGAL::intersection(s, t);
    if (!result) throw std::logic_error("faces that share a point must intersect");
    if (const auto* point = boost::get<Exact::Point_3>(&*result)) {
        return shared.size() != 1 || *point != points[shared[0]];
    }
    if (const auto* segment = boost::get<Exact::Segment_3>(&*result)) {
        if (shared.size() != 2) return true;
        const Exact::Segment_3 edge(points[shared[0]], points[shared[1]]);
        return *segment != edge && segment->opposite() != edge;
    }
    return true;
}

}  // namespace

FacePairs cgal_soup_intersections(const TriangleMesh& mesh) {
    std::vector<Exact::Point_3> points;
    for (const Vec3& p : mesh.points) points.emplace_back(p.x(), p.y(), p.z());
    FacePairs out;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        for (std::uint32_t g = f + 1; g < mesh.faces.size(); ++g) {
            if (meet(points, mesh.faces[f], mesh.faces[g])) out.push_back({f, g});
        }
    }
    return out;
}

FacePairs cgal_mesh_intersections(const TriangleMesh& mesh) {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
    Mesh built;
    std::vector<Mesh::Vertex_index> vertices;
    for (const Vec3& p : mesh.points)
        vertices.push_back(built.add_vertex(Kernel::Point_3(p.x(), p.y(), p.z())));
    for (const auto& [a, b, c] : mesh.faces) {
        if (built.add_face(vertices[a], vertices[b], vertices[c]) == Mesh::null_face()) {
            throw std::logic_error("not a manifold mesh");
        }
    }
    std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> found;
    CGAL::Polygon_mesh_processing::self_intersections(built, std::back_inserter(found));
    FacePairs out;
    for (const auto& [f, g] : found) {
        const std::uint32_t i = f, j = g;
        if (i != j) out.push_back({std::min(i, j), std::max(i, j)});
    }
    std::sort(out.begin(), out.end());
    return out;
}

double cgal_squared_distance(const Vec3& p, const TriangleMesh& mesh) {
    const auto point = [](const Vec3& v) { return Exact::Point_3(v.x(), v.y(), v.z()); };
    bool first = true;
    Exact::FT best;
    for (const auto& [a, b, c] : mesh.faces) {
        const Exact::Triangle_3 triangle(point(mesh.points[a]), point(mesh.points[b]),
                                         point(mesh.points[c]));
        const Exact::FT d = CGAL::squared_distance(point(p), triangle);
        if (first || d < best) best = d;
        first = false;
    }
    return CGAL::to_double(best);
}

}  // namespace dsc::surface::test
