#pragma once
// Which vertices go to which points, where spacing is uneven.

#include <cstdint>
#include <span>
#include <vector>

#include <dsc/surface/face_points.hpp>

#include "rows.hpp"

namespace dsc::strategies::fit {

inline constexpr std::uint32_t no_point = 0xffffffffU;

/// For each vertex the nearest of the points that lie at it, or no_point: those whose nearest place is on one of its faces, to whose
/// other corners they are not nearer, and which are not further off than `reach` of the vertex' length. A point belongs to one
/// vertex at most. Ties go to the lower index. Spans per point, or per vertex for `lengths`. [step]
void attach_vertices(const surface::SurfaceView& view, std::span<const Vec3> points, std::span<const surface::FacePoint> places,
                     std::span<const double> lengths, double reach, std::vector<std::uint32_t>& attached);

/// Three rows per vertex from `first` on, which exist already: a vertex that is attached goes all the way to its point, with ten
/// times the weight of a point near it; the rows of the others have no effect. [step]
void attachment_rows(const surface::SurfaceView& view, std::span<const Vec3> points, std::span<const std::uint32_t> attached,
                     std::span<const double> widths, std::size_t first, RowSystem& system, Workers* workers);

}  // namespace dsc::strategies::fit
