#pragma once
// The agreement of a surface with the points that it was made from.

#include <cstddef>
#include <span>
#include <vector>

#include <dsc/base/workers.hpp>
#include <dsc/cloud/normalize.hpp>
#include <dsc/cloud/statistics.hpp>
#include <dsc/hooks/figures.hpp>
#include <dsc/surface/distance.hpp>
#include <dsc/surface/triangle_mesh.hpp>

namespace dsc::run {

/// Points that are close together and far from the surface.
struct PointGroup {
    std::size_t points = 0;
    Vec3 centre = Vec3::Zero();  ///< mean of the points
    double diameter = 0.0;       ///< diagonal of their box
    double farthest = 0.0;       ///< largest distance of one of them from the surface
    double spacing = 0.0;  ///< median distance from one of them to the nearest far point; 0 if
                           ///< there is no other one
};

/// Lengths and places are in the units of surface and points. The spacing is the local
/// Statistics::point_width.
struct Coverage {
    std::size_t points = 0;
    double width = 0.0;             ///< median spacing
    double noise = 0.0;             ///< Statistics::noise
    std::size_t far_points = 0;     ///< points farther from the surface than 3 noise scales plus 1
                                    ///< spacing
    double largest_distance = 0.0;  ///< of a point from the surface
    Vec3 farthest_point = Vec3::Zero();
    std::vector<PointGroup> groups;  ///< groups of far points, including points that a filter
                                     ///< removed; the largest first
    double mean_edge = 0.0;          ///< of the surface
    double unsupported_share = 0.0;  ///< fraction of its area without a point within 3 spacings
    std::vector<double> gaps;  ///< per vertex of the surface: distance to the nearest point, in
                               ///< spacings of that point

    double far_share() const {
        return points == 0 ? 0.0 : static_cast<double>(far_points) / static_cast<double>(points);
    }
    /// Mean edge in spacings: the fineness of the surface. 0 if the spacing is 0.
    double resolution() const { return width > 0.0 ? mean_edge / width : 0.0; }
};

/// `distances` are the distances between the surface and the points, `statistics` those of the
/// points; `removed` are points that filters removed from the cloud. The result does not depend on
/// the number of threads. [step]
Coverage measure_coverage(const surface::TriangleMesh& surface, std::span<const Vec3> points,
                          const surface::CloudDistances& distances,
                          const cloud::Statistics& statistics, std::span<const Vec3> removed,
                          Workers* workers);

/// The warnings about a coverage, with places in the units of the input; `to_normalised` converts
/// these to the units of the coverage. Codes: "coverage.points" if more than 1 % of the points are
/// far; "coverage.missing" for groups of at least 0.1 % of the points whose own spacing is at most
/// 2 median spacings (points that are spread more widely bound no solid); "coverage.unsupported" if
/// more than 5 % of the area has no points. [setup]
hooks::Warnings warnings_of(const Coverage& coverage, const cloud::Transform& to_normalised);

}  // namespace dsc::run
