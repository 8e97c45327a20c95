#pragma once
// The box of a lattice and the number of its cells, from the options.

#include <string_view>

#include <dsc/base/error.hpp>
#include <dsc/generate/lattice.hpp>

#include "generate/lattice_octree.hpp"

namespace dsc::generate::lattice {

inline constexpr std::size_t most_leaves = 12'000'000;  // these make about 60 to 150 million tets

/// Level of the largest cells.
unsigned top_level(const LatticeOptions& options);
/// The box in finest cells; their number is a multiple of the largest cells.
Frame frame_of(const LatticeOptions& options);
/// The error for more than most_leaves cells.
ConfigError too_large(std::string_view name, std::size_t leaves, std::string_view remedy);

}  // namespace dsc::generate::lattice
