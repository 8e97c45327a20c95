// Split and collapse as one transaction, for nearly flat tets (method.md, section 4.9). The
// intermediate state with its flat tets is never built; only the result is tested.
#include <cmath>

#include <dsc/geometry/quality.hpp>

#include "kernel/creases.hpp"
#include "kernel/operations.hpp"

namespace dsc::kernel {

struct CompoundScratch {
    mesh::EdgeRing ring, opposite_ring;
    std::vector<TetId> star;
    std::vector<VertexId> concerned;  // vertices whose topology is tested
};

namespace {

// Parameters of the closest points of the lines ab and cd; false if they are parallel.
bool closest_parameters(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double& s,
                        double& t) {
    const Vec3 u = b - a, v = d - c, w = a - c;
    const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v);
    const double det = uu * vv - uv * uv;
    if (!(det > 1e-12 * uu * vv)) return false;
    s = (uv * v.dot(w) - vv * u.dot(w)) / det;
    t = (uu * v.dot(w) - uv * u.dot(w)) / det;
    return true;
}

constexpr double margin = 0.05;  // a split closer to an end than this is handled by the adjacent
                                 // shape class
bool inside(double s) { return s > margin && s < 1.0 - margin; }

bool same_edge(const repair::Request& request, VertexId a, VertexId b) {
    return (request.vertices[0] == a && request.vertices[1] == b) ||
           (request.vertices[0] == b && request.vertices[1] == a);
}

// Splits the tets round (a, b), except `skip` and those that contain `merged`, at the created
// vertex.
void split_ring(Workbench& bench, const mesh::EdgeRing& ring, VertexId a, VertexId b, TetId skip,
                VertexId merged) {
    const std::size_t n = ring.tets.size();
    for (std::size_t i = 0; i < n; ++i) {
        const TetId t = ring.tets[i];
        if (t == skip) continue;
        bench.edit.removed.push_back(t);
        const VertexId p = ring.link[i], q = ring.link[(i + 1) % n];
        if (p == merged || q == merged) continue;
        bench.edit.added.push_back({{a, mesh::created_vertex, p, q}, bench.complex.label(t)});
        bench.edit.added.push_back({{mesh::created_vertex, b, p, q}, bench.complex.label(t)});
    }
}

// Length of the shortest edge of the created vertex.
double shortest_new_edge(const Workbench& bench) {
    double least2 = INFINITY;
    for (const mesh::NewTet& t : bench.edit.added) {
        if (std::find(t.v.begin(), t.v.end(), mesh::created_vertex) == t.v.end()) continue;
        for (const VertexId v : t.v) {
            if (v == mesh::created_vertex) continue;
            least2 =
                std::min(least2, (bench.complex.position(v) - bench.edit.created_at).squaredNorm());
        }
    }
    return std::sqrt(least2);
}

// Tests and commits the edit in the bench; the created vertex was made on (a, b) at s.
Outcome finish(Workbench& bench, const repair::Request& request, VertexId a, VertexId b, double s) {
    mesh::Complex& c = bench.complex;
    const float old = bench.old_quality();
    const float must_exceed = std::min(old * request.gain, request.accept_above);
    if (request.least_edge > 0.0F &&
        shortest_new_edge(bench) < static_cast<double>(request.least_edge))
        return Refusal::bound;
    if (const Outcome o = bench.check_shape(must_exceed, old); o.refused()) return o;
    if (!c.link(bench.edit)) return Refusal::irregular;
    bool several = false;
    for (const TetId t : bench.edit.removed)
        several = several || c.label(t) != c.label(bench.edit.removed.front());
    InterfaceChange change;
    if (several) {
        const Vec3& place = bench.edit.created_at;
        change = {(place - ((1.0 - s) * c.position(a) + s * c.position(b))).norm(),
                  bench.phase_change()};
        if (change.exceeds(bench.bounds_at(a, b))) return Refusal::bound;
        std::vector<VertexId>& concerned = bench.compound.get().concerned;
        bench.cavity_interface_vertices(concerned);
        if (const Outcome o = bench.check_topology(concerned); o.refused()) return o;
        if (const Outcome o = check_creases(bench); o.refused()) return o;
    }
    const VertexId created = bench.commit(change);
    if (bench.listener != nullptr) bench.listener->on_split(created, a, b, s);
    return success;
}

// Two opposite edges that are close to each other get a common vertex midway between them.
Outcome merge_edges(Workbench& bench, TetId t, const repair::Request& request) {
    mesh::Complex& c = bench.complex;
    const auto v = c.tet(t).v;
    constexpr std::array<std::array<unsigned, 4>, 3> pairs = {
        {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}}};
    double best = INFINITY, best_s = 0.0;
    std::array<VertexId, 4> chosen{};
    Vec3 place = Vec3::Zero();
    for (const auto& pair : pairs) {
        std::array<VertexId, 4> e = {v[pair[0]], v[pair[1]], v[pair[2]], v[pair[3]]};
        if (request.vertices[1] != mesh::none) {
            // The named edge comes first: the destination of the new vertex follows the
            // destinations of its ends.
            if (same_edge(request, e[2], e[3])) e = {e[2], e[3], e[0], e[1]};
            if (!same_edge(request, e[0], e[1])) continue;
        }
        double s = 0.0, u = 0.0;
        if (!closest_parameters(c.position(e[0]), c.position(e[1]), c.position(e[2]),
                                c.position(e[3]), s, u))
            continue;
        if (!inside(s) || !inside(u)) continue;
        const Vec3 p = (1.0 - s) * c.position(e[0]) + s * c.position(e[1]);
        const Vec3 q = (1.0 - u) * c.position(e[2]) + u * c.position(e[3]);
        if ((p - q).norm() >= best) continue;
        best = (p - q).norm();
        best_s = s;
        chosen = e;
        place = 0.5 * (p + q);
    }
    if (!(best < INFINITY)) return Refusal::not_applicable;
    CompoundScratch& own = bench.compound.get();
    c.ring(t, chosen[0], chosen[1], own.ring);
    c.ring(t, chosen[2], chosen[3], own.opposite_ring);
    if (!own.ring.closed || !own.opposite_ring.closed) return Refusal::box;
    bench.edit.clear();
    bench.edit.creates = true;
    bench.edit.created_at = place;
    bench.edit.removed.push_back(t);
    split_ring(bench, own.ring, chosen[0], chosen[1], t, mesh::none);
    split_ring(bench, own.opposite_ring, chosen[2], chosen[3], t, mesh::none);
    return finish(bench, request, chosen[0], chosen[1], best_s);
}

