#pragma once
// Decides which vertices of a lattice become vertices of its interface.

#include <cstdint>
#include <span>
#include <vector>

#include <dsc/base/progress.hpp>
#include <dsc/generate/isosurface.hpp>

#include "generate/star_table.hpp"

namespace dsc::generate::stuffing {

/// An edge whose ends differ in sign, and the cut point on it.
struct MixedEdge {
    std::uint32_t plus, minus;
    double t;  ///< 0 at `plus`, 1 at `minus`
};

/// Finds mixed edges by their ends.
class EdgeTable {
public:
    explicit EdgeTable(std::size_t expected);
    /// Index of the edge; the first call with an edge adds it.
    std::uint32_t number(std::uint32_t plus, std::uint32_t minus, std::vector<MixedEdge>& edges);
    /// Index of an edge that the table contains.
    std::uint32_t find(std::uint32_t plus, std::uint32_t minus) const {
        return slots_[slot_of(key_of(plus, minus))].number;
    }

private:
    struct Slot {
        std::uint64_t key;
        std::uint32_t number;
    };
    static constexpr std::uint64_t unused = ~std::uint64_t{0};
    static std::uint64_t key_of(std::uint32_t plus, std::uint32_t minus) {
        return std::uint64_t{plus} << 32U | minus;
    }
    std::size_t slot_of(std::uint64_t key) const {
        const std::size_t mask = slots_.size() - 1;
        std::size_t at = static_cast<std::size_t>((key * 0x9e3779b97f4a7c15U) >> 24U) & mask;
        while (slots_[at].key != unused && slots_[at].key != key) at = (at + 1) & mask;
        return at;
    }
    void grow();

    std::vector<Slot> slots_;  // their number is a power of two
    std::size_t size_ = 0;
};

/// A vertex that has become a vertex of the interface, and its wanted position.
struct Snapped {
    std::uint32_t vertex;
    Vec3 target;  ///< mean of the cut points of its mixed edges
};

/// Signs of all vertices: 1 inside, -1 outside, 0 on the interface.
using Signs = std::vector<std::int8_t>;

/// Sets the sign of snapped vertices to 0, beginning with those nearest to their cut points. Sets
/// the counters of the report for snapping.
std::vector<Snapped> snap_vertices(const LatticeView& lattice, std::span<const MixedEdge> edges,
                                   Signs& signs, StuffReport& report, const CancelToken* cancel);

}  // namespace dsc::generate::stuffing
