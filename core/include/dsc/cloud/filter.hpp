#pragma once
// Filters that thin a cloud or remove its outliers. All lengths are fractions of the diagonal of the cloud's
// box. Every filter keeps the order of the input and returns points of the input, bit for bit.

#include <cstddef>
#include <string>

#include <dsc/cloud/cloud.hpp>

namespace dsc::cloud {

struct FilterReport {
    std::string filter;  ///< its name in an experiment: "duplicates", ...
    std::size_t kept = 0;
    std::size_t removed = 0;
};

struct Filtered {
    Cloud cloud;
    FilterReport report;
};

struct DuplicatesOptions {
    double tolerance = 0.0;  ///< a point this close to an earlier kept one is removed; 0: only equal points
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

/// Removes repeated points, the first of each stays. -0 equals 0. [setup]
Filtered remove_duplicates(const Cloud& cloud, const DuplicatesOptions& options = {});

/// Keeps one point of every occupied cell: the one nearest to the centroid of the cell's points. [setup]
Filtered voxel_grid(const Cloud& cloud, const VoxelGridOptions& options = {});

/// Removes points whose mean distance to their neighbours is unusually large [Rusu2008]. [setup]
Filtered remove_statistical_outliers(const Cloud& cloud, const StatisticalOutliersOptions& options = {});

/// Removes points with few neighbours within a radius. [setup]
Filtered remove_radius_outliers(const Cloud& cloud, const RadiusOutliersOptions& options = {});

// Each filter throws GeometryError: "cloud.empty" for a cloud without points, "cloud.non_finite" for NaN or
// infinity, "cloud.option" for an option out of range, "cloud.filtered_out" if no point would be left.

}  // namespace dsc::cloud
