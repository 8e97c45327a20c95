#pragma once
// Points of a scaled cloud by the cells of a grid.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <dsc/geometry/vec.hpp>

namespace dsc::cloud {

/// Cells are numbered in the order of their first points.
struct Cells {
    std::vector<std::uint32_t> of_point;  ///< cell of each point
    std::vector<std::uint32_t> counts;    ///< points of each cell
};

/// Shorter edges are raised to this, so that the position of a cell fits into an integer.
inline constexpr double least_cell_edge = 1e-6;

/// Sorts points with coordinates in [-0.7, 0.7] into cells with this edge. [setup]
Cells cells_of(std::span<const Vec3> points, double edge);
/// Number of these cells. [setup]
std::size_t count_cells(std::span<const Vec3> points, double edge);

/// Mean of the values per cell. [setup]
std::vector<Vec3> means_of(const Cells& cells, std::span<const Vec3> values);

}  // namespace dsc::cloud
