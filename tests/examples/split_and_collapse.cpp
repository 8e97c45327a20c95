// You learn how to change a complex edge by edge: split an edge by an edit of your own, then collapse edges.
#include <dsc/kernel/deformer.hpp>
#include <dsc/mesh/adopt.hpp>
#include <dsc/mesh/shape_mesh.hpp>
#include <dsc/mesh/validate.hpp>
#include <dsc/surface/surface_view.hpp>
#include <iostream>

using namespace dsc;

/// Splits the edge (a, b) at its midpoint: each tet of its ring becomes two tets. Returns the new vertex.
mesh::VertexId split(mesh::Complex& complex, mesh::VertexId a, mesh::VertexId b) {
    mesh::EdgeRing ring;
    complex.ring(complex.find_edge(a, b), a, b, ring);
    mesh::Edit edit;
    edit.removed = ring.tets;
    for (const mesh::TetId t : ring.tets) {
        for (const mesh::VertexId end : {a, b}) {
            mesh::NewTet half{complex.tet(t).v, complex.label(t)};
            half.v[mesh::index_of(complex.tet(t), end)] = mesh::created_vertex;
            edit.added.push_back(half);
        }
    }
    edit.creates = true;
    edit.created_at = 0.5 * (complex.position(a) + complex.position(b));
    return complex.link(edit) ? complex.replace(edit) : mesh::none;
}

void print(const char* what, const mesh::Complex& complex) {
    const mesh::InterfaceCounts counts = mesh::count_interface(complex);
    std::cout << what << ": " << counts.vertices << " vertices, Euler number " << counts.euler() << ", "
              << mesh::validate(complex).faults.size() << " faults\n";
}

int main() {
    const std::vector<mesh::Shape> ball = {{.radius = 0.6}};
    mesh::Complex complex = mesh::adopt(mesh::make_shape_mesh({.cells = 16}, ball, "ball"), "ball");
    print("start", complex);

    surface::SurfaceView view;
    std::vector<surface::ViewEdge> edges;
    surface::build_view(complex, view);
    surface::build_edges(view, edges);
    for (const auto& [ends, faces, face_count] : edges) split(complex, view.vertex_ids[ends[0]], view.vertex_ids[ends[1]]);
    print("all edges split", complex);

    // The Deformer commits a collapse only if all tets stay positive and the interface stays a manifold.
    surface::build_view(complex, view);
    surface::build_edges(view, edges);
    kernel::Deformer deformer(std::move(complex));
    kernel::RefineRequests requests;
    for (const auto& [ends, faces, face_count] : edges) {
        if ((view.positions[ends[0]] - view.positions[ends[1]]).norm() > 0.9 * view.mean_edge) continue;
        const mesh::VertexId kept = view.vertex_ids[ends[0]];
        requests.collapses.push_back({.kept = kept, .removed = view.vertex_ids[ends[1]], .place = view.positions[ends[0]]});
    }
    const kernel::RefineReport report = deformer.refine(requests);
    std::cout << report.committed << " of " << report.requested << " collapses committed\n";
    print("short edges collapsed", deformer.complex());
}
