// Homotopic growth of labels over weak values, and counts of the topology.
#include "dsc/generate/topology_filter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include <dsc/base/union_find.hpp>

#include "generate/label_interface.hpp"

namespace dsc::generate {
namespace {

using Corners = std::array<std::uint32_t, 4>;
constexpr std::uint32_t no_slot = std::numeric_limits<std::uint32_t>::max();

// Separates certain values, whose components are found once, from weak values with the tets around
// them.
class Filter {
public:
    Filter(std::span<const Vec3> points, std::span<const Corners> tets, std::span<double> values,
           double tau)
        : points_(points),
          tets_(tets),
          values_(values),
          tau_(tau),
          box_(bounding_box(points)),
          certain_(points.size()),
          slot_(points.size(), no_slot) {
        for (std::size_t v = 0; v < points.size(); ++v) {
            if (!(std::abs(values[v]) < tau)) continue;
            slot_[v] = static_cast<std::uint32_t>(weak_.size());
            weak_.push_back(static_cast<std::uint32_t>(v));
        }
        sort_tets();
        index_tets();
    }

    TopologyCounts count() const {
        UnionFind sets = certain_;
        InterfaceCounter interface(points_, box_);
        for (const std::vector<std::uint32_t>* list : {&weak_tets_, &cut_tets_}) {
            for (const std::uint32_t t : *list) {
                const Corners& tet = tets_[t];
                const std::array<bool, 4> in = {inside(tet[0]), inside(tet[1]), inside(tet[2]),
                                                inside(tet[3])};
                join_equal(sets, tet, in);
                interface.add(tet, in);
            }
        }
        return counts_of(sets, interface);
    }

    // Grows the inside (sign 1) or the outside (sign -1) over the weak values. Vertices that are
    // not reached change sides, unless the witness confirms their cluster.
    void grow(double sign, const LoopWitness& witness, TopologyFilterReport& report) {
        UnionFind sets = certain_;
        std::vector<std::uint8_t> in(points_.size(), 0);
        // number of vertices of the part with this root
        std::vector<std::uint32_t> certain(points_.size(), 0);
        for (std::size_t v = 0; v < points_.size(); ++v) {
            if (slot_[v] != no_slot || inside(v) != (sign > 0)) continue;
            in[v] = 1;
            ++certain[sets.find(static_cast<std::uint32_t>(v))];
        }
        std::vector<Step> steps;
        for (const std::uint32_t v : weak_) {
            if (inside(v) == (sign > 0)) steps.push_back({sign * values_[v], v});
        }
        const std::vector<Step> candidates = steps;
        std::priority_queue<Step> queue(std::less<Step>{}, std::move(steps));
        std::vector<std::uint8_t> refused(weak_.size(), 0);
        while (!queue.empty()) {
            const Step step = queue.top();
            queue.pop();
            if (in[step.vertex] != 0) continue;
            look_round(step.vertex, in, sets);
            refused[slot_[step.vertex]] = 1;
            if (link_components_ > roots_.size()) continue;
            const std::uint32_t together = attach(step, sign, certain, report);
            in[step.vertex] = 1;
            std::uint32_t root = step.vertex;
            for (const std::uint32_t r : roots_) root = sets.join(root, r);
            certain[root] = together;
            for (const std::uint32_t u : link_) {
                const std::uint32_t slot = slot_[u];
                if (in[u] != 0 || slot == no_slot || refused[slot] == 0) continue;
                refused[slot] = 0;
                queue.push({sign * values_[u], u});
            }
        }
        std::vector<Step> left;
        for (const Step& s : candidates) {
            if (in[s.vertex] == 0) left.push_back(s);
        }
        for (RefusedCluster& cluster : clusters_of(left, sign)) {
            if (witness && witness(cluster)) {
                report.confirmed.push_back(std::move(cluster));
                continue;
            }
            for (const std::uint32_t v : cluster.vertices)
                values_[v] = -sign * std::min(1e-3, 0.5 * tau_);
            report.refused += cluster.vertices.size();
            report.clusters.push_back(std::move(cluster));
        }
    }

private:
    // A vertex that may be added; the larger step is tried first.
    struct Step {
        double level;
        std::uint32_t vertex;
        bool operator<(const Step& other) const {
            return level != other.level ? level < other.level : vertex > other.vertex;
        }
    };

    bool inside(std::size_t v) const { return values_[v] > 0; }

    static void join_equal(UnionFind& sets, const Corners& tet, const std::array<bool, 4>& in) {
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = i + 1; j < 4; ++j) {
                if (in[i] == in[j]) sets.join(tet[i], tet[j]);
            }
        }
    }

