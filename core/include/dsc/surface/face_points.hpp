#pragma once
// Where points of a cloud lie on a surface: the nearest face of each, and the place in it.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <dsc/base/workers.hpp>
#include <dsc/surface/surface_view.hpp>

namespace dsc::surface {

/// The nearest point of a surface.
struct FacePoint {
    std::uint32_t face = 0;                         ///< of the view; the lowest among equally near ones
    std::array<double, 3> weights = {1.0, 0.0, 0.0};  ///< barycentric, by the face's corners: at least 0, their sum is 1
    double distance = 0.0;
};

/// Fills `out` with the nearest place of each point; leaves it empty where the view has no face. Points and positions are finite.
/// The answers do not depend on the number of threads. `workers`, null for one thread, share the search. [step]
void nearest_faces(const SurfaceView& view, std::span<const Vec3> points, std::vector<FacePoint>& out, Workers* workers = nullptr);

}  // namespace dsc::surface
