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
    stars_.keep_neighbours(v, out);
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
            if (places.insert(neighbour_tet(tet.n[f]))) out.push_back(tet.n[f]);
        }
    }
    for (TetId& t : out) t = neighbour_tet(t);
}

void Complex::ring(TetId t, VertexId a, VertexId b, EdgeRing& out) const {
    out.tets.clear();
    out.link.clear();
    const unsigned i = index_of(tets_[t], a), j = index_of(tets_[t], b);
    unsigned k = 0;
    while (k == i || k == j) ++k;
    unsigned l = 6 - i - j - k;
    if (!even_permutation(i, j, k, l)) std::swap(k, l);
    VertexId p = tets_[t].v[k], q = tets_[t].v[l];

    // Back to the first tet of an open ring, or once around a closed one.
    TetId first = t;
    out.closed = false;
    while (true) {
        const std::uint32_t code = tets_[first].n[index_of(tets_[first], q)];
        if (code == none) break;
        const TetId previous = neighbour_tet(code);
        if (previous == t) {
            out.closed = true;
            first = t;
            p = tets_[t].v[k];
            q = tets_[t].v[l];
            break;
        }
        const VertexId s = fourth(tets_[previous], a, b, p);
        q = p;
        p = s;
        first = previous;
    }
    TetId current = first;
    while (true) {
        out.tets.push_back(current);
        out.link.push_back(p);
        const std::uint32_t code = tets_[current].n[index_of(tets_[current], p)];
        if (code == none) {
            out.link.push_back(q);
            return;
        }
        const TetId next = neighbour_tet(code);
        if (next == first) return;
        const VertexId r = fourth(tets_[next], a, b, q);
        p = q;
        q = r;
        current = next;
    }
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
