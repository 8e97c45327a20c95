#pragma once
// Attributes in files besides positions: which columns are normals or colours, and how they are
// converted.

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <dsc/cloud/cloud.hpp>
#include <dsc/cloud/read.hpp>

namespace dsc::cloud {

/// The columns, fields or properties of a file that are read besides the position, as indices into
/// all of them. Of several kinds of colours, the first kind in this struct is used.
struct AttributeColumns {
    std::optional<std::array<std::size_t, 3>> normals;
    std::optional<std::array<std::size_t, 3>> colours;  ///< red, green, blue
    std::optional<std::size_t> packed;                  ///< 0x00rrggbb as PCL writes it
    std::optional<std::size_t> intensity;
};

/// Finds them by their names, in upper or lower case: nx ny nz or normal_x normal_y normal_z; red
/// green blue, r g b or diffuse_red diffuse_green diffuse_blue; rgb or rgba; intensity, also with
/// `scalar_` before it, as CloudCompare writes it.
AttributeColumns attribute_columns(std::span<const std::string> names);

/// The names with the use of each, according to what was read.
std::vector<FoundProperty> found_properties(std::span<const std::string> names, const Cloud& cloud);

/// The unit vector along a normal of a file; a unit vector keeps every bit; a vector without a
/// direction becomes zero.
Vec3 direction_of(const Vec3& normal);

/// Whether three numbers of a text are a unit vector within the precision that programs write.
bool looks_like_unit(const Vec3& values);

/// Removes normals if none has a direction, or if their number differs from that of the points.
void keep_whole_normals(Cloud& cloud);

/// Colours from numbers: fractions of 1 if no number is larger; bytes up to 255; otherwise 16 bits.
/// `whole`: the numbers have an integer type, so 1 is a dark byte. NaN and negative values count as
/// 0.
std::vector<Colour> colours_from(const std::vector<Vec3>& values, bool whole);

/// Greys from intensities, whose units differ between scanners: black up to the 0.01-quantile of
/// the values, white from the 0.99-quantile.
std::vector<Colour> greys_from(const std::vector<double>& values);

}  // namespace dsc::cloud
