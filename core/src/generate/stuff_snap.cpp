// Snaps lattice vertices to the interface if this keeps its topology.
#include "generate/stuff_snap.hpp"

#include <algorithm>

#include <dsc/base/error.hpp>

namespace dsc::generate::stuffing {
namespace {

// The link of a vertex p, a sphere of triangles whose corners have the signs of the lattice, cut as
// the interface cuts it.
//
// Snapping p, of sign s, moves the cut points of all its mixed edges into p. It keeps the topology
// if and only if the open parts of both signs in the cut link are connected. Proof: every mixed tet
// of p's star meets the interface in a piece. Seen from p, this piece covers exactly the part of
// sign -s of the tet's opposite triangle. So the pieces make a surface patch P. Central projection
// from p maps P one to one onto M, the closed part of sign -s in the link, and leaves points of P
// on the link fixed. The snap replaces P by the cone from p over the border of M. If both open
// parts are connected through edges, the border of M is one simple closed curve (a part that
// touched itself in a snapped vertex would separate the other part). So P and the cone are discs
// with the same border in the ball that is p's star, and the rest of the interface lies outside the
// open star. The interface before and after is then the same up to a motion within this ball, and p
// is a regular vertex, because its link is cut into two discs. If one part is not connected or is
// empty, p is not regular.
//
// Two more kinds of snaps are refused although they would not harm the topology. A tet of four
// snapped vertices would have no sign, and all of it would become part of the interface. And a
// patch P that touches the link in a snapped vertex inside M would be moved off this vertex: it
// would not be on the interface any more, and its side could contradict its value.
class CutLink {
public:
    explicit CutLink(std::size_t points) : stamps_(points, 0), places_(points, 0) {}

    bool allows_snap(std::uint32_t p, std::span<const std::uint32_t> star,
                     std::span<const Corners> tets, const Signs& signs) {
        clear();
        for (const std::uint32_t t : star) {
            const Corners& tet = tets[t];
            std::array<std::uint32_t, 3> corner{};
            std::size_t count = 0;
            for (const std::uint32_t v : tet) {
                if (v != p) corner[count++] = v;
            }
            std::array<int, 3> sign{};
            for (std::size_t i = 0; i < 3; ++i) sign[i] = signs[corner[i]];
            if (sign[0] == 0 && sign[1] == 0 && sign[2] == 0) return false;
            for (std::size_t i = 0; i < 3; ++i) {
                const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
                if (sign[i] != 0) {
                    const std::uint32_t place = place_of(corner[i], sign[i]);
                    if (sign[j] == sign[i]) join(place, place_of(corner[j], sign[j]));
                    continue;
                }
                const std::uint32_t place = place_of(corner[i], 0);
                nodes_[place].beside |= bit(sign[j]) | bit(sign[k]);
                if (sign[j] == 0) {
                    // Across an edge of snapped vertices, two equal signs are joined.
                    across_.push_back({std::min(corner[i], corner[j]),
                                       std::max(corner[i], corner[j]),
                                       place_of(corner[k], sign[k])});
                }
            }
        }
        for (std::size_t i = 0; i < across_.size(); ++i) {
            for (std::size_t j = i + 1; j < across_.size(); ++j) {
                const Across &x = across_[i], &y = across_[j];
                if (x.low == y.low && x.high == y.high &&
                    nodes_[x.place].sign == nodes_[y.place].sign)
                    join(x.place, y.place);
            }
        }
        std::size_t plus = 0, minus = 0;
        for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
            const Node& node = nodes_[i];
            if (node.sign == 0 && node.beside == bit(-signs[p])) return false;
            if (node.sign != 0 && node.parent == i) ++(node.sign > 0 ? plus : minus);
        }
        return plus == 1 && minus == 1;
    }

private:
    struct Node {
        std::uint32_t parent;
        int sign;
        unsigned beside;  // signs in the triangles of a snapped vertex, as bits
    };
    static unsigned bit(int sign) { return sign > 0 ? 1U : sign < 0 ? 2U : 0U; }
    struct Across {
        std::uint32_t low, high, place;
    };

    void clear() {
        nodes_.clear();
        across_.clear();
        if (++stamp_ != 0) return;
        std::fill(stamps_.begin(), stamps_.end(), 0);
        stamp_ = 1;
    }
    std::uint32_t place_of(std::uint32_t v, int sign) {
        if (stamps_[v] != stamp_) {
            stamps_[v] = stamp_;
            places_[v] = static_cast<std::uint32_t>(nodes_.size());
            nodes_.push_back({places_[v], sign, 0});
        }
        return places_[v];
    }
    std::uint32_t root(std::uint32_t i) const {
        while (nodes_[i].parent != i) i = nodes_[i].parent;
        return i;
    }
    void join(std::uint32_t i, std::uint32_t j) {
        i = root(i);
        j = root(j);
        nodes_[std::max(i, j)].parent = std::min(i, j);
    }

