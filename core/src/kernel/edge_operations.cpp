// Operations that re-triangulate round an edge: edge removal, interface flip, edge split
// (method.md, sections 4.3, 4.5, 4.6).
#include <cmath>

#include <dsc/geometry/quality.hpp>
#include <dsc/geometry/tet_pair.hpp>

#include "kernel/creases.hpp"
#include "kernel/operations.hpp"
#include "kernel/triangulations.hpp"

namespace dsc::kernel {

struct EdgeScratch {
    mesh::EdgeRing ring;
    std::vector<VertexId> corners;  // of the second polygon of a flip
};

namespace {

// The best triangulation of a polygon of ring vertices: each triangle makes one tet with b above
// and one with a below.
struct Fan {
    std::span<const VertexId> corners;  // counter-clockwise seen from b
    mesh::Label label;
    float least = 2.0F;  // of the best triangulation; 2 for a polygon of two corners
    std::uint64_t mask = 0;
};

// Finds the triangulation whose least quality is largest and above `must_exceed`; false if there is
// none.
bool triangulate(const mesh::Complex& c, VertexId a, VertexId b, float must_exceed, Fan& fan) {
    if (fan.corners.size() < 3) return true;
    const Triangulations& table = triangulations(fan.corners.size());
    const geometry::TwoVec3 ends = geometry::side_by_side(c.position(b), c.position(a));
    std::array<float, 35> quality{};
    std::uint64_t bad = 0;
    // Every triangulation has one of the first triangles, which contain the side (0, 1).
    const std::size_t at_side = fan.corners.size() - 2;
    const std::uint64_t all_at_side = (std::uint64_t{1} << at_side) - 1;
    for (std::size_t n = 0; n < table.triangle_count; ++n) {
        if (n == at_side && bad == all_at_side) return false;
        const Vec3& i = c.position(fan.corners[table.triangles[n].i]);
        const Vec3& j = c.position(fan.corners[table.triangles[n].j]);
        const Vec3& k = c.position(fan.corners[table.triangles[n].k]);
        // The two tets that add_tets() makes.
        using geometry::side_by_side;
        const auto q = static_cast<float>(
            geometry::tet_shapes({side_by_side(i, j), side_by_side(j, i), side_by_side(k, k), ends})
                .quality.minCoeff());
        quality[n] = q;
        if (!(q > must_exceed)) bad |= std::uint64_t{1} << n;
    }
    fan.least = must_exceed;
    for (std::size_t m = 0; m < table.count; ++m) {
        if ((table.masks[m] & bad) != 0) continue;
        float least = 2.0F;
        for (std::size_t n = 0; n < table.triangle_count; ++n) {
            if ((table.masks[m] >> n & 1U) != 0) least = std::min(least, quality[n]);
        }
        if (least > fan.least) {
            fan.least = least;
            fan.mask = table.masks[m];
        }
    }
    return fan.mask != 0;
}

void add_tets(Workbench& bench, VertexId a, VertexId b, const Fan& fan) {
    if (fan.corners.size() < 3) return;
    const Triangulations& table = triangulations(fan.corners.size());
    for (std::size_t n = 0; n < table.triangle_count; ++n) {
        if ((fan.mask >> n & 1U) == 0) continue;
        const VertexId i = fan.corners[table.triangles[n].i];
        const VertexId j = fan.corners[table.triangles[n].j];
        const VertexId k = fan.corners[table.triangles[n].k];
        bench.edit.added.push_back({{i, j, k, b}, fan.label});
        bench.edit.added.push_back({{j, i, k, a}, fan.label});
    }
}

// The removal of an edge that is best by quality.
struct Removal {
    Fan fan;
    float old = 1.0F, must_exceed = 0.0F;  // least qualities
};

// Reads the stars of a and b only.
Outcome choose(Workbench& bench, TetId t, VertexId a, VertexId b, float accept_above,
               Removal& removal) {
    const mesh::Complex& c = bench.complex;
    mesh::EdgeRing& ring = bench.edge.get().ring;
    // An edge with an end inside the box cannot be on the box. Most edges have another label or too
    // many tets round them, which shows before the whole ring is known.
    if (c.on_box(a) && c.on_box(b)) {
        c.ring(t, a, b, ring);
        if (!ring.closed) return Refusal::box;
    }
    if (!c.inner_ring(t, a, b, max_polygon, ring)) return Refusal::not_applicable;
    for (const TetId r : ring.tets) removal.old = std::min(removal.old, c.quality(r));
    removal.must_exceed = std::min(removal.old, accept_above);
    removal.fan = {ring.link, c.label(t)};
    return triangulate(c, a, b, removal.must_exceed, removal.fan) ? success
                                                                  : Outcome(Refusal::quality);
}

}  // namespace

Outcome may_remove(Workbench& bench, TetId t, VertexId a, VertexId b, float accept_above) {
    Removal removal;
    return choose(bench, t, a, b, accept_above, removal);
}

Outcome remove_edge(Workbench& bench, TetId t, VertexId a, VertexId b, float accept_above) {
    Removal removal;
    if (const Outcome o = choose(bench, t, a, b, accept_above, removal); o.refused()) return o;
    bench.edit.clear();
    bench.edit.removed = bench.edge.get().ring.tets;
    add_tets(bench, a, b, removal.fan);
    if (const Outcome o = bench.check_shape(removal.must_exceed, removal.old); o.refused())
        return o;
    if (!bench.complex.link(bench.edit)) return Refusal::irregular;
    bench.commit();
    return success;
}

Outcome flip_interface_edge(Workbench& bench, TetId t, VertexId a, VertexId b, float accept_above) {
    mesh::Complex& c = bench.complex;
    mesh::EdgeRing& ring = bench.edge.get().ring;
    std::vector<VertexId>& corners = bench.edge.get().corners;
    c.ring(t, a, b, ring);
    if (!ring.closed) return Refusal::box;
    const std::size_t n = ring.tets.size();
    // Rotates the ring so that it starts at an interface face, then finds the other interface face.
    const auto label = [&](std::size_t i) { return c.label(ring.tets[i % n]); };
    std::size_t changes = 0;
    std::size_t start = 0;
    for (std::size_t i = 0; i < n; ++i) {
        if (label(i) == label(i + n - 1)) continue;
        ++changes;
        start = i;
    }
    if (changes != 2) return Refusal::not_applicable;
    std::rotate(ring.tets.begin(), ring.tets.begin() + static_cast<std::ptrdiff_t>(start),
                ring.tets.end());
    std::rotate(ring.link.begin(), ring.link.begin() + static_cast<std::ptrdiff_t>(start),
                ring.link.end());
    std::size_t turn = 1;
    while (label(turn) == label(0)) ++turn;
    // First fan: link[0..turn]; second: link[turn..n-1], link[0].
    if (turn + 1 > max_polygon || n - turn + 1 > max_polygon || n < 3)
        return Refusal::not_applicable;
    const VertexId p = ring.link[0], q = ring.link[turn];
    const Vec3 &pa = c.position(a), &pb = c.position(b), &pp = c.position(p), &pq = c.position(q);
    if (geometry::triangle_normal(pa, pb, pp).dot(geometry::triangle_normal(pb, pa, pq)) <
        bench.limits.flatness) {
        return Refusal::bound;
    }
    const InterfaceChange change{geometry::segment_distance(pa, pb, pp, pq),
                                 std::abs(geometry::tet_volume(pa, pb, pp, pq))};
    if (change.exceeds(bench.bounds_at(a, b))) return Refusal::bound;
    bench.edit.clear();
    bench.edit.removed = ring.tets;
    const float old = bench.old_quality();
    const float must_exceed = std::min(old, accept_above);
    corners.assign(ring.link.begin() + static_cast<std::ptrdiff_t>(turn), ring.link.end());
    corners.push_back(p);
    Fan first{std::span(ring.link).first(turn + 1), label(0)};
    Fan second{corners, label(turn)};
    if (!triangulate(c, a, b, must_exceed, first) || !triangulate(c, a, b, must_exceed, second))
        return Refusal::quality;
    add_tets(bench, a, b, first);
    add_tets(bench, a, b, second);
    if (const Outcome o = bench.check_shape(must_exceed, old); o.refused()) return o;
    if (!c.link(bench.edit)) return Refusal::irregular;
    // If exactly two labels meet here and each has at least two tets at the edge, a flip keeps
    // every vertex regular. Positive tets that fill the cavity contain the segment pq inside, so pq
    // was not an edge before. In the cycles of interface neighbours, a and b lose each other, and p
    // and q are inserted into each other's cycle between a and b. (If a label has a single tet, pq
    // lies on the boundary of the cavity.)
    const std::array<VertexId, 4> touched = {a, b, p, q};
    const auto simple = [&c](VertexId v) { return c.phases(v) == 2 && !c.on_box(v); };
    if (turn < 2 || n - turn < 2 || !std::all_of(touched.begin(), touched.end(), simple)) {
        if (const Outcome o = bench.check_topology(touched); o.refused()) return o;
    }
    if (const Outcome o = check_creases(bench); o.refused()) return o;
    bench.commit(change);
    return success;
}

Outcome split_edge(Workbench& bench, TetId t, VertexId a, VertexId b, double s) {
    mesh::Complex& c = bench.complex;
    mesh::EdgeRing& ring = bench.edge.get().ring;
    c.ring(t, a, b, ring);
    if (!ring.closed) return Refusal::box;
    bench.edit.clear();
    bench.edit.removed = ring.tets;
    bench.edit.creates = true;
    bench.edit.created_at = (1.0 - s) * c.position(a) + s * c.position(b);
    const std::size_t n = ring.tets.size();
    for (std::size_t i = 0; i < n; ++i) {
        const VertexId p = ring.link[i], q = ring.link[(i + 1) % n];
        const mesh::Label label = c.label(ring.tets[i]);
        bench.edit.added.push_back({{a, mesh::created_vertex, p, q}, label});
        bench.edit.added.push_back({{mesh::created_vertex, b, p, q}, label});
    }
    if (const Outcome o = bench.check_shape(0.0F, bench.old_quality()); o.refused()) return o;
    if (!c.link(bench.edit)) return Refusal::irregular;
    const VertexId v = bench.commit();
    if (bench.listener != nullptr) bench.listener->on_split(v, a, b, s);
    return success;
}

}  // namespace dsc::kernel
