#pragma once
// Attributes of surfaces in the report's viewer: a byte per vertex that is drawn.

#include <cstddef>
#include <dsc/base/workers.hpp>
#include <dsc/geometry/vec.hpp>
#include <dsc/io/data_array.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace dsc::run {

/// Attributes where a file has them, one value per point; a value may be NaN.
struct AttributeSource {
    std::vector<Vec3> points;
    std::vector<io::DataArray> arrays;
};

/// The arrays that are attributes by their names and have a finite value somewhere, in their order, the first of each name.
std::vector<io::DataArray> attributes_among(std::vector<io::DataArray> arrays);

/// The points where an attribute has a finite value, in their order: a volume has none off its surface.
AttributeSource with_values(const AttributeSource& source);

/// The level of a vertex without a value; those with one have 0 to 254.
inline constexpr unsigned char no_level = 255;

/// For viewer.js: name, low and high as io::colour_bounds(), and the base64 of a level per drawn vertex, which is that of the
/// nearest point of the source. Empty without attributes. Throws GeometryError "cloud.non_finite" for a point of the source.
/// [setup]
nlohmann::ordered_json pack_attributes(const AttributeSource& source, const std::vector<Vec3>& drawn, Workers* workers);

}  // namespace dsc::run
