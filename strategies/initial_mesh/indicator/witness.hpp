#pragma once
// What the oriented samples say about bridges and tunnels that the topology filter refuses.

#include <dsc/cloud/cloud.hpp>
#include <dsc/cloud/search.hpp>
#include <dsc/generate/topology_filter.hpp>

namespace dsc::indicator {

/// A witness for generate::filter_topology() that asks the nearest samples of each refused vertex
/// on which side of their tangent planes the vertex lies. A handle that is about two spacings thick
/// has weak values of the field, yet all samples round it agree that its middle is inside. Between
/// two sheets that are close to each other, the samples agree on the opposite. `search` finds the
/// samples by their positions; `points` are the vertices of the lattice and `values` their values
/// before the filter. All must outlive the witness.
generate::LoopWitness tangent_plane_witness(std::span<const cloud::SurfaceSample> samples,
                                            const cloud::NearestSearch& search,
                                            std::span<const Vec3> points,
                                            std::span<const double> values);

}  // namespace dsc::indicator
