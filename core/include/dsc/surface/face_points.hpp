#pragma once
// The places of a cloud's points on a surface: the nearest face of each point, and the position in
// it.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <dsc/base/workers.hpp>
#include <dsc/surface/surface_view.hpp>

namespace dsc::surface {

/// The nearest point of a surface.
struct FacePoint {
    std::uint32_t face = 0;  ///< of the view; of equally near ones the lowest
    std::array<double, 3> weights = {1.0, 0.0, 0.0};  ///< barycentric, per corner of the face: at
                                                      ///< least 0, sum 1
    double distance = 0.0;
};

/// Fills `out` with the nearest place of each point; leaves it empty if the view has no face.
/// Points and positions must be finite. The result does not depend on the number of threads.
/// `workers`, null for one thread, share the search. [step]
void nearest_faces(const SurfaceView& view, std::span<const Vec3> points,
                   std::vector<FacePoint>& out, Workers* workers = nullptr);

}  // namespace dsc::surface
