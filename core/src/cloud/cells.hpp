#pragma once
// Points of a scaled cloud by the cells of a grid.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <dsc/geometry/vec.hpp>

namespace dsc::cloud {

/// Cells are numbered by their first point.
struct Cells {
    std::vector<std::uint32_t> of_point;  ///< cell of each point
    std::vector<std::uint32_t> counts;    ///< points of each cell
};

/// Edges are raised to this, so that a cell's place fits into a number.
inline constexpr double least_cell_edge = 1e-6;

/// Sorts points with coordinates in [-0.7, 0.7] into cells of an edge. [setup]
Cells cells_of(std::span<const Vec3> points, double edge);
/// How many there would be. [setup]
std::size_t count_cells(std::span<const Vec3> points, double edge);

/// Mean of the values per cell. [setup]
std::vector<Vec3> means_of(const Cells& cells, std::span<const Vec3> values);

}  // namespace dsc::cloud