    std::vector<std::uint32_t> stamps_, places_;
    std::uint32_t stamp_ = 0;
    std::vector<Node> nodes_;
    std::vector<Across> across_;
};

// The mixed edges of each vertex.
class EdgesOfVertices {
public:
    EdgesOfVertices(std::size_t points, std::span<const MixedEdge> edges)
        : start_(points + 2, 0), edges_(2 * edges.size()) {
        for (const MixedEdge& edge : edges) {
            ++start_[edge.plus + 2];
            ++start_[edge.minus + 2];
        }
        for (std::size_t i = 2; i < start_.size(); ++i) start_[i] += start_[i - 1];
        for (std::uint32_t e = 0; e < edges.size(); ++e) {
            edges_[start_[edges[e].plus + 1]++] = e;
            edges_[start_[edges[e].minus + 1]++] = e;
        }
    }
    std::span<const std::uint32_t> of(std::size_t v) const {
        return std::span(edges_).subspan(start_[v], start_[v + 1] - start_[v]);
    }

private:
    std::vector<std::uint32_t> start_, edges_;
};

struct Candidate {
    double distance;  // mean fraction of its mixed edges up to their cut points
    std::uint32_t vertex;
};

std::vector<char> marks_of_box(const LatticeView& lattice) {
    const Box3 box = bounding_box(lattice.points);
    std::vector<char> marks(lattice.points.size(), 0);
    for (std::size_t v = 0; v < marks.size(); ++v)
        marks[v] = lies_on(box, lattice.points[v]) ? 1 : 0;
    return marks;
}

}  // namespace

EdgeTable::EdgeTable(std::size_t expected) {
    std::size_t size = 1024;
    while (size < 2 * expected) size *= 2;
    slots_.assign(size, Slot{unused, 0});
}

std::uint32_t EdgeTable::number(std::uint32_t plus, std::uint32_t minus,
                                std::vector<MixedEdge>& edges) {
    const std::uint64_t key = key_of(plus, minus);
    Slot* slot = &slots_[slot_of(key)];
    if (slot->key == key) return slot->number;
    if (2 * (size_ + 1) > slots_.size()) {
        grow();
        slot = &slots_[slot_of(key)];
    }
    ++size_;
    *slot = {key, static_cast<std::uint32_t>(edges.size())};
    edges.push_back({plus, minus, 0.5});
    return slot->number;
}

void EdgeTable::grow() {
    std::vector<Slot> old(2 * slots_.size(), Slot{unused, 0});
    old.swap(slots_);
    for (const Slot& slot : old) {
        if (slot.key != unused) slots_[slot_of(slot.key)] = slot;
    }
}

std::vector<Snapped> snap_vertices(const LatticeView& lattice, std::span<const MixedEdge> edges,
                                   Signs& signs, StuffReport& report, const CancelToken* cancel) {
    const std::size_t points = lattice.points.size();
    const EdgesOfVertices of(points, edges);
    const std::vector<char> on_box = marks_of_box(lattice);
    std::vector<char> active(points, 0);
    std::vector<Candidate> order;
    std::vector<std::uint32_t> open(points, 0);  // remaining cut points on its edges
    for (std::uint32_t v = 0; v < points; ++v) {
        const auto own = of.of(v);
        open[v] = static_cast<std::uint32_t>(own.size());
        if (own.empty() || on_box[v] != 0) continue;
        double sum = 0.0;
        for (const std::uint32_t e : own) sum += edges[e].plus == v ? edges[e].t : 1.0 - edges[e].t;
        order.push_back({sum / static_cast<double>(own.size()), v});
        active[v] = 1;
    }
    std::sort(order.begin(), order.end(), [](const Candidate& x, const Candidate& y) {
        return x.distance != y.distance ? x.distance < y.distance : x.vertex < y.vertex;
    });
    const StarTable stars(lattice.tets, active);
    CutLink link(points);
    std::vector<Snapped> snapped;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i % 1024 == 0 && cancel != nullptr && cancel->cancelled())
            throw CancelledError("the run was stopped while it made its initial mesh");
        const std::uint32_t v = order[i].vertex;
        // Replacing one cut point by one lattice vertex would gain nothing.
        if (open[v] < 2) continue;
        if (!link.allows_snap(v, stars.of(v), lattice.tets, signs)) {
            ++report.refused_snaps;
            continue;
        }
        Vec3 sum = Vec3::Zero();
        for (const std::uint32_t e : of.of(v)) {
            const MixedEdge& edge = edges[e];
            sum += (1.0 - edge.t) * lattice.points[edge.plus] + edge.t * lattice.points[edge.minus];
            --open[edge.plus == v ? edge.minus : edge.plus];
        }
        open[v] = 0;
        signs[v] = 0;
        snapped.push_back({v, sum / static_cast<double>(of.of(v).size())});
    }
    report.snapped_vertices = snapped.size();
    return snapped;
}

}  // namespace dsc::generate::stuffing
