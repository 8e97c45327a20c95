#pragma once
// The least-squares problem of one iteration: rows over displacements, gathered per vertex.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <dsc/base/workers.hpp>
#include <dsc/geometry/vec.hpp>

namespace dsc::strategies::fit {

/// The residual direction . (sum of factor[k] u[vertex[k]]) - wanted, where u are the
/// displacements. The root of the row's weight is part of `direction` and of `wanted`. A row
/// without effect has no factor.
struct Row {
    Vec3 direction = Vec3::Zero();
    std::array<double, 4> factor{};
    std::array<std::uint32_t, 4> vertex{};
};

/// The resistance of a vertex against motion: u . D u with D = along (1 - a a^T) + across a a^T.
struct Hold {
    double along = 0.0;        ///< for the directions perpendicular to the axis
    Vec3 axis = Vec3::Zero();  ///< a, times the root of along - across

    Vec3 times(const Vec3& u) const { return along * u - axis * axis.dot(u); }
};

/// The problem: minimise the sum of the squared residuals and of the holds. Vertices that are not
/// movable have no entries.
struct RowSystem {
    struct Entry {
        double factor;
        std::uint32_t row;
    };
    std::vector<Row> rows;
    std::vector<double> wanted;          ///< per row
    std::vector<Hold> holds;             ///< per vertex
    std::vector<std::uint32_t> offsets;  ///< rows of vertex v: entries[offsets[v] .. offsets[v +
                                         ///< 1]), ascending
    std::vector<Entry> entries;

    std::size_t vertex_count() const { return holds.size(); }
    std::span<const Entry> entries_of(std::size_t vertex) const {
        return std::span(entries).subspan(offsets[vertex], offsets[vertex + 1] - offsets[vertex]);
    }
};

/// Fills offsets and entries from the rows, for `movable.size()` vertices. With them every sum over
/// rows is a sum per vertex, in the order of the rows: the same bits for any number of threads.
/// [step]
void gather_rows(RowSystem& system, std::span<const std::uint8_t> movable);

}  // namespace dsc::strategies::fit
