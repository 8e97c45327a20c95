// The star of a vertex as a labelled graph: regularity and share of the Euler number (method.md,
// sections 2 and 4.1).
#include "dsc/mesh/local_star.hpp"

#include <algorithm>

namespace dsc::mesh {
namespace {

constexpr std::uint32_t removed_node = none - 1;

}  // namespace

std::span<const TetId> LocalStar::star_with_places(VertexId v) {
    const std::span<const TetId> star = complex_.cached_star(v, walk_).tets;
    places_.clear();
    for (const TetId t : star) places_.insert(t);
    return star;
}

void LocalStar::build(VertexId v) { build(v, std::span<const TetId>(), 0); }

void LocalStar::build(VertexId v, std::span<const TetId> region, Label trial) {
    vertex_ = v;
    const std::span<const TetId> star = star_with_places(v);
    tets_.assign(star.begin(), star.end());
    labels_.clear();
    corners_.clear();
    for (std::size_t i = 0; i < tets_.size(); ++i) {
        labels_.push_back(complex_.label(tets_[i]));
        corners_.push_back(complex_.tet(tets_[i]).v);
    }
    for (const TetId t : region) {
        if (const std::uint32_t i = places_.find(t); i != TetIndex::absent) labels_[i] = trial;
    }
    adjacent_.assign(tets_.size(), {none, none, none, none});
    bool outside = false;
    const auto outside_node = static_cast<std::uint32_t>(tets_.size());
    for (std::size_t i = 0; i < tets_.size(); ++i) {
        const Tet& tet = complex_.tet(tets_[i]);
        for (unsigned f = 0; f < 4; ++f) {
            if (tet.v[f] == v) continue;
            const std::uint32_t code = complex_.across(tets_[i], f);
            if (code == none) {
                adjacent_[i][f] = outside_node;
                outside = true;
            } else {
                adjacent_[i][f] = places_.find(neighbour_tet(code));
            }
        }
    }
    if (outside) add_node(none, 0, {none, none, none, none});
}

void LocalStar::build(VertexId v, const Edit& edit) {
    vertex_ = v;
    tets_.clear();
    labels_.clear();
    corners_.clear();
    adjacent_.clear();
    // Added tets first, so that added_node gives the node number of a virtual code.
    stack_.assign(edit.added.size(), none);
    for (std::size_t i = 0; i < edit.added.size(); ++i) {
        const auto& x = edit.added[i].v;
        if (std::find(x.begin(), x.end(), v) == x.end()) continue;
        stack_[i] = static_cast<std::uint32_t>(tets_.size());
        add_node(none, edit.added[i].label, x);
    }
    const std::size_t virtual_nodes = tets_.size();
    if (v != created_vertex) {
        const std::span<const TetId> star = star_with_places(v);
        node_of_.assign(star.size(), none);
        for (const TetId t : edit.removed) {
            if (const std::uint32_t place = places_.find(t); place != TetIndex::absent)
                node_of_[place] = removed_node;
        }
        for (std::size_t place = 0; place < star.size(); ++place) {
            const TetId t = star[place];
            if (node_of_[place] == removed_node) {
                node_of_[place] = none;
                continue;
            }
            node_of_[place] = static_cast<std::uint32_t>(tets_.size());
            add_node(t, complex_.label(t), complex_.tet(t).v);
        }
    }
    bool outside = false;
    const auto outside_node = static_cast<std::uint32_t>(tets_.size());
    for (std::size_t i = virtual_nodes; i < tets_.size(); ++i) {
        const Tet& tet = complex_.tet(tets_[i]);
        for (unsigned f = 0; f < 4; ++f) {
            if (tet.v[f] == v) continue;
            const std::uint32_t code = complex_.across(tets_[i], f);
            if (code == none) {
                adjacent_[i][f] = outside_node;
                outside = true;
            } else {
                // none if removed: set from the other side
                adjacent_[i][f] = node_of_[places_.find(neighbour_tet(code))];
            }
        }
    }
    for (std::size_t a = 0; a < edit.added.size(); ++a) {
        const std::uint32_t node = stack_[a];
        if (node == none) continue;
        for (unsigned f = 0; f < 4; ++f) {
            if (edit.added[a].v[f] == v) continue;
            const std::uint32_t code = edit.neighbours[a][f];
            if (code == none) {
                adjacent_[node][f] = outside_node;
                outside = true;
            } else if ((code & Edit::virtual_code) != 0) {
                adjacent_[node][f] = stack_[(code & ~Edit::virtual_code) >> 2U];
            } else {
                const std::uint32_t other = node_of_[places_.find(neighbour_tet(code))];
                adjacent_[node][f] = other;
                adjacent_[other][neighbour_face(code)] = node;
            }
        }
    }
    if (outside) add_node(none, 0, {none, none, none, none});
}

// Numbers the face-connected groups of equal labels (complement false), or counts the connected
// groups of all nodes whose label is not `label` (complement true).
unsigned LocalStar::flood(bool complement, Label label) {
    const std::size_t n = tets_.size();
    group_.assign(n, none);
    // The outside has more than four neighbours. It is reached from its neighbours; then all nodes
    // next to it are pushed.
    const bool has_outside = n > 0 && corners_[n - 1][0] == none;
    const auto outside_node = static_cast<std::uint32_t>(n - 1);
    unsigned count = 0;
    const auto together = [&](std::uint32_t a, std::uint32_t b) {
        return complement ? labels_[b] != label : labels_[a] == labels_[b];
    };
    for (std::uint32_t start = 0; start < n; ++start) {
        if (group_[start] != none || (complement && labels_[start] == label)) continue;
        group_[start] = count;
        stack_.clear();
        stack_.push_back(start);
        while (!stack_.empty()) {
            const std::uint32_t node = stack_.back();
            stack_.pop_back();
            if (has_outside && node == outside_node) {
                for (std::uint32_t i = 0; i < outside_node; ++i) {
                    const auto& adj = adjacent_[i];
                    if (group_[i] == none && together(node, i) &&
                        std::find(adj.begin(), adj.end(), outside_node) != adj.end()) {
                        group_[i] = count;
                        stack_.push_back(i);
                    }
                }
                continue;
            }
            for (const std::uint32_t next : adjacent_[node]) {
                if (next == none || group_[next] != none || !together(node, next)) continue;
                group_[next] = count;
                stack_.push_back(next);
            }
        }
        ++count;
    }
    return count;
}

unsigned LocalStar::groups() { return flood(false, 0); }

bool LocalStar::regular() {
    Label first = labels_.front();
    Label second = first;
    bool more = false;
    for (const Label l : labels_) {
        if (l == first) continue;
        if (second == first) {
            second = l;
        } else if (l != second) {
            more = true;
        }
    }
    if (second == first) return groups() == 1;
    if (!more) return groups() == 2;
    // Three labels or more: each label must form one group, and all other labels together must form
    // one.
    std::vector<Label> distinct(labels_);
    std::sort(distinct.begin(), distinct.end());
    distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
    if (groups() != distinct.size()) return false;
    return std::all_of(distinct.begin(), distinct.end(),
                       [this](Label l) { return flood(true, l) == 1; });
}

bool LocalStar::on_interface() const {
    return std::any_of(labels_.begin(), labels_.end(),
                       [this](Label l) { return l != labels_.front(); });
}

int LocalStar::euler_share() const {
    int faces = 0;
    ends_.clear();
    for (std::size_t i = 0; i < tets_.size(); ++i) {
        for (unsigned f = 0; f < 4; ++f) {
            const std::uint32_t other = adjacent_[i][f];
            if (other == none || labels_[other] == labels_[i]) continue;
            // Each face between two tets is seen from both; a face to the outside only from inside.
            if (corners_[other][0] != none && other < i) continue;
            ++faces;
            for (const auto k : face_vertices[f]) {
                if (corners_[i][k] != vertex_) ends_.push_back(corners_[i][k]);
            }
        }
    }
    if (faces == 0) return 0;
    std::sort(ends_.begin(), ends_.end());
    const auto edges = static_cast<int>(std::unique(ends_.begin(), ends_.end()) - ends_.begin());
    return 6 - 3 * edges + 2 * faces;
}

}  // namespace dsc::mesh
