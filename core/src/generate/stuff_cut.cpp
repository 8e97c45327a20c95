// Cuts the mixed tets of a lattice along the interface.
#include "generate/stuff_cut.hpp"

#include <algorithm>

namespace dsc::generate::stuffing {
namespace {

class Cut {
public:
    Cut(const LatticeView& lattice, std::span<const MixedEdge> edges, const EdgeTable& table,
        const Signs& signs)
        : lattice_(lattice), table_(table), signs_(signs), vertex_of_(edges.size(), no_vertex) {
        auto& points = out_.mesh.points;
        points.reserve(lattice.points.size() + edges.size());
        points.assign(lattice.points.begin(), lattice.points.end());
        for (std::size_t e = 0; e < edges.size(); ++e) {
            const MixedEdge& edge = edges[e];
            if (signs[edge.plus] == 0 || signs[edge.minus] == 0) continue;
            vertex_of_[e] = static_cast<std::uint32_t>(points.size());
            points.push_back((1.0 - edge.t) * lattice.points[edge.plus] +
                             edge.t * lattice.points[edge.minus]);
        }
        const std::size_t tets = lattice.tets.size() + 8 * (points.size() - lattice.points.size());
        out_.mesh.tets.reserve(tets);
        out_.mesh.labels.reserve(tets);
    }

    Stuffed run() {
        for (const Corners& tet : lattice_.tets) split(tet);
        join_flat_faces();
        return std::move(out_);
    }

private:
    // Corners of one tet with the same sign, in ascending order.
    struct Side {
        std::array<std::uint32_t, 4> v{};
        std::size_t count = 0;
        void add(std::uint32_t x) {
            std::size_t i = count++;
            for (; i > 0 && v[i - 1] > x; --i) v[i] = v[i - 1];
            v[i] = x;
        }
    };

    void split(const Corners& tet) {
        Side plus, minus, zero;
        for (const std::uint32_t v : tet)
            (signs_[v] > 0 ? plus : signs_[v] < 0 ? minus : zero).add(v);
        if (plus.count == 0 || minus.count == 0) {
            out_.mesh.tets.push_back(tet);
            out_.mesh.labels.push_back(plus.count > 0 ? 1 : 0);
            if (zero.count == 3)
                flat_.push_back({{zero.v[0], zero.v[1], zero.v[2]}, plus.count > 0});
            return;
        }
        if (zero.count == 2) {
            const std::uint32_t m = cut(plus.v[0], minus.v[0]);
            add({plus.v[0], m, zero.v[0], zero.v[1]}, 1);
            add({minus.v[0], m, zero.v[0], zero.v[1]}, 0);
            out_.faces.push_back({m, zero.v[0], zero.v[1]});
        } else if (zero.count == 1) {
            split_pyramid(plus, minus, zero.v[0]);
        } else if (plus.count == 2) {
            split_in_prisms(plus, minus);
        } else {
            split_corner(plus, minus);
        }
    }

    // One corner on one side, two on the other, one snapped: a tet, and a pyramid with a quad as
    // base and the snapped vertex as apex.
    void split_pyramid(const Side& plus, const Side& minus, std::uint32_t top) {
        const bool one_plus = plus.count == 1;
        const std::uint32_t c = (one_plus ? plus : minus).v[0];
        const auto& [a, b, x, y] = (one_plus ? minus : plus).v;
        const std::uint32_t ac = cut(a, c), bc = cut(b, c);
        add({c, ac, bc, top}, one_plus ? 1 : 0);
        add({a, b, bc, top}, one_plus ? 0 : 1);
        add({a, bc, ac, top}, one_plus ? 0 : 1);
        out_.faces.push_back({ac, bc, top});
    }

    // Two corners on each side: two prisms with a common quad.
    void split_in_prisms(const Side& plus, const Side& minus) {
        const std::uint32_t a = plus.v[0], b = plus.v[1], c = minus.v[0], d = minus.v[1];
        const std::uint32_t ac = cut(a, c), ad = cut(a, d), bc = cut(b, c), bd = cut(b, d);
        add({a, b, bc, bd}, 1);
        add({c, d, ad, bd}, 0);
        const auto& p = out_.mesh.points;
        const bool from_ac = (p[ac] - p[bd]).squaredNorm() <= (p[ad] - p[bc]).squaredNorm();
        const std::array<Face, 2> halves = from_ac
                                               ? std::array<Face, 2>{{{ac, bd, bc}, {ac, ad, bd}}}
                                               : std::array<Face, 2>{{{ad, bc, ac}, {ad, bd, bc}}};
        for (const Face& f : halves) {
            add({a, f[0], f[1], f[2]}, 1);
            add({c, f[0], f[1], f[2]}, 0);
            out_.faces.push_back(f);
        }
    }

    // One corner on one side, three on the other: a tet and a prism.
    void split_corner(const Side& plus, const Side& minus) {
        const bool one_plus = plus.count == 1;
        const std::uint32_t d = (one_plus ? plus : minus).v[0];
        const auto& [a, b, c, x] = (one_plus ? minus : plus).v;
        const std::uint32_t ad = cut(a, d), bd = cut(b, d), cd = cut(c, d);
        const mesh::Label other = one_plus ? 0 : 1;
        add({d, ad, bd, cd}, 1 - other);
        add({a, b, c, cd}, other);
        add({a, b, bd, cd}, other);
        add({a, ad, bd, cd}, other);
        out_.faces.push_back({ad, bd, cd});
    }

    std::uint32_t cut(std::uint32_t v, std::uint32_t w) const {
        return vertex_of_[signs_[v] > 0 ? table_.find(v, w) : table_.find(w, v)];
    }

    void add(Corners tet, mesh::Label label) {
        const auto& p = out_.mesh.points;
        const Vec3& x = p[tet[0]];
        if ((p[tet[1]] - x).cross(p[tet[2]] - x).dot(p[tet[3]] - x) < 0) std::swap(tet[2], tet[3]);
        out_.mesh.tets.push_back(tet);
        out_.mesh.labels.push_back(label);
    }

    // A face of three snapped vertices, and whether the tet that contains it is inside.
    struct FlatFace {
        Face face;
        bool inside;
    };
    // Those between tets of both labels belong to the interface.
    void join_flat_faces() {
        std::sort(flat_.begin(), flat_.end(), [](const FlatFace& x, const FlatFace& y) {
            return x.face != y.face ? x.face < y.face : x.inside < y.inside;
        });
        for (std::size_t i = 1; i < flat_.size(); ++i) {
            if (flat_[i].face == flat_[i - 1].face && flat_[i].inside != flat_[i - 1].inside)
                out_.faces.push_back(flat_[i].face);
        }
    }

    LatticeView lattice_;
    const EdgeTable& table_;
    const Signs& signs_;
    std::vector<std::uint32_t> vertex_of_;  // of each mixed edge
    std::vector<FlatFace> flat_;
    Stuffed out_;
};

}  // namespace

Stuffed cut_tets(const LatticeView& lattice, std::span<const MixedEdge> edges,
                 const EdgeTable& table, const Signs& signs) {
    return Cut(lattice, edges, table, signs).run();
}

}  // namespace dsc::generate::stuffing
