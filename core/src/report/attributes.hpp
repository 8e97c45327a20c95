#pragma once
// Attributes of surfaces in the report's viewer: one byte per drawn vertex.

#include <vector>

#include <nlohmann/json.hpp>

#include <dsc/base/workers.hpp>
#include <dsc/geometry/vec.hpp>
#include <dsc/io/data_array.hpp>

namespace dsc::report {

/// Attributes and the points at which a file contains them, one value per point; a value may be
/// NaN.
struct AttributeSource {
    std::vector<Vec3> points;
    std::vector<io::DataArray> arrays;
};

/// The arrays whose names are allowed for attributes and that have a finite value, in their order;
/// the first of each name.
std::vector<io::DataArray> attributes_among(std::vector<io::DataArray> arrays);

/// The points where an attribute has a finite value, in their order; a volume has no values off its
/// surface.
AttributeSource with_values(const AttributeSource& source);

/// The level of a vertex without a value; vertices with a value have 0 to 254.
inline constexpr unsigned char no_level = 255;

/// For viewer.js: name, low and high as io::colour_bounds(), and the base64 text of one level per
/// drawn vertex, which is the level of the nearest point of the source. Empty without attributes.
/// Throws GeometryError "cloud.non_finite" for a point of the source. [setup]
nlohmann::ordered_json pack_attributes(const AttributeSource& source,
                                       const std::vector<Vec3>& drawn, Workers* workers);

}  // namespace dsc::report
