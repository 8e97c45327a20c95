#include "candidates.hpp"

#include <algorithm>

#include <dsc/base/random.hpp>

namespace dsc::bench {
namespace {

using mesh::Complex;
using mesh::TetId;
using mesh::VertexId;

template <class Element>
void shuffle(std::vector<Element>& order) {
    RandomStream random(RandomKey{1, stream_id("bench.candidates"), 0, 0});
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.index(i)]);
}

// Vertices that an earlier place works on.
class Taken {
public:
    explicit Taken(const Complex& complex) : taken_(complex.vertex_slots(), 0) {}

    /// Takes the ends of an edge unless a vertex round them is taken. An operation at an edge
    /// changes only tets that hold one of its ends, so no two places then share a tet that changes.
    bool take(const Place& place, std::span<const VertexId> around) {
        if (std::any_of(around.begin(), around.end(),
                        [this](VertexId v) { return taken_[v] != 0; }))
            return false;
        taken_[place.a] = taken_[place.b] = 1;
        return true;
    }

private:
    std::vector<std::uint8_t> taken_;
};

void add_star(const Complex& complex, VertexId v, std::vector<TetId>& star,
              std::vector<VertexId>& out) {
    complex.star(v, star);
    for (const TetId t : star)
        out.insert(out.end(), complex.tet(t).v.begin(), complex.tet(t).v.end());
}

}  // namespace

std::vector<VertexId> movable_vertices(const Complex& complex) {
    std::vector<VertexId> out;
    for (const VertexId v : complex.interface_vertices()) {
        if (complex.movable(v)) out.push_back(v);
    }
    std::sort(out.begin(), out.end(),
              [&](VertexId a, VertexId b) { return complex.birth(a) < complex.birth(b); });
    return out;
}

std::vector<TetId> band(const Complex& complex) {
    std::vector<TetId> out, star;
    std::vector<std::uint8_t> listed(complex.tet_slots(), 0);
    for (const VertexId v : movable_vertices(complex)) {
        complex.star(v, star);
        for (const TetId t : star) {
            if (listed[t] == 0) out.push_back(t);
            listed[t] = 1;
        }
    }
    shuffle(out);
    return out;
}

std::vector<VertexId> free_vertices(const Complex& complex) {
    std::vector<VertexId> out;
    for (const TetId t : band(complex)) {
        for (const VertexId v : complex.tet(t).v) {
            if (!complex.on_interface(v) && !complex.on_box(v)) out.push_back(v);
        }
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    shuffle(out);
    if (out.size() > most_places) out.resize(most_places);
    return out;
}

std::vector<Place> edges(const Complex& complex, bool stars,
                         const std::function<bool(const Place&)>& wanted) {
    std::vector<Place> out;
    Taken taken(complex);
    mesh::EdgeRing ring;
    std::vector<TetId> star;
    std::vector<VertexId> around;
    for (const TetId t : band(complex)) {
        for (const auto& [i, j] : mesh::edge_vertices) {
            if (out.size() >= most_places) return out;
            Place place{.tet = t, .a = complex.tet(t).v[i], .b = complex.tet(t).v[j]};
            complex.ring(t, place.a, place.b, ring);
            if (!ring.closed) continue;
            place.ring = ring.tets.size();
            for (const TetId r : ring.tets)
                place.on_interface |= complex.label(r) != complex.label(t);
            if (!wanted(place)) continue;
            around.clear();
            if (stars) {
                add_star(complex, place.a, star, around);
                add_star(complex, place.b, star, around);
            } else {
                for (const TetId r : ring.tets)
                    around.insert(around.end(), complex.tet(r).v.begin(), complex.tet(r).v.end());
            }
            if (taken.take(place, around)) out.push_back(place);
        }
    }
    return out;
}

std::vector<Place> faces(const Complex& complex) {
    std::vector<Place> out;
    std::vector<std::uint8_t> taken(complex.tet_slots(), 0);
    for (const TetId t : band(complex)) {
        for (unsigned f = 0; f < 4; ++f) {
            if (out.size() >= most_places) return out;
            const std::uint32_t code = complex.across(t, f);
            if (code == mesh::none || complex.interface_face(t, f)) continue;
            const TetId other = mesh::neighbour_tet(code);
            if (taken[t] != 0 || taken[other] != 0) continue;
            taken[t] = taken[other] = 1;
            out.push_back({.tet = t, .face = f});
        }
    }
    return out;
}

repair::Request request_at(const Complex& complex, repair::Operation operation, const Place& place,
                           float accept_above) {
    repair::Request request;
    request.tet = place.tet;
    request.birth_date = complex.birth_date(place.tet);
    request.operation = operation;
    request.mode = repair::CollapseMode::bounded;
    request.vertices = {place.a, place.b, mesh::none};
    request.accept_above = accept_above;
    return request;
}

}  // namespace dsc::bench
