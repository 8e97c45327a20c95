// Converts the requests and attributes of a refinement for the kernel.
#include "refinement.hpp"

#include <algorithm>

namespace dsc::run {
namespace {

using ViewEdge = std::array<std::uint32_t, 2>;

/// Edges longer than the mean of the wanted lengths at their ends; each once, in ascending order.
std::vector<ViewEdge> too_long(const surface::SurfaceView& view,
                               const std::vector<double>& sizing) {
    std::vector<ViewEdge> edges;
    if (sizing.empty()) return edges;
    for (const auto& face : view.faces) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = face[i], b = face[(i + 1) % 3];
            const double length = (view.positions[a] - view.positions[b]).norm();
            if (length > 0.5 * (sizing[a] + sizing[b]))
                edges.push_back({std::min(a, b), std::max(a, b)});
        }
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

}  // namespace

void set_attributes(kernel::Deformer& deformer, const surface::SurfaceView& view,
                    const hooks::Attributes& attributes) {
    for (const hooks::Attribute& a : attributes)
        deformer.set_attribute(a.name, view.vertex_ids, a.values);
}

hooks::Attributes attributes_at(const kernel::Deformer& deformer,
                                std::span<const mesh::VertexId> vertices) {
    hooks::Attributes all;
    for (const std::string& name : deformer.attributes())
        all.push_back({name, deformer.attribute(name, vertices)});
    return all;
}

void set_fields(kernel::Deformer& deformer, const surface::SurfaceView& view,
                const hooks::RefinementRequests& requests) {
    if (requests.target_length > 0.0) deformer.set_target_length(requests.target_length);
    if (!requests.target_lengths.empty())
        deformer.set_target_lengths(view.vertex_ids, requests.target_lengths);
    set_attributes(deformer, view, requests.attributes);
}

std::optional<repair::CreaseRule> stricter(const std::optional<repair::CreaseRule>& a,
                                           const std::optional<repair::CreaseRule>& b) {
    if (!a || !b) return a ? a : b;
    return repair::CreaseRule{std::min(a->dihedral, b->dihedral), std::min(a->turn, b->turn)};
}

kernel::RefineRequests kernel_requests(const surface::SurfaceView& view,
                                       const hooks::RefinementRequests& requests,
                                       bool owns_sizing) {
    kernel::RefineRequests out;
    out.owns_sizing = owns_sizing;
    const auto id = [&view](std::uint32_t v) { return view.vertex_ids[v]; };
    for (const std::uint32_t f : requests.split_faces) {
        const auto& [a, b, c] = view.faces[f];
        out.split_faces.push_back({id(a), id(b), id(c)});
    }
    for (const auto& [a, b] : requests.split_edges) out.split_edges.push_back({id(a), id(b)});
    for (const auto& [a, b] : too_long(view, requests.sizing))
        out.split_edges.push_back({id(a), id(b)});
    for (const auto& r : requests.collapse_edges)
        out.collapses.push_back({id(r.kept), id(r.removed), r.place});
    for (const auto& r : requests.flip_edges)
        out.flips.push_back({id(r.edge[0]), id(r.edge[1]), r.flatness});
    for (const auto& r : requests.move_vertices) out.moves.push_back({id(r.vertex), r.place});
    return out;
}

}  // namespace dsc::run
