#include "edge_mesh.hpp"

#include <cmath>

namespace dsc::remesh {
namespace {

constexpr std::size_t edge_block = 4096;
constexpr double no_angle = 2.0;
const double crease_cosine = std::cos(crease_angle);

}  // namespace

void EdgeMesh::build(const surface::SurfaceView& from, Workers* workers) {
    view = &from;
    surface::build_edges(from, edges);
    lengths.resize(edges.size());
    cosines.resize(edges.size());
    for_blocks(workers, edges.size(), edge_block, [this](std::size_t begin, std::size_t end) {
        for (std::size_t e = begin; e < end; ++e) {
            const surface::ViewEdge& edge = edges[e];
            lengths[e] = (place(edge.vertices[0]) - place(edge.vertices[1])).norm();
            cosines[e] =
                edge.face_count == 2
                    ? view->face_normals[edge.faces[0]].dot(view->face_normals[edge.faces[1]])
                    : no_angle;
        }
    });
    creases.assign(from.vertex_count(), 0);
    fixed.assign(from.vertex_count(), 0);
    for (std::uint32_t v = 0; v < from.vertex_count(); ++v) fixed[v] = from.movable[v] == 0 ? 1 : 0;
    for (std::size_t e = 0; e < edges.size(); ++e) {
        for (const std::uint32_t v : edges[e].vertices) {
            if (edges[e].face_count != 2) fixed[v] = 1;
            if (is_crease(e) && creases[v] < 255) ++creases[v];
        }
    }
}

bool EdgeMesh::is_crease(std::size_t edge) const { return cosines[edge] < crease_cosine; }

std::uint32_t EdgeMesh::opposite(std::size_t edge, unsigned side) const {
    const auto& [a, b] = edges[edge].vertices;
    for (const std::uint32_t v : view->faces[edges[edge].faces[side]]) {
        if (v != a && v != b) return v;
    }
    return a;  // not a corner of a triangle
}

}  // namespace dsc::remesh
