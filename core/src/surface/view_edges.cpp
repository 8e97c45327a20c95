// The edges of a surface view.
#include <algorithm>

#include <dsc/surface/surface_view.hpp>

namespace dsc::surface {

void build_edges(const SurfaceView& view, std::vector<ViewEdge>& edges) {
    // Each vertex has few edges to later vertices: they are grouped by the first vertex and then
    // sorted.
    static thread_local std::vector<std::uint32_t> starts;
    const std::size_t n = view.vertex_count();
    starts.assign(n + 2, 0);
    for (const auto& face : view.faces) {
        for (std::size_t k = 0; k < 3; ++k) ++starts[std::min(face[k], face[(k + 1) % 3]) + 2];
    }
    for (std::size_t i = 2; i < starts.size(); ++i) starts[i] += starts[i - 1];
    edges.resize(3 * view.face_count());
    for (std::uint32_t f = 0; f < view.face_count(); ++f) {
        const auto& face = view.faces[f];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = face[k], b = face[(k + 1) % 3];
            edges[starts[std::min(a, b) + 1]++] = {
                {std::min(a, b), std::max(a, b)}, {f, mesh::none}, 1};
        }
    }
    std::size_t kept = 0;
    for (std::size_t v = 0; v < n; ++v) {
        const auto first = edges.begin() + static_cast<std::ptrdiff_t>(starts[v]),
                   last = edges.begin() + static_cast<std::ptrdiff_t>(starts[v + 1]);
        // Grouped in the order of the faces; a stable sort keeps this order among equal edges.
        std::stable_sort(first, last, [](const ViewEdge& x, const ViewEdge& y) {
            return x.vertices[1] < y.vertices[1];
        });
        const std::size_t own = kept;
        for (auto edge = first; edge != last; ++edge) {
            if (kept == own || edges[kept - 1].vertices != edge->vertices) {
                edges[kept++] = *edge;
                continue;
            }
            ViewEdge& same = edges[kept - 1];
            if (same.face_count == 1) same.faces[1] = edge->faces[0];
            ++same.face_count;
        }
    }
    edges.resize(kept);
}

}  // namespace dsc::surface
