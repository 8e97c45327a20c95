#include "surface_links.hpp"

#include <numeric>

namespace dsc::strategies::fit {
namespace {

/// Whether a face contains the edge in the direction from -> to.
bool runs(const std::array<std::uint32_t, 3>& face, std::uint32_t from, std::uint32_t to) {
    return (face[0] == from && face[1] == to) || (face[1] == from && face[2] == to) ||
           (face[2] == from && face[0] == to);
}

std::uint32_t corner_off(const std::array<std::uint32_t, 3>& face, std::uint32_t a,
                         std::uint32_t b) {
    for (const std::uint32_t v : face) {
        if (v != a && v != b) return v;
    }
    return a;
}

void add_hinge(const surface::SurfaceView& view, const surface::ViewEdge& edge,
               std::vector<Hinge>& hinges) {
    if (edge.face_count != 2) return;
    const auto [a, b] = edge.vertices;
    auto [first, second] = edge.faces;
    if (!runs(view.faces[first], a, b)) std::swap(first, second);
    if (!runs(view.faces[first], a, b) || !runs(view.faces[second], b, a)) return;
    hinges.push_back(
        {{a, b, corner_off(view.faces[first], a, b), corner_off(view.faces[second], a, b)},
         {first, second}});
}

}  // namespace

void build_links(const surface::SurfaceView& view, SurfaceLinks& links) {
    std::vector<surface::ViewEdge> edges;
    surface::build_edges(view, edges);
    links.hinges.clear();
    links.hinges.reserve(edges.size());
    links.offsets.assign(view.vertex_count() + 1, 0);
    for (const surface::ViewEdge& edge : edges) {
        add_hinge(view, edge, links.hinges);
        for (const std::uint32_t v : edge.vertices) ++links.offsets[v + 1];
    }
    std::partial_sum(links.offsets.begin(), links.offsets.end(), links.offsets.begin());
    links.neighbours.resize(links.offsets.back());
    std::vector<std::uint32_t> place(links.offsets.begin(), links.offsets.end() - 1);
    for (const surface::ViewEdge& edge : edges) {
        links.neighbours[place[edge.vertices[0]]++] = edge.vertices[1];
        links.neighbours[place[edge.vertices[1]]++] = edge.vertices[0];
    }
}

double half_sine(const Vec3& first_normal, const Vec3& second_normal, const Vec3& edge) {
    const double sine = 0.5 * (first_normal - second_normal).norm();
    return first_normal.cross(second_normal).dot(edge) < 0.0 ? -sine : sine;
}

}  // namespace dsc::strategies::fit
