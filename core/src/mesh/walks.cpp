// Walks through the complex: star of a vertex, ring of an edge, edges of the interface (method.md,
// section 1.1).
#include <algorithm>
#include <utility>

#include <dsc/base/prefetch.hpp>
#include <dsc/mesh/complex.hpp>

namespace dsc::mesh {
namespace {

// For each pair of different corners i and j of a tet, the two others k and l, so that (i, j, k, l)
// is an even permutation of (0, 1, 2, 3). Tables, because branches that depend on the order of the
// corners cannot be predicted.
using CornerPairs = std::array<std::array<std::array<std::uint8_t, 2>, 4>, 4>;
constexpr CornerPairs opposite_corners = {{{{{0, 0}, {2, 3}, {3, 1}, {1, 2}}},
                                           {{{3, 2}, {0, 0}, {0, 3}, {2, 0}}},
                                           {{{1, 3}, {3, 0}, {0, 0}, {0, 1}}},
                                           {{{2, 1}, {0, 2}, {1, 0}, {0, 0}}}}};
// The same two in ascending order.
constexpr CornerPairs other_corners = [] {
    CornerPairs all = opposite_corners;
    for (auto& row : all) {
        for (auto& pair : row) {
            if (pair[0] > pair[1]) std::swap(pair[0], pair[1]);
        }
    }
    return all;
}();

VertexId fourth(const Tet& tet, VertexId a, VertexId b, VertexId c) {
    return tet.v[0] ^ tet.v[1] ^ tet.v[2] ^ tet.v[3] ^ a ^ b ^ c;
}

// Walks round the edge from tet `first`, which contains a, b, p and q, and appends what it meets to
// the ring as long as keep(tet) says so.
enum class RingEnd { closed, open, stopped };
template <class Keep>
RingEnd walk_ring(const Complex& c, TetId first, VertexId a, VertexId b, VertexId p, VertexId q,
                  EdgeRing& out, const Keep& keep) {
    TetId current = first;
    while (true) {
        if (!keep(current)) return RingEnd::stopped;
        out.tets.push_back(current);
        out.link.push_back(p);
        const std::uint32_t code = c.across(current, index_of(c.tet(current), p));
        if (code == none) {
            out.link.push_back(q);
            return RingEnd::open;
        }
        current = neighbour_tet(code);
        if (current == first) return RingEnd::closed;
        const VertexId r = fourth(c.tet(current), a, b, q);
        p = q;
        q = r;
    }
}

// The other two vertices p and q of a tet with the edge ab, so that orient3d(a, b, p, q) == 1.
std::array<VertexId, 2> opposite_edge(const Tet& tet, VertexId a, VertexId b) {
    const auto [k, l] = opposite_corners[index_of(tet, a)][index_of(tet, b)];
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

void Complex::star(VertexId v, std::vector<TetId>& out) const {
    const std::span<const TetId> star = own_star(v);
    out.assign(star.begin(), star.end());
}

std::span<const TetId> Complex::own_star(VertexId v) const { return cached_star(v, walk_).tets; }

Star Complex::cached_star(VertexId v, StarWalk& walk) const {
    if (const std::span<const TetId> known = stars_.tets(v); !known.empty())
        return {known, stars_.neighbours(v)};
    walk_codes(v, walk.tets, walk.places);
    find_neighbours(v, walk.tets, walk.neighbours, walk.places);
    for (TetId& t : walk.tets) t = neighbour_tet(t);
    stars_.keep(v, walk.tets, walk.neighbours);
    if (!knows_star(v)) return {walk.tets, walk.neighbours};
    return {stars_.tets(v), stars_.neighbours(v)};
}

// `codes` are those of walk_codes(). Each tet has one corner that the tet before it on the walk
// does not have: the one opposite the face through which it was reached.
void Complex::find_neighbours(VertexId v, std::span<const std::uint32_t> codes,
                              std::vector<VertexId>& out, TetIndex& seen) const {
    seen.clear();
    if (out.size() < codes.size() + 3) out.resize(codes.size() + 3);
    std::size_t count = 0;
    for (const VertexId w : tets_[neighbour_tet(codes.front())].v) {
        if (w == v) continue;
        seen.insert(w);
        out[count++] = w;
        prefetch_birth(w);
        prefetch_vertex(w);  // whoever asks for the neighbours reads their positions
    }
    // As in walk_codes().
    for (const std::uint32_t code : codes.subspan(1)) {
        out[count] = tets_[neighbour_tet(code)].v[neighbour_face(code)];
        prefetch_birth(out[count]);
        prefetch_vertex(out[count]);
        count += seen.insert(out[count]) ? 1 : 0;
    }
    out.resize(count);
    sort_by_birth(out);
}

// Nearly all lists are short. Then the place of each vertex is the number of smaller births: the
// processor cannot guess the outcome of a comparison, so it must not decide about a branch.
void Complex::sort_by_birth(std::vector<VertexId>& list) const {
    constexpr std::size_t most = 32;
    if (list.size() > most) {
        std::sort(list.begin(), list.end(),
                  [this](VertexId x, VertexId y) { return birth(x) < birth(y); });
        return;
    }
    std::array<VertexId, most> unsorted;
    std::array<std::uint32_t, most> births, smaller;
    for (std::size_t i = 0; i < list.size(); ++i) {
        unsorted[i] = list[i];
        births[i] = birth(list[i]);
        smaller[i] = 0;
        for (std::size_t j = 0; j < i; ++j) {
            const std::uint32_t is_smaller = births[j] < births[i] ? 1 : 0;
            smaller[i] += is_smaller;
            smaller[j] += 1 - is_smaller;
        }
    }
    for (std::size_t i = 0; i < list.size(); ++i) list[smaller[i]] = unsorted[i];
}

void Complex::walk_star(VertexId v, std::vector<TetId>& out, TetIndex& places) const {
    walk_codes(v, out, places);
    for (TetId& t : out) t = neighbour_tet(t);
}

// `out` receives codes: the tet, and the face through which it was reached, because nothing new
// lies behind that face. The first tet was reached through no face at v, so it has the face
// opposite v.
void Complex::walk_codes(VertexId v, std::vector<std::uint32_t>& out, TetIndex& places) const {
    places.clear();
    // Kept in a register: the compiler cannot know that writing to the table does not change it.
    const Tet* const tets = tets_.data();
    const TetNeighbours* const neighbours = neighbours_.data();
    const TetId first = shapes_[v].seed;
    places.insert(first);
    // A code is written, and counts if its tet is new: a branch could not be predicted.
    if (out.size() < 64) out.resize(64);
    std::size_t count = 0;
    const auto visit = [&](std::uint32_t code) {
        if (code == none) return;
        prefetch_line(tets + neighbour_tet(code));  // its turn comes soon
        prefetch_line(neighbours + neighbour_tet(code));
        out[count] = code;
        count += places.insert(neighbour_tet(code)) ? 1 : 0;
    };
    const unsigned own = index_of(tets[first], v);
    out[count++] = 4 * first + own;
    for (unsigned f = 0; f < 4; ++f) {
        if (f != own) visit(neighbours[first][f]);
    }
    for (std::size_t i = 1; i < count; ++i) {
        if (out.size() < count + 2) out.resize(2 * count);
        const TetId t = neighbour_tet(out[i]);
        for (const unsigned f : other_corners[index_of(tets[t], v)][neighbour_face(out[i])])
            visit(neighbours[t][f]);
    }
    out.resize(count);
}

void Complex::ring(TetId t, VertexId a, VertexId b, EdgeRing& out) const {
    const auto all = [](TetId) { return true; };
    out.tets.clear();
    out.link.clear();
    auto [p, q] = opposite_edge(tets_[t], a, b);
    out.closed = walk_ring(*this, t, a, b, p, q, out, all) == RingEnd::closed;
    if (out.closed) return;
    // Back to the first tet of the open ring, and then along it.
    TetId first = t;
    while (true) {
        const std::uint32_t code = across(first, index_of(tets_[first], q));
        if (code == none) break;
        first = neighbour_tet(code);
        const VertexId s = fourth(tets_[first], a, b, p);
        q = p;
        p = s;
    }
    out.tets.clear();
    out.link.clear();
    walk_ring(*this, first, a, b, p, q, out, all);
}

bool Complex::inner_ring(TetId t, VertexId a, VertexId b, std::size_t most, EdgeRing& out) const {
    out.tets.clear();
    out.link.clear();
    const auto [p, q] = opposite_edge(tets_[t], a, b);
    const auto fits = [&](TetId r) {
        return out.tets.size() < most && tets_[r].label == tets_[t].label;
    };
    out.closed = walk_ring(*this, t, a, b, p, q, out, fits) == RingEnd::closed;
    return out.closed;
}

TetId Complex::find_edge(VertexId a, VertexId b) const {
    for (const TetId t : own_star(a)) {
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
