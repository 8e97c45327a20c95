#pragma once
// Filters that thin a cloud, or remove its outliers or its interior points. Unless a comment says
// otherwise, lengths are fractions of the diagonal of the cloud's box, and points keep the order of
// the input. Every filter returns points of the input unchanged, with all their attributes. Only an
// existing orientation is lost as soon as a point is removed or changes its place in the order,
// because its samples represent the original points.

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <dsc/base/progress.hpp>
#include <dsc/base/workers.hpp>
#include <dsc/cloud/cloud.hpp>

namespace dsc::cloud {

/// How many points were removed for one reason.
struct RemovedPoints {
    std::string reason;  ///< "farther than 2.5 widths from its neighbours", ...
    std::size_t count = 0;
};

/// What a filter did.
struct FilterReport {
    std::string filter{};  ///< its name in an experiment: "duplicates", ...
    std::size_t kept = 0;
    std::size_t removed = 0;
    std::vector<RemovedPoints> reasons{};  ///< empty if there is only one reason; else the counts
                                           ///< add up to `removed`
    std::vector<std::pair<std::string, double>> figures{};  ///< further figures for summary.json:
                                                            ///< snake_case name and value
    std::vector<std::string> notes{};  ///< notes for the user in the log, summary.json and report:
                                       ///< one sentence on one line each
};

struct Filtered {
    Cloud cloud;
    FilterReport report;
};

struct DuplicatesOptions {
    double tolerance = 0.0;  ///< a point this close to an earlier kept one is removed; 0: only
                             ///< equal points
    bool sort = false;       ///< sort the kept points lexicographically by x, y and z
};

struct VoxelGridOptions {
    double size = 0.01;  ///< edge of a cell
};

struct StatisticalOutliersOptions {
    std::size_t neighbours = 16;  ///< number of neighbours for the mean distance
    double deviations = 2.0;      ///< largest distance above the mean of all points, in standard
                                  ///< deviations
};

struct RadiusOutliersOptions {
    double radius = 0.02;
    std::size_t neighbours = 4;  ///< a point with fewer other points within the radius is removed
};

struct OutliersOptions {
    double isolated = 2.5;  ///< an outlier is this many times as far apart as its neighbours and as
                            ///< most points
    double far = 8.0;       ///< largest allowed distance, as a multiple of that of most points
    double most = 0.25;     ///< if more than this fraction would be removed, none is: the cloud is
                            ///< uneven, not dirty
    double dirty = 0.005;   ///< if more than this fraction is far apart, the search for outliers is
                            ///< repeated in rounds
};

struct ClustersOptions {
    double closer = 0.3;  ///< a point this close to an earlier kept one is removed; 1: the distance
                          ///< of evenly spread points
};

struct HiddenOptions {
    std::size_t views = 200;  ///< number of directions all round
    double radius = 0.8;      ///< of the discs that represent the surface, in neighbour distances
    double depth = 0.45;  ///< least distance behind a disc, in neighbour distances, at which the
                          ///< disc hides a point
    double share = 0.04;  ///< points that at most this fraction of the views can see are removed
};

/// The points with these indices and all their attributes, in this order. The orientation is kept
/// only if these are all points in their original order. Attributes of a wrong size are left out.
/// Throws std::out_of_range. [setup]
Cloud pick(const Cloud& cloud, std::span<const std::size_t> indices);

/// Removes repeated points and keeps the first of each. -0 equals 0.
///
/// With `sort`, the points are ordered before any is removed: by x, y and z; equal points by their
/// colours, normals, areas and confidences in this order; then by the sign of their zeros. Points
/// that agree in every bit of all these have no order, and any of them may stay. So the result is
/// the same, bit for bit, for every order of the input. Of equal points, the one with the least
/// attributes stays. [setup]
Filtered remove_duplicates(const Cloud& cloud, const DuplicatesOptions& options = {});

/// Keeps one point per occupied cell: the one nearest to the centroid of the cell's points. [setup]
Filtered voxel_grid(const Cloud& cloud, const VoxelGridOptions& options = {});

/// Removes points whose mean distance to their neighbours is unusually large [Rusu2008]. [setup]
Filtered remove_statistical_outliers(const Cloud& cloud,
                                     const StatisticalOutliersOptions& options = {});

/// Removes points with few neighbours within a radius. [setup]
Filtered remove_radius_outliers(const Cloud& cloud, const RadiusOutliersOptions& options = {});

/// Removes points far from all others. The measure is the distance to the 8th neighbour. "isolated"
/// points exceed `isolated` times the median of their 8 neighbours' distances and also that of all
/// points; "far" points exceed `far` times the median of all. If more than half of the points
/// repeat others, the median is 0 and no point is removed.
///
/// The cloud is dirty if these points, together with points that fill space as in a ball and are
/// twice as far apart as most, are more than 8 and more than the fraction `dirty`. Then more points
/// are removed: "strewn" points, which fill space and are 1.5 times as far apart as most;
/// "off_surface" points, off the plane of those neighbours that lie closer together. All this is
/// repeated without the removed points, up to 8 times. Finally "clump" points are removed: small
/// groups that are not neighbours of other points and that fill space or have at most 8 points. The
/// result does not depend on the number of threads or the order of the points. `workers` may be
/// null: one thread. [setup]
Filtered remove_outliers(const Cloud& cloud, const OutliersOptions& options = {},
                         Workers* workers = nullptr);

/// Thins places where points are crowded: of points that are much closer to each other than the
/// points around them, the first is kept. Lengths are in units of the distance that the 24 nearest
/// points would have if they were spread evenly over a flat piece of surface. A cloud of fewer
/// points is returned unchanged. [setup]
Filtered remove_clusters(const Cloud& cloud, const ClustersOptions& options = {});

/// Removes points that no view from outside can see: interior parts of the object. Each point
/// represents a disc in the plane of its nine nearest points, itself included. From each direction
/// the discs are drawn into a depth buffer, as in visibility splatting [Pfister2000]; a point is
/// visible if no disc lies in front of it. The method needs no surface and no normals. Where the
/// cloud is sparse, only points deeper than about half a neighbour distance can be distinguished
/// from the surface. (The spherical flipping of [Katz2007], with 60 views, found the thesis' clouds
/// completely visible, or removed 14 to 21 visible points per hidden one: they are too sparse for
/// it.) The cost grows with points times views. `cancel` is tested between views and may be null.
/// Throws CancelledError. [setup]
Filtered remove_hidden(const Cloud& cloud, const HiddenOptions& options = {},
                       const CancelToken* cancel = nullptr);

// Each filter throws GeometryError: "cloud.empty" for a cloud without points, "cloud.non_finite"
// for NaN or infinity, "cloud.option" for an option out of range, "cloud.filtered_out" if no point
// would be left.

}  // namespace dsc::cloud
