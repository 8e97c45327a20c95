#pragma once
// The star of one vertex as a labelled graph: in the complex as it is, with trial labels, or as it
// would be after an edit. It answers whether the vertex is regular and what it adds to the
// interface's Euler number (method.md, sections 2 and 4.1).

#include <cstdint>
#include <span>
#include <vector>

#include <dsc/mesh/complex.hpp>

namespace dsc::mesh {

/// Nodes are the tets of the star; faces that contain the vertex join them. A box vertex has one
/// more node: the outside, with label 0. Reuse one object: nothing is allocated after its arrays
/// have grown.
class LocalStar {
public:
    explicit LocalStar(const Complex& complex) : complex_(complex) {}

    /// The star in the complex as it is.
    void build(VertexId v);
    /// The same, but with label `trial` for the tets in `region`.
    void build(VertexId v, std::span<const TetId> region, Label trial);
    /// The star of v (which may be created_vertex) after a linked edit.
    void build(VertexId v, const Edit& edit);

    /// Whether, for every label in the star, its tets form one face-connected group and all other
    /// tets form one group.
    bool regular();
    /// Number of groups of face-connected equal labels.
    unsigned groups();
    /// Group of each node, valid after groups(); node order is that of nodes().
    std::span<const std::uint32_t> group_of() const { return group_; }
    /// Tets of the nodes (none for the outside). Only for stars built without an edit.
    std::span<const TetId> nodes() const { return tets_; }
    Label label(std::size_t node) const { return labels_[node]; }
    /// Neighbouring nodes by face; none where the face does not contain the vertex.
    const std::array<std::uint32_t, 4>& neighbours(std::size_t node) const {
        return adjacent_[node];
    }

    bool on_interface() const;
    /// Six times the vertex' share of V - E + F of the interface: 6 - 3 (interface edges) + 2
    /// (interface faces); 0 off the interface.
    int euler_share() const;

private:
    void add_node(TetId t, Label label, const std::array<VertexId, 4>& corners) {
        tets_.push_back(t);
        labels_.push_back(label);
        corners_.push_back(corners);
        adjacent_.push_back({none, none, none, none});
    }
    std::span<const TetId> star_with_places(VertexId v);
    unsigned flood(bool complement, Label label);

    const Complex& complex_;
    VertexId vertex_ = none;
    std::vector<TetId> tets_;
    std::vector<Label> labels_;
    std::vector<std::array<std::uint32_t, 4>> adjacent_;
    std::vector<std::array<VertexId, 4>> corners_;
    std::vector<std::uint32_t> group_;
    std::vector<std::uint32_t> stack_;
    mutable std::vector<VertexId> ends_;
    TetIndex places_;  // of the star's tets
    StarWalk walk_;
    std::vector<std::uint32_t> node_of_;  // by place; none where an edit removes the tet
};

}  // namespace dsc::mesh
