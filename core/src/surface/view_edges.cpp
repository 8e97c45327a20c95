#include <algorithm>

#include <dsc/surface/surface_view.hpp>

namespace dsc::surface {

void build_edges(const SurfaceView& view, std::vector<ViewEdge>& edges) {
    edges.clear();
    edges.reserve(3 * view.face_count());
    for (std::uint32_t f = 0; f < view.face_count(); ++f) {
        const auto& face = view.faces[f];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = face[k], b = face[(k + 1) % 3];
            edges.push_back({{std::min(a, b), std::max(a, b)}, {f, mesh::none}, 1});
        }
    }
    std::sort(edges.begin(), edges.end(), [](const ViewEdge& x, const ViewEdge& y) {
        return x.vertices != y.vertices ? x.vertices < y.vertices : x.faces[0] < y.faces[0];
    });
    std::size_t kept = 0;
    for (const ViewEdge& edge : edges) {
        if (kept == 0 || edges[kept - 1].vertices != edge.vertices) {
            edges[kept++] = edge;
            continue;
        }
        ViewEdge& same = edges[kept - 1];
        if (same.face_count == 1) same.faces[1] = edge.faces[0];
        ++same.face_count;
    }
    edges.resize(kept);
}

}  // namespace dsc::surface
