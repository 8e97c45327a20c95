#pragma once
// Attaches vertices to points if the spacing is uneven.

#include <cstdint>
#include <span>
#include <vector>

#include <dsc/surface/face_points.hpp>

#include "rows.hpp"

namespace dsc::strategies::fit {

inline constexpr std::uint32_t no_point = 0xffffffffU;

/// For each vertex the nearest of the points at the vertex, or no_point. A point is at a vertex if
/// its nearest place is on one of the vertex' faces, the other corners of the face are not nearer,
/// and its distance is at most `reach` of the vertex' length. A point belongs to one vertex at
/// most. Ties go to the lower index. Spans per point, or per vertex for `lengths`. [step]
void attach_vertices(const surface::SurfaceView& view, std::span<const Vec3> points,
                     std::span<const surface::FacePoint> places, std::span<const double> lengths,
                     double reach, std::vector<std::uint32_t>& attached);

/// Writes three rows per vertex from `first` on, which already exist: an attached vertex moves all
/// the way to its point, with ten times the weight of a nearby point; the rows of the other
/// vertices have no effect. [step]
void attachment_rows(const surface::SurfaceView& view, std::span<const Vec3> points,
                     std::span<const std::uint32_t> attached, std::span<const double> widths,
                     std::size_t first, RowSystem& system, Workers* workers);

}  // namespace dsc::strategies::fit
