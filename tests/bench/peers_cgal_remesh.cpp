// CGAL's tetrahedral isotropic remeshing. Parts of CGAL are under the GPL, so it is in tests only.
#include <algorithm>
#include <iostream>
#include <sstream>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/File_medit.h>
#include <CGAL/Tetrahedral_remeshing/Remeshing_triangulation_3.h>
#include <CGAL/property_map.h>
#include <CGAL/tetrahedral_remeshing.h>
#include <CGAL/version.h>

#include <dsc/base/error.hpp>

#include "peers.hpp"

namespace dsc::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangulation = CGAL::Tetrahedral_remeshing::Remeshing_triangulation_3<Kernel>;
using Vertex = Triangulation::Vertex_handle;
using Edges = std::unordered_set<std::pair<Vertex, Vertex>, boost::hash<std::pair<Vertex, Vertex>>>;

/// Its reader says on the standard output what it reads.
class QuietOutput {
public:
    QuietOutput() : before_(std::cout.rdbuf(nullptr)) {}
    ~QuietOutput() {
        std::cout.rdbuf(before_);
        std::cout.clear();
    }
    QuietOutput(const QuietOutput&) = delete;
    QuietOutput& operator=(const QuietOutput&) = delete;

private:
    std::streambuf* before_;
};

/// MEDIT is the form in which CGAL takes any tets. Cells of subdomain 0 would not be remeshed, so
/// labels are raised by 1.
Triangulation triangulation_of(const mesh::TetMesh& mesh) {
    std::stringstream text;
    text.precision(17);
    text << "MeshVersionFormatted 2\nDimension 3\nVertices\n" << mesh.points.size() << '\n';
    for (const Vec3& p : mesh.points) text << p.x() << ' ' << p.y() << ' ' << p.z() << " 0\n";
    text << "Tetrahedra\n" << mesh.tets.size() << '\n';
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        for (const std::uint32_t v : mesh.tets[t]) text << v + 1 << ' ';
        text << mesh.labels[t] + 1 << '\n';
    }
    text << "End\n";
    Triangulation triangulation;
    const QuietOutput quiet;
    if (!CGAL::IO::read_MEDIT(text, triangulation))
        throw GeometryError("bench.cgal", "the mesh of the comparison", "is not accepted by CGAL",
                            "please report it");
    return triangulation;
}

/// The edges of the box, which are no feature for CGAL because only one subdomain touches them.
Edges box_edges(const Triangulation& triangulation, const Box3& box) {
    Edges edges;
    for (const auto& [cell, i, j] : triangulation.finite_edges()) {
        const Vertex a = cell->vertex(i), b = cell->vertex(j);
        int walls = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const double x = a->point()[axis];
            if (x == b->point()[axis] && (x == box.low[axis] || x == box.high[axis])) ++walls;
        }
        if (walls > 1) edges.insert(std::minmax(a, b));
    }
    return edges;
}

mesh::TetMesh plain(const Triangulation& triangulation) {
    mesh::TetMesh mesh;
    std::unordered_map<Vertex, std::uint32_t, boost::hash<Vertex>> number;
    for (const Vertex v : triangulation.finite_vertex_handles()) {
        number[v] = static_cast<std::uint32_t>(mesh.points.size());
        mesh.points.emplace_back(v->point().x(), v->point().y(), v->point().z());
    }
    for (const auto cell : triangulation.finite_cell_handles()) {
        mesh.tets.push_back({number.at(cell->vertex(0)), number.at(cell->vertex(1)),
                             number.at(cell->vertex(2)), number.at(cell->vertex(3))});
        mesh.labels.push_back(cell->subdomain_index() - 1);
    }
    return mesh;
}

}  // namespace

std::string cgal_version() { return CGAL_VERSION_STR; }

Remeshed remesh_with_cgal(const mesh::TetMesh& mesh, double edge_length) {
    Triangulation triangulation = triangulation_of(mesh);
    Edges features = box_edges(triangulation, bounding_box(mesh.points));
    Remeshed result;
    result.cost = cost_of([&] {
        CGAL::tetrahedral_isotropic_remeshing(
            triangulation, edge_length,
            CGAL::parameters::number_of_iterations(1).edge_is_constrained_map(
                CGAL::Boolean_property_map<Edges>(features)));
    });
    result.mesh = plain(triangulation);
    return result;
}

}  // namespace dsc::bench
