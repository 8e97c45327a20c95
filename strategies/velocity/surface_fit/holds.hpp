#pragma once
// The resistance of vertices against motion.

#include <span>
#include <vector>

#include <dsc/base/workers.hpp>
#include <dsc/surface/surface_view.hpp>

#include "rows.hpp"

namespace dsc::strategies::fit {

/// One hold per vertex: weight `across`, times its squared target length, along the direction in
/// which the normals of its faces agree best (the first axis of the sum of area n n^T), and `along`
/// in the other two. [step]
void measure_holds(const surface::SurfaceView& view, std::span<const double> lengths, double along,
                   double across, Workers* workers, std::vector<Hold>& holds);

}  // namespace dsc::strategies::fit
