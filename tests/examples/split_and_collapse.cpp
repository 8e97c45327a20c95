// You learn how to change a complex edge by edge: splits by your own edits, collapses by requests.
#include <iostream>

#include <dsc/generate/shape_mesh.hpp>
#include <dsc/kernel/deformer.hpp>
#include <dsc/mesh/adopt.hpp>
#include <dsc/mesh/validate.hpp>
#include <dsc/surface/surface_view.hpp>

using namespace dsc;

/// Splits an edge at its midpoint: each tet of its ring becomes two tets. Returns the new vertex.
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
    std::cout << what << ": " << counts.vertices << " vertices, Euler number " << counts.euler()
              << ", " << mesh::validate(complex).faults.size() << " faults\n";
}

int main() {
    const std::vector<generate::Shape> ball = {{.radius = 0.6}};
    mesh::Complex complex =
        mesh::adopt(generate::make_shape_mesh({.cells = 16}, ball, "ball"), "ball");
    print("at the start", complex);

    // Split every edge of the interface, and note how to undo it: the last split comes first.
    surface::SurfaceView view;
    std::vector<surface::ViewEdge> edges;
    surface::build_view(complex, view);
    surface::build_edges(view, edges);
    kernel::RefineRequests requests;
    for (const surface::ViewEdge& edge : edges) {
        const mesh::VertexId kept = view.vertex_ids[edge.vertices[0]];
        const mesh::VertexId added = split(complex, kept, view.vertex_ids[edge.vertices[1]]);
        const kernel::CollapseTo undo{kept, added, complex.position(kept)};
        requests.collapses.insert(requests.collapses.begin(), undo);
    }
    print("all edges split", complex);
    // The Deformer commits a collapse only if all tets stay positive and the interface a manifold.
    kernel::Deformer deformer(std::move(complex));
    const kernel::RefineReport report = deformer.refine(requests);
    std::cout << report.committed << " of " << report.requested << " collapses committed\n";
    print("new vertices collapsed", deformer.complex());
}