// A free vertex v of the tet that is close to an edge or a face moves into it: the edge or face is
// split at v's projection, and v collapses there. All tets at v must have one label.
Outcome merge_vertex(Workbench& bench, TetId t, unsigned apex, const repair::Request& request) {
    mesh::Complex& c = bench.complex;
    const VertexId v = c.tet(t).v[apex];
    if (c.on_box(v) || c.on_interface(v)) return Refusal::not_applicable;
    std::array<VertexId, 3> f{};
    for (unsigned k = 0; k < 3; ++k) f[k] = c.tet(t).v[mesh::face_vertices[apex][k]];
    // Into the face if v projects well inside it, otherwise into the nearest edge.
    const Vec3 &p0 = c.position(f[0]), &p1 = c.position(f[1]), &p2 = c.position(f[2]),
               &p = c.position(v);
    const Vec3 normal = (p1 - p0).cross(p2 - p0);
    const double area2 = normal.squaredNorm();
    if (!(area2 > 0.0)) return Refusal::not_applicable;
    const double w0 = (p1 - p).cross(p2 - p).dot(normal) / area2;
    const double w1 = (p2 - p).cross(p0 - p).dot(normal) / area2;
    const double w2 = 1.0 - w0 - w1;
    CompoundScratch& own = bench.compound.get();
    c.star(v, own.star);
    bench.edit.clear();
    bench.edit.creates = true;
    bench.edit.deleted = v;
    bench.edit.removed = own.star;
    const auto reconnect = [&](auto&& skip) {
        for (const TetId s : own.star) {
            if (skip(s)) continue;
            mesh::NewTet tet{c.tet(s).v, c.label(s)};
            std::replace(tet.v.begin(), tet.v.end(), v, mesh::created_vertex);
            bench.edit.added.push_back(tet);
        }
    };
    if (std::min({w0, w1, w2}) > margin) {
        const std::uint32_t code = c.across(t, apex);
        if (code == mesh::none) return Refusal::box;
        const TetId other = mesh::neighbour_tet(code);
        bench.edit.created_at = w0 * p0 + w1 * p1 + w2 * p2;
        reconnect([&](TetId s) { return s == t; });
        bench.edit.removed.push_back(other);
        for (unsigned k = 0; k < 3; ++k) {
            mesh::NewTet tet{c.tet(other).v, c.label(other)};
            tet.v[mesh::face_vertices[mesh::neighbour_face(code)][k]] = mesh::created_vertex;
            bench.edit.added.push_back(tet);
        }
        return finish(bench, request, f[0], f[1], 0.5);
    }
    double best = INFINITY, best_s = 0.0;
    VertexId a = mesh::none, b = mesh::none;
    for (unsigned k = 0; k < 3; ++k) {
        const Vec3 &x = c.position(f[k]), &y = c.position(f[(k + 1) % 3]);
        const double s = (p - x).dot(y - x) / std::max((y - x).squaredNorm(), 1e-300);
        const double distance = (x + s * (y - x) - p).norm();
        if (!inside(s) || distance >= best) continue;
        best = distance;
        best_s = s;
        a = f[k];
        b = f[(k + 1) % 3];
    }
    if (a == mesh::none) return Refusal::not_applicable;
    c.ring(t, a, b, own.ring);
    if (!own.ring.closed) return Refusal::box;
    bench.edit.created_at = (1.0 - best_s) * c.position(a) + best_s * c.position(b);
    reconnect(
        [&](TetId s) { return mesh::has_vertex(c.tet(s), a) && mesh::has_vertex(c.tet(s), b); });
    const std::size_t star = bench.edit.removed.size();
    split_ring(bench, own.ring, a, b, mesh::none, v);
    // Ring tets that contain v are in its star already.
    bench.edit.removed.erase(
        std::remove_if(bench.edit.removed.begin() + static_cast<std::ptrdiff_t>(star),
                       bench.edit.removed.end(),
                       [&](TetId s) { return mesh::has_vertex(c.tet(s), v); }),
        bench.edit.removed.end());
    return finish(bench, request, a, b, best_s);
}

}  // namespace

Outcome compound(Workbench& bench, TetId t, const repair::Request& request) {
    if (request.vertices[1] != mesh::none) return merge_edges(bench, t, request);
    if (request.vertices[0] != mesh::none)
        return merge_vertex(bench, t, mesh::index_of(bench.complex.tet(t), request.vertices[0]),
                            request);
    // The last outcome that says something about the tet.
    Outcome last = Refusal::not_applicable;
    const auto keep = [&last](Outcome o) {
        if (o != Refusal::not_applicable) last = o;
    };
    for (unsigned apex = 0; apex < 4 && last.refused(); ++apex)
        keep(merge_vertex(bench, t, apex, request));
    if (last.refused()) keep(merge_edges(bench, t, request));
    return last;
}

}  // namespace dsc::kernel