    // Joins certain vertices of a label; lists the tets with weak vertices, and the other tets with
    // both labels.
    void sort_tets() {
        std::vector<std::uint8_t> kind(points_.size());  // 0 outside, 1 inside, 2 weak
        for (std::size_t v = 0; v < kind.size(); ++v)
            kind[v] = slot_[v] != no_slot ? 2 : inside(v) ? 1 : 0;
        for (std::size_t t = 0; t < tets_.size(); ++t) {
            const Corners& tet = tets_[t];
            const std::array<std::uint8_t, 4> k = {kind[tet[0]], kind[tet[1]], kind[tet[2]],
                                                   kind[tet[3]]};
            if (k[0] == k[1] && k[0] == k[2] && k[0] == k[3] && k[0] != 2) {
                certain_.join(tet[0], tet[1]);
                certain_.join(tet[0], tet[2]);
                certain_.join(tet[0], tet[3]);
                continue;
            }
            const bool weak = ((k[0] | k[1] | k[2] | k[3]) & 2) != 0;
            (weak ? weak_tets_ : cut_tets_).push_back(static_cast<std::uint32_t>(t));
            for (std::size_t i = 0; i < 4; ++i) {
                for (std::size_t j = i + 1; j < 4; ++j) {
                    if (k[i] == k[j] && k[i] != 2) certain_.join(tet[i], tet[j]);
                }
            }
        }
    }

    // Lists the tets around each weak vertex.
    void index_tets() {
        begin_.assign(weak_.size() + 1, 0);
        for (const std::uint32_t t : weak_tets_) {
            for (const std::uint32_t v : tets_[t]) {
                if (slot_[v] != no_slot) ++begin_[slot_[v] + 1];
            }
        }
        for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
        round_.resize(begin_.back());
        std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
        for (const std::uint32_t t : weak_tets_) {
            for (const std::uint32_t v : tets_[t]) {
                if (slot_[v] != no_slot) round_[next[slot_[v]]++] = t;
            }
        }
        seen_.assign(points_.size(), {0, 0});
    }

    std::span<const std::uint32_t> tets_round(std::uint32_t v) const {
        const std::uint32_t slot = slot_[v];
        return std::span(round_).subspan(begin_[slot], begin_[slot + 1] - begin_[slot]);
    }

    // Lists the parts that the vertex connects to the largest part around it. Returns the total
    // size.
    std::uint32_t attach(const Step& step, double sign, const std::vector<std::uint32_t>& certain,
                         TopologyFilterReport& report) const {
        std::uint32_t together = 0, largest = 0;
        std::size_t of_largest = 0;
        for (std::size_t i = 0; i < roots_.size(); ++i) {
            together += certain[roots_[i]];
            if (certain[roots_[i]] <= largest) continue;
            largest = certain[roots_[i]];
            of_largest = i;
        }
        if (together == largest) return together;
        for (std::size_t i = 0; i < roots_.size(); ++i) {
            const std::size_t size = certain[roots_[i]];
            if (i == of_largest || size == 0) continue;
            report.attachments.push_back({step.level, points_[step.vertex], size, sign > 0});
        }
        return together;
    }

    // Finds the vertices of the link, the number of components of its grown part, and the roots of
    // these components in the whole grown part.
    void look_round(std::uint32_t v, const std::vector<std::uint8_t>& in, UnionFind& sets) {
        ++visit_;
        link_.clear();
        local_.clear();
        const auto number = [&](std::uint32_t u) {
            if (seen_[u].visit != visit_) {
                seen_[u] = {visit_, static_cast<std::uint32_t>(link_.size())};
                link_.push_back(u);
                local_.push_back(seen_[u].index);
            }
            return seen_[u].index;
        };
        const auto find = [&](std::uint32_t i) {
            while (local_[i] != i) i = local_[i];
            return i;
        };
        for (const std::uint32_t t : tets_round(v)) {
            std::uint32_t first = no_slot;
            for (const std::uint32_t u : tets_[t]) {
                if (u == v) continue;
                const std::uint32_t at = number(u);
                if (in[u] == 0) continue;
                const std::uint32_t root = find(at);
                if (first == no_slot) {
                    first = root;
                } else if (root != first) {
                    const auto [low, high] = std::minmax(first, root);
                    local_[high] = low;
                    first = low;
                }
            }
        }
        link_components_ = 0;
        roots_.clear();
        for (std::uint32_t i = 0; i < link_.size(); ++i) {
            if (in[link_[i]] == 0 || local_[i] != i) continue;
            ++link_components_;
            const std::uint32_t root = sets.find(link_[i]);
            if (std::find(roots_.begin(), roots_.end(), root) == roots_.end())
                roots_.push_back(root);
        }
    }

