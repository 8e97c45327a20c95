#pragma once
// The complexes that the micro benchmarks work on, made by the real pipeline when they are first
// asked for.

#include <array>
#include <string_view>

#include <dsc/cloud/target.hpp>
#include <dsc/mesh/complex.hpp>

namespace dsc::bench {

struct Snapshot {
    mesh::Complex complex;
    double length = 0.0;  ///< L
};

/// start: the grid of 135,000 tets; step5, step120: that grid on its way to the teapot; million,
/// shuffled: a grid of 1,080,000 tets, numbered in order and at random.
inline constexpr std::array<std::string_view, 5> snapshot_names = {"start", "step5", "step120",
                                                                   "million", "shuffled"};

/// One of them; it lives as long as the program. Throws std::out_of_range for another name.
const Snapshot& snapshot(std::string_view name);

/// The cloud that the snapshots move to.
const cloud::TargetCloud& target_cloud();

}  // namespace dsc::bench
