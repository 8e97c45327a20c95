// Walks through the complex: star of a vertex, ring of an edge, edges of the interface (method.md,
// section 1.1).
#include <algorithm>
#include <utility>

#include <dsc/mesh/complex.hpp>

namespace dsc::mesh {
namespace {

// Whether (i, j, k, l) is an even permutation of (0, 1, 2, 3).
bool even_permutation(unsigned i, unsigned j, unsigned k, unsigned l) {
    const std::array<unsigned, 4> p = {i, j, k, l};
    unsigned inversions = 0;
    for (unsigned a = 0; a < 4; ++a) {
        for (unsigned b = a + 1; b < 4; ++b) inversions += p[a] > p[b] ? 1 : 0;
    }
    return inversions % 2 == 0;
}

VertexId fourth(const Tet& tet, VertexId a, VertexId b, VertexId c) {
    return tet.v[0] ^ tet.v[1] ^ tet.v[2] ^ tet.v[3] ^ a ^ b ^ c;
}

// Walks round the edge from tet `first`, which contains a, b, p and q, and appends what it meets to
// the ring as long as keep(tet) says so.
enum class RingEnd { closed, open, stopped };
template <class Keep>
RingEnd walk_ring(const std::vector<Tet>& tets, TetId first, VertexId a, VertexId b, VertexId p,
                  VertexId q, EdgeRing& out, const Keep& keep) {
    TetId current = first;
    while (true) {
        if (!keep(current)) return RingEnd::stopped;
        out.tets.push_back(current);
        out.link.push_back(p);
        const Tet& tet = tets[current];
        const std::uint32_t code = tet.n[index_of(tet, p)];
        if (code == none) {
            out.link.push_back(q);
            return RingEnd::open;
        }
        current = neighbour_tet(code);
        if (current == first) return RingEnd::closed;
        const VertexId r = fourth(tets[current], a, b, q);
        p = q;
        q = r;
    }
}

// The other two vertices p and q of a tet with the edge ab, so that orient3d(a, b, p, q) == 1.
std::array<VertexId, 2> opposite_edge(const Tet& tet, VertexId a, VertexId b) {
    const unsigned i = index_of(tet, a), j = index_of(tet, b);
    unsigned k = 0;
    while (k == i || k == j) ++k;
    unsigned l = 6 - i - j - k;
    if (!even_permutation(i, j, k, l)) std::swap(k, l);
    return {tet.v[k], tet.v[l]};
}

}  // namespace

void Complex::star(VertexId v, std::vector<TetId>& out, TetIndex& places) const {
    const std::span<const TetId> known = stars_.tets(v);
    if (known.empty()) return walk_star(v, out, places);
    out.assign(known.begin(), known.end());
    places.clear();
    for (const TetId t : known) places.insert(t);
}

void Complex::cached_star(VertexId v, std::vector<TetId>& out, TetIndex& scratch) const {
    const std::span<const TetId> known = stars_.tets(v);
    if (known.empty()) {
        walk_star(v, out, scratch);
        stars_.keep_tets(v, out);
    } else {
        out.assign(known.begin(), known.end());
    }
}

void Complex::cached_neighbours(VertexId v, std::span<const TetId> star, std::vector<VertexId>& out,
                                TetIndex& scratch) const {
    const std::span<const VertexId> known = stars_.neighbours(v);
    if (!known.empty()) {
        out.assign(known.begin(), known.end());
        return;
    }
    scratch.clear();
    scratch.insert(v);
    out.clear();
    for (const TetId t : star) {
        for (const VertexId w : tets_[t].v) {
            if (scratch.insert(w)) out.push_back(w);
        }
    }
    std::sort(out.begin(), out.end(),
              [this](VertexId x, VertexId y) { return birth(x) < birth(y); });
    stars_.keep_neighbours(v, star, out);
}

void Complex::walk_star(VertexId v, std::vector<TetId>& out, TetIndex& places) const {
    out.clear();
    places.clear();
    // Kept in a register: the compiler cannot know that writing to the table does not change it.
    const Tet* const tets = tets_.data();
    const TetId first = vertices_[v].seed;
    places.insert(first);
    // Until the end `out` contains codes: the tet, and the face through which it was reached,
    // because nothing new lies behind that face.
    out.push_back(4 * first + index_of(tets[first], v));
    for (std::size_t i = 0; i < out.size(); ++i) {
        const Tet& tet = tets[neighbour_tet(out[i])];
        const unsigned entry = neighbour_face(out[i]);
        for (unsigned f = 0; f < 4; ++f) {
            if (f == entry || tet.v[f] == v || tet.n[f] == none) continue;
            if (!places.insert(neighbour_tet(tet.n[f]))) continue;
            __builtin_prefetch(tets + neighbour_tet(tet.n[f]));  // its turn comes soon
            out.push_back(tet.n[f]);
        }
    }
    for (TetId& t : out) t = neighbour_tet(t);
}

void Complex::ring(TetId t, VertexId a, VertexId b, EdgeRing& out) const {
    const auto all = [](TetId) { return true; };
    out.tets.clear();
    out.link.clear();
    auto [p, q] = opposite_edge(tets_[t], a, b);
    out.closed = walk_ring(tets_, t, a, b, p, q, out, all) == RingEnd::closed;
    if (out.closed) return;
    // Back to the first tet of the open ring, and then along it.
    TetId first = t;
    while (true) {
        const std::uint32_t code = tets_[first].n[index_of(tets_[first], q)];
        if (code == none) break;
        first = neighbour_tet(code);
        const VertexId s = fourth(tets_[first], a, b, p);
        q = p;
        p = s;
    }
    out.tets.clear();
    out.link.clear();
    walk_ring(tets_, first, a, b, p, q, out, all);
}

bool Complex::inner_ring(TetId t, VertexId a, VertexId b, std::size_t most, EdgeRing& out) const {
    out.tets.clear();
    out.link.clear();
    const auto [p, q] = opposite_edge(tets_[t], a, b);
    const auto fits = [&](TetId r) { return out.tets.size() < most && labels_[r] == labels_[t]; };
    out.closed = walk_ring(tets_, t, a, b, p, q, out, fits) == RingEnd::closed;
    return out.closed;
}

TetId Complex::find_edge(VertexId a, VertexId b) const {
    star(a, star_scratch_);
    for (const TetId t : star_scratch_) {
        if (has_vertex(tets_[t], b)) return t;
    }
    return none;
}

double mean_interface_edge(const Complex& c) {
    // Each edge once, in the order of its births: the sum is the same for any slots.
    std::vector<std::pair<std::uint64_t, double>> lengths;
    for (TetId t = 0; t < c.tet_slots(); ++t) {
        if (!c.tet_alive(t)) continue;
        for (unsigned f = 0; f < 4; ++f) {
            if (c.label(t) <= c.label_across(t, f)) continue;
            for (unsigned k = 0; k < 3; ++k) {
                const VertexId a = c.tet(t).v[face_vertices[f][k]],
                               b = c.tet(t).v[face_vertices[f][(k + 1) % 3]];
                const std::uint64_t first = std::min(c.birth(a), c.birth(b));
                lengths.emplace_back(first << 32U | std::max(c.birth(a), c.birth(b)),
                                     (c.position(a) - c.position(b)).norm());
            }
        }
    }
    std::sort(lengths.begin(), lengths.end());
    lengths.erase(std::unique(lengths.begin(), lengths.end()), lengths.end());
    double sum = 0.0;
    for (const auto& edge : lengths) sum += edge.second;
    return lengths.empty() ? 0.0 : sum / static_cast<double>(lengths.size());
}

}  // namespace dsc::mesh
