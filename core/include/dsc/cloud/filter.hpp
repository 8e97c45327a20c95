#pragma once
// Filters that thin a cloud, remove its outliers or what lies inside. Lengths are fractions of the diagonal of the cloud's
// box, unless they say otherwise. Every filter returns points of the input, bit for bit, with all their attributes, in the
// order of the input unless it says otherwise. Only an orientation that the cloud brings is lost with the first point that
// is removed or changes its place in the order: its samples stood for the points that there were.

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
    std::vector<RemovedPoints> reasons{};  ///< empty where there is only one; else their counts add up to `removed`
    std::vector<std::pair<std::string, double>> figures{};  ///< further figures for summary.json: snake_case name and value
    std::vector<std::string> notes{};  ///< what a user should hear, a sentence on one line each: in the log, summary.json and report
};

struct Filtered {
    Cloud cloud;
    FilterReport report;
};

struct DuplicatesOptions {
    double tolerance = 0.0;  ///< a point this close to an earlier kept one is removed; 0: only equal points
    bool sort = false;       ///< the kept points lexicographically by x, y and z, whatever their order was
};

struct VoxelGridOptions {
    double size = 0.01;  ///< edge of a cell
};

struct StatisticalOutliersOptions {
    std::size_t neighbours = 16;  ///< of which the mean distance is taken
    double deviations = 2.0;  ///< how many standard deviations above the mean of all points a point may lie
};

struct RadiusOutliersOptions {
    double radius = 0.02;
    std::size_t neighbours = 4;  ///< a point with fewer other points within the radius is removed
};

struct OutliersOptions {
    double isolated = 2.5;  ///< how many times as far apart as its neighbours and as most points an outlier lies
    double far = 8.0;       ///< how many times as far apart as most points a point may lie at all
    double most = 0.25;     ///< if more than this part of the points would go, none goes: the cloud is uneven, not dirty
    double dirty = 0.005;   ///< if more than this part lies apart, it is searched for outliers that only a search round by round finds
};

struct ClustersOptions {
    double closer = 0.3;  ///< a point this close to an earlier kept one is removed; 1: as far as evenly spread points are
};

struct HiddenOptions {
    std::size_t views = 200;  ///< directions all round
    double radius = 0.8;      ///< of the discs that stand for the surface, in spacings of the cloud
    double depth = 0.45;      ///< how far behind a disc, in spacings, a point must lie to be hidden by it
    double share = 0.04;      ///< a point that this part of the views or fewer see is removed
};

/// The points with these indices and all their attributes, in this order. The orientation stays only where these are all
/// points in their own order. Attributes of a wrong size are left out. Throws std::out_of_range. [setup]
Cloud pick(const Cloud& cloud, std::span<const std::size_t> indices);

/// Removes repeated points, the first of each stays. -0 equals 0.
///
/// With `sort`, the points are ordered before any is removed: by x, y and z, equal points by their colours, normals, areas
/// and confidences in this order, then by the sign of their zeros. Only points that agree in every bit of all of these keep
/// no order, and it does not matter which of them stays: the result is the same, bit for bit, in whatever order the points
/// came. Of equal points, the one with the least attributes stays. [setup]
Filtered remove_duplicates(const Cloud& cloud, const DuplicatesOptions& options = {});

/// Keeps one point of every occupied cell: the one nearest to the centroid of the cell's points. [setup]
Filtered voxel_grid(const Cloud& cloud, const VoxelGridOptions& options = {});

/// Removes points whose mean distance to their neighbours is unusually large [Rusu2008]. [setup]
Filtered remove_statistical_outliers(const Cloud& cloud, const StatisticalOutliersOptions& options = {});

/// Removes points with few neighbours within a radius. [setup]
Filtered remove_radius_outliers(const Cloud& cloud, const RadiusOutliersOptions& options = {});

/// Removes points far from all others. How far apart points lie is the distance to their 8th neighbour; "isolated" ones
/// exceed `isolated` times both the median of their 8 neighbours' distances and that of all points, "far" ones exceed
/// `far` times the median of all. Where more than half of the points repeat others, that median is 0 and none goes.
///
/// If these and the points that fill space as in a ball, twice as far apart as most points, are more than 8 and more than the
/// part `dirty`, the cloud is dirty. Then these go as well: "strewn" ones, which fill space, 1.5 times as far apart as most;
/// "off_surface" ones, off the plane of those neighbours that lie closer together; all this again without those that went, up
/// to 8 times; at last "clump" ones, in small groups, no neighbours of others, that fill space or have 8 points at most. The
/// number of threads and the order of the points change nothing. `workers` may be null: one thread. [setup]
Filtered remove_outliers(const Cloud& cloud, const OutliersOptions& options = {}, Workers* workers = nullptr);

/// Thins places where points crowd together: of points that lie much closer to each other than the points round them
/// are apart, the first stays. Lengths count in the distance that the 24 nearest points would have from each other if
/// they were spread evenly over a flat piece of surface. A cloud of fewer points stays as it is. [setup]
Filtered remove_clusters(const Cloud& cloud, const ClustersOptions& options = {});

/// Removes points that no view from outside can see: interior parts of the object. Each point stands for a disc in the
/// plane of its nine nearest, itself among them; from each direction the discs are drawn into a buffer of depths, as in
/// visibility splatting [Pfister2000], and a point is seen where no disc lies in front of it. It needs no surface and no
/// normals; where the cloud is sparse, only what lies deeper than about half a spacing can be told from the surface.
/// (The spherical flipping of [Katz2007], from 60 views, took the thesis' clouds for wholly visible or removed 14 to 21
/// visible points with every hidden one: they are too sparse for it.) The cost grows with points times views.
/// `cancel` is asked between views and may be null; throws CancelledError. [setup]
Filtered remove_hidden(const Cloud& cloud, const HiddenOptions& options = {}, const CancelToken* cancel = nullptr);

// Each filter throws GeometryError: "cloud.empty" for a cloud without points, "cloud.non_finite" for NaN or
// infinity, "cloud.option" for an option out of range, "cloud.filtered_out" if no point would be left.

}  // namespace dsc::cloud
