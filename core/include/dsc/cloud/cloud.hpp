#pragma once
// A point cloud in double precision.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <dsc/geometry/vec.hpp>

namespace dsc::cloud {

/// Red, green, blue.
using Colour = std::array<std::uint8_t, 3>;

/// A piece of surface that represents one point or several points. The winding field is the sum
/// over all samples.
struct SurfaceSample {
    Vec3 position = Vec3::Zero();
    Vec3 area = Vec3::Zero();  ///< area vector: along the normal that points out of the solid; its
                               ///< length is the area
    double width = 0.0;        ///< square root of the area per sample at this place (label_width of
                               ///< statistics.hpp)
};

/// Inside and outside of a cloud, as cloud/orientation.hpp estimates them.
struct Orientation {
    std::vector<SurfaceSample> samples{};  ///< all points that are kept, or the means of the cells
                                           ///< of a large cloud
    double residual = 0.0;    ///< root mean square of 1/2 - w at the samples; w is their winding
                              ///< field
    double noise = 0.0;       ///< noise scale of the samples (sigma_q), in the cloud's units
    bool all_points = false;  ///< the coarse stage used every sample, so a finer orientation does
                              ///< not exist
    /// For a cloud recorded from one side: the displacement to a copy behind it, with which the
    /// cloud bounds a solid. The samples include those of the copy. Otherwise zero.
    Vec3 backing = Vec3::Zero();
    bool one_sided() const { return backing != Vec3::Zero(); }
    bool empty() const { return samples.empty(); }
};

/// Position of the scanner that saw all points of a cloud.
struct Sensor {
    Vec3 position = Vec3::Zero();  ///< in the units of the points
    bool stated = false;  ///< false: the file contains the value that programs write if they do not
                          ///< know the position
};

/// Points in the units of their file, with attributes from files and filters. Each attribute is
/// empty or has one entry per point.
struct Cloud {
    std::vector<Vec3> points;
    std::vector<Colour> colours{};
    std::string source{};  ///< file or shape from which the points come, for error messages; may be
                           ///< empty
    /// Unit vectors, or zero if unknown; after the filter `orient` they point out of the solid,
    /// before it they are as in the file.
    std::vector<Vec3> normals{};
    std::vector<Vec3> areas{};         ///< area vectors, in squared units
    std::vector<double> confidence{};  ///< of the normals, 0 to 1
    Orientation orientation{};         ///< empty before the filter `orient`
    std::optional<Sensor> sensor{};    ///< empty if the file does not name one
};

}  // namespace dsc::cloud