    TopologyCounts counts_of(UnionFind& sets, const InterfaceCounter& interface) const {
        TopologyCounts out;
        std::vector<std::uint8_t> on_box(points_.size(), 0);
        for (std::size_t v = 0; v < points_.size(); ++v) {
            if ((points_[v].array() == box_.low.array()).any() ||
                (points_[v].array() == box_.high.array()).any()) {
                on_box[sets.find(static_cast<std::uint32_t>(v))] = 1;
            }
        }
        std::size_t all = 0;
        for (std::size_t v = 0; v < points_.size(); ++v) {
            if (sets.find(static_cast<std::uint32_t>(v)) != v) continue;
            ++all;
            if (inside(v)) {
                ++out.components;
            } else if (on_box[v] == 0) {
                ++out.cavities;
            }
        }
        // In a box, labels that touch each other form a tree.
        out.shells = all == 0 ? 0 : all - 1;
        out.euler = interface.euler();
        out.closed = interface.closed();
        return out;
    }

    // Groups of neighbouring refused vertices, in the order of their lowest vertices.
    std::vector<RefusedCluster> clusters_of(const std::vector<Step>& refused, double sign) const {
        std::vector<std::uint32_t> index(weak_.size(), no_slot);
        for (std::size_t i = 0; i < refused.size(); ++i) {
            index[slot_[refused[i].vertex]] = static_cast<std::uint32_t>(i);
        }
        UnionFind sets(refused.size());
        for (std::uint32_t i = 0; i < refused.size(); ++i) {
            for (const std::uint32_t t : tets_round(refused[i].vertex)) {
                for (const std::uint32_t u : tets_[t]) {
                    if (slot_[u] != no_slot && index[slot_[u]] != no_slot)
                        sets.join(i, index[slot_[u]]);
                }
            }
        }
        std::vector<RefusedCluster> out;
        std::vector<std::size_t> cluster(refused.size());
        for (std::uint32_t i = 0; i < refused.size(); ++i) {
            const std::uint32_t root = sets.find(i);
            if (root == i) {
                cluster[i] = out.size();
                out.push_back({Vec3::Zero(), 0, {}, sign > 0});
            }
            RefusedCluster& c = out[cluster[root]];
            c.place += points_[refused[i].vertex];
            c.level = std::max(c.level, refused[i].level);
            c.vertices.push_back(refused[i].vertex);
        }
        for (RefusedCluster& c : out) c.place /= static_cast<double>(c.vertices.size());
        return out;
    }

    struct Seen {
        std::uint32_t visit, index;
    };

    std::span<const Vec3> points_;
    std::span<const Corners> tets_;
    std::span<double> values_;
    double tau_;
    Box3 box_;
    UnionFind certain_;
    std::vector<std::uint32_t> slot_;  // index of each point among the weak points
    std::vector<std::uint32_t> weak_, weak_tets_, cut_tets_;
    std::vector<std::uint32_t> begin_, round_;  // tets round each weak point
    // Of the last vertex that was tested.
    std::vector<Seen> seen_;
    std::uint32_t visit_ = 0;
    std::vector<std::uint32_t> link_, local_, roots_;
    std::size_t link_components_ = 0;
};

}  // namespace

TopologyCounts count_topology(std::span<const Vec3> points, std::span<const Corners> tets,
                              std::span<const double> values) {
    std::vector<double> copy(values.begin(), values.end());
    return Filter(points, tets, copy, 0).count();
}

TopologyFilterReport filter_topology(std::span<const Vec3> points, std::span<const Corners> tets,
                                     std::span<double> values, double tau,
                                     const LoopWitness& witness) {
    TopologyFilterReport report;
    Filter filter(points, tets, values, tau);
    report.before = filter.count();
    filter.grow(1, witness, report);
    filter.grow(-1, witness, report);
    report.inside = weakest_attachment(report, true, 1);
    report.outside = weakest_attachment(report, false, 1);
    report.after = report.refused == 0 ? report.before : filter.count();
    return report;
}

std::optional<Attachment> weakest_attachment(const TopologyFilterReport& report, bool inside,
                                             std::size_t least_vertices) {
    std::optional<Attachment> out;
    for (const Attachment& a : report.attachments) {
        if (a.inside == inside && a.vertices >= least_vertices && (!out || a.level < out->level))
            out = a;
    }
    return out;
}

}  // namespace dsc::generate
