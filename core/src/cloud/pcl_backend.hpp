#pragma once
// What PCL does for this module. PCL is loaded at the first call.

#include <cstddef>
#include <string>
#include <vector>

#include <dsc/cloud/read.hpp>
#include <dsc/geometry/vec.hpp>

namespace dsc::cloud {

struct PclBackend {
    /// The points of a PCD or PLY file, after its check. Points with NaN or infinity are left out
    /// and counted. Header and body of a PCD are read separately, because PCL's reader of complete
    /// files searches the body for further header lines. `names` receives the names of the points'
    /// properties. Throws IoError.
    Cloud (*read_pcd)(const std::string& file, std::string bytes, ReadReport& report,
                      std::vector<std::string>& names);
    Cloud (*read_ply)(const std::string& file, std::string bytes, ReadReport& report,
                      std::vector<std::string>& names);

    /// Indices of the points that stay, ascending. The box of `points` has a diagonal of 1 and is
    /// centred at the origin, because PCL computes with floats; 0 < neighbours < size.
    std::vector<std::size_t> (*statistical_inliers)(const std::vector<Vec3>& points,
                                                    std::size_t neighbours, double deviations);
    /// As above; `radius` is in the units of `points`.
    std::vector<std::size_t> (*radius_inliers)(const std::vector<Vec3>& points, double radius,
                                               std::size_t neighbours);
};

/// Throws Error "backend.load". [setup]
const PclBackend& pcl_backend();

}  // namespace dsc::cloud
