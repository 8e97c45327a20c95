// Grows and measures sets of tets for a change of topology (method.md, sections 8.2 and 8.3).
#include "kernel/region.hpp"

#include <cmath>
#include <numbers>
#include <numeric>

#include <dsc/geometry/quality.hpp>

namespace dsc::kernel {
namespace {

constexpr std::size_t max_region = 24;
constexpr double max_region_volume = 8.0;  // in regular tets of edge L
constexpr int max_growth = 10;

}  // namespace

struct RegionScratch {
    struct BoundaryFace {
        std::array<VertexId, 3> v;
        bool faces_to;  // faces `to`, else `from`
        double area;
    };
    struct BoundaryEdge {
        VertexId a, b;
        std::uint32_t face;
    };
    // Of the growth.
    std::vector<VertexId> concerned;  // vertices of the region,
    std::vector<VertexId> checked;    // and those that are known to stay regular
    std::vector<std::size_t> group_size;
    std::vector<char> is_from, has_outside;
    std::vector<std::uint32_t> group, previous, distance, queue;
    std::vector<TetId> addition_group, addition_chain;
    // Of the measurement.
    std::vector<BoundaryFace> faces;
    std::vector<BoundaryEdge> edges;
    std::vector<VertexId> vertices;
    std::vector<std::uint32_t> whole, patch, from_roots, to_roots;
};

namespace {

using BoundaryFace = RegionScratch::BoundaryFace;
using BoundaryEdge = RegionScratch::BoundaryEdge;

std::uint32_t root(std::vector<std::uint32_t>& parent, std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
}

bool contains(const std::vector<std::uint32_t>& list, std::uint32_t id) {
    return std::find(list.begin(), list.end(), id) != list.end();
}

}  // namespace

bool touches_box(const mesh::Complex& c, TetId t) {
    const auto& v = c.tet(t).v;
    return std::any_of(v.begin(), v.end(), [&c](VertexId x) { return c.on_box(x); });
}

double thickness(const Region& region) {
    if (region.patches_from == 2) return 2.0 * std::sqrt(0.5 * region.area_from / std::numbers::pi);
    return region.area_to > 0.0 ? 2.0 * region.volume / region.area_to : INFINITY;
}

namespace {

void collect_vertices(const mesh::Complex& c, const Region& region, std::vector<VertexId>& out) {
    out.clear();
    for (const TetId t : region.tets) out.insert(out.end(), c.tet(t).v.begin(), c.tet(t).v.end());
    std::sort(out.begin(), out.end(),
              [&c](VertexId a, VertexId b) { return c.birth(a) < c.birth(b); });
    out.erase(std::unique(out.begin(), out.end()), out.end());
}

// The smallest group of `from` at the vertex if there are two or more: addition_group receives its
// tets.
void smallest_group(mesh::LocalStar& star, mesh::Label from, RegionScratch& own) {
    std::vector<TetId>& out = own.addition_group;
    out.clear();
    const unsigned count = star.groups();
    std::vector<std::size_t>& size = own.group_size;
    std::vector<char>&is_from = own.is_from, &has_outside = own.has_outside;
    size.assign(count, 0);
    is_from.assign(count, 0);
    has_outside.assign(count, 0);
    for (std::size_t i = 0; i < star.nodes().size(); ++i) {
        ++size[star.group_of()[i]];
        is_from[star.group_of()[i]] = star.label(i) == from ? 1 : 0;
        if (star.nodes()[i] == mesh::none) has_outside[star.group_of()[i]] = 1;
    }
    unsigned best = count, groups = 0;
    for (unsigned g = 0; g < count; ++g) {
        if (is_from[g] == 0) continue;
        ++groups;
        if (has_outside[g] == 0 && (best == count || size[g] < size[best])) best = g;
    }
    if (groups < 2 || best == count) return;
    for (std::size_t i = 0; i < star.nodes().size(); ++i) {
        if (star.group_of()[i] == best) out.push_back(star.nodes()[i]);
    }
}

// The shortest face-connected chain of `from` tets that joins two groups of label `to` at the
// vertex: addition_chain receives it.
void shortest_chain(mesh::LocalStar& star, mesh::Label from, mesh::Label to, RegionScratch& own) {
    std::vector<TetId>& out = own.addition_chain;
    out.clear();
    star.groups();
    const std::size_t n = star.nodes().size();
    std::vector<std::uint32_t>&group = own.group, &previous = own.previous,
    &distance = own.distance, &queue = own.queue;
    group.assign(star.group_of().begin(), star.group_of().end());
    std::size_t best = n + 1;
    for (std::size_t start = 0; start < n; ++start) {
        if (star.label(start) != to) continue;
        // Breadth-first from all nodes of a group, because a chain may leave from any of them.
        previous.assign(n, mesh::none);
        distance.assign(n, mesh::none);
        queue.clear();
        distance[start] = 0;
        queue.push_back(static_cast<std::uint32_t>(start));
        for (std::size_t i = 0; i < queue.size(); ++i) {
            const std::uint32_t node = queue[i];
            if (distance[node] + 1 > best) break;
            for (const std::uint32_t next : star.neighbours(node)) {
                if (next == mesh::none || distance[next] != mesh::none) continue;
                if (star.label(next) == to && group[next] != group[start] && node != start) {
                    if (distance[node] < best) {
                        best = distance[node];
                        out.clear();
                        for (std::uint32_t back = node; back != start; back = previous[back])
                            out.push_back(star.nodes()[back]);
                    }
                } else if (star.label(next) == from && star.nodes()[next] != mesh::none) {
                    distance[next] = distance[node] + 1;
                    previous[next] = node;
                    queue.push_back(next);
                }
            }
        }
    }
}

}  // namespace

bool regular(Workbench& bench, const Region& region) {
    std::vector<VertexId>& vertices = bench.region.get().concerned;
    collect_vertices(bench.complex, region, vertices);
    mesh::LocalStar& star = bench.local_star();
    return std::all_of(vertices.begin(), vertices.end(), [&](VertexId v) {
        star.build(v, region.tets, region.to);
        return star.regular();
    });
}

RegionFault grow(Workbench& bench, Region& region) {
    const mesh::Complex& c = bench.complex;
    const double volume_limit =
        max_region_volume *
        geometry::regular_tet_volume(bench.length_at(c.tet(region.tets.front()).v));
    mesh::LocalStar& star = bench.local_star();
    RegionScratch& own = bench.region.get();
    const std::vector<TetId>&group = own.addition_group, &chain = own.addition_chain;
    own.checked.clear();
    for (int round = 0; round <= max_growth; ++round) {
        double volume = 0.0;
        for (const TetId t : region.tets) {
            volume += c.volume(t);
            if (touches_box(c, t)) return RegionFault::box;
        }
        if (region.tets.size() > max_region || volume > volume_limit) return RegionFault::too_large;
        collect_vertices(c, region, own.concerned);
        const auto bad = std::find_if(own.concerned.begin(), own.concerned.end(), [&](VertexId v) {
            if (contains(own.checked, v)) return false;
            star.build(v, region.tets, region.to);
            if (!star.regular()) return true;
            own.checked.push_back(v);
            return false;
        });
        if (bad == own.concerned.end()) return RegionFault::none;
        // The star is still that of the vertex found.
        smallest_group(star, region.from, own);
        shortest_chain(star, region.from, region.to, own);
        const auto& addition =
            chain.empty() || (!group.empty() && group.size() <= chain.size()) ? group : chain;
        if (addition.empty()) return RegionFault::irregular;
        for (const TetId t : addition) {
            if (contains(region.tets, t)) continue;
            region.tets.push_back(t);
            const auto of_t = [&](VertexId v) { return mesh::has_vertex(c.tet(t), v); };
            own.checked.erase(std::remove_if(own.checked.begin(), own.checked.end(), of_t),
                              own.checked.end());
        }
    }
    return RegionFault::irregular;
}

RegionFault measure(Workbench& bench, Region& region) {
    const mesh::Complex& c = bench.complex;
    RegionScratch& own = bench.region.get();
    std::vector<BoundaryFace>& faces = own.faces;
    std::vector<BoundaryEdge>& edges = own.edges;
    std::vector<VertexId>& vertices = own.vertices;
    faces.clear();
    edges.clear();
    vertices.clear();
    region.volume = region.area_from = region.area_to = 0.0;
    region.centroid.setZero();
    for (const TetId t : region.tets) {
        const mesh::Tet& tet = c.tet(t);
        const double volume = c.volume(t);
        region.volume += volume;
        for (const VertexId v : tet.v) region.centroid += 0.25 * volume * c.position(v);
        for (unsigned f = 0; f < 4; ++f) {
            const std::uint32_t code = c.across(t, f);
            if (code == mesh::none) return RegionFault::box;
            if (contains(region.tets, mesh::neighbour_tet(code))) continue;
            const mesh::Label label = c.label_across(t, f);
            if (label != region.from && label != region.to) return RegionFault::labels;
            BoundaryFace face{{}, label == region.to, 0.0};
            for (unsigned k = 0; k < 3; ++k) face.v[k] = tet.v[mesh::face_vertices[f][k]];
            face.area = geometry::triangle_area(c.position(face.v[0]), c.position(face.v[1]),
                                                c.position(face.v[2]));
            (face.faces_to ? region.area_to : region.area_from) += face.area;
            for (unsigned k = 0; k < 3; ++k) {
                const VertexId a = face.v[k], b = face.v[(k + 1) % 3];
                edges.push_back(
                    {std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(faces.size())});
                vertices.push_back(a);
            }
            faces.push_back(face);
        }
    }
    region.centroid /= region.volume;
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    std::sort(edges.begin(), edges.end(), [](const BoundaryEdge& x, const BoundaryEdge& y) {
        return x.a != y.a ? x.a < y.a : x.b != y.b ? x.b < y.b : x.face < y.face;
    });
    std::vector<std::uint32_t>&whole = own.whole, &patch = own.patch;
    whole.resize(faces.size());
    patch.resize(faces.size());
    std::iota(whole.begin(), whole.end(), 0U);
    std::iota(patch.begin(), patch.end(), 0U);
    std::size_t edge_count = 0;
    for (std::size_t i = 0; i < edges.size(); i += 2, ++edge_count) {
        const bool pair =
            i + 1 < edges.size() && edges[i].a == edges[i + 1].a && edges[i].b == edges[i + 1].b;
        const bool third =
            i + 2 < edges.size() && edges[i].a == edges[i + 2].a && edges[i].b == edges[i + 2].b;
        if (!pair || third) return RegionFault::not_a_ball;
        const std::uint32_t f = edges[i].face, g = edges[i + 1].face;
        whole[root(whole, f)] = root(whole, g);
        if (faces[f].faces_to == faces[g].faces_to) patch[root(patch, f)] = root(patch, g);
    }
    std::vector<std::uint32_t>&from_roots = own.from_roots, &to_roots = own.to_roots;
    from_roots.clear();
    to_roots.clear();
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        if (root(whole, f) != root(whole, 0)) return RegionFault::not_a_ball;
        if (root(patch, f) == f) (faces[f].faces_to ? to_roots : from_roots).push_back(f);
    }
    if (vertices.size() + faces.size() != edge_count + 2) return RegionFault::not_a_ball;
    region.patches_from = static_cast<unsigned>(from_roots.size());
    region.patches_to = static_cast<unsigned>(to_roots.size());
    region.patch_a.clear();
    region.patch_b.clear();
    const auto& two = region.patches_from == 2 ? from_roots : to_roots;
    if (two.size() == 2) {
        for (std::uint32_t f = 0; f < faces.size(); ++f) {
            const std::uint32_t r = root(patch, f);
            if (r == two[0])
                region.patch_a.insert(region.patch_a.end(), faces[f].v.begin(), faces[f].v.end());
            if (r == two[1])
                region.patch_b.insert(region.patch_b.end(), faces[f].v.begin(), faces[f].v.end());
        }
    }
    return RegionFault::none;
}

}  // namespace dsc::kernel
