#pragma once
// What files give besides positions: which of their columns are normals or colours, and how these become ours.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <dsc/cloud/cloud.hpp>
#include <dsc/cloud/read.hpp>

namespace dsc::cloud {

/// The columns, fields or properties of a file that are read besides the position, by their places among all. Of colours, those
/// that stand first here count.
struct AttributeColumns {
    std::optional<std::array<std::size_t, 3>> normals;
    std::optional<std::array<std::size_t, 3>> colours;  ///< red, green, blue
    std::optional<std::size_t> packed;                  ///< 0x00rrggbb as PCL writes it
    std::optional<std::size_t> intensity;
};

/// Finds them by their names, in any case: nx ny nz or normal_x normal_y normal_z; red green blue, r g b or
/// diffuse_red diffuse_green diffuse_blue; rgb or rgba; intensity, also with `scalar_` before it as CloudCompare writes it.
AttributeColumns attribute_columns(std::span<const std::string> names);

/// The names with what each is used for, given what was read in the end.
std::vector<FoundProperty> found_properties(std::span<const std::string> names, const Cloud& cloud);

/// The unit vector along a normal of a file, with every bit of one that is a unit vector; zero for one without a direction.
Vec3 direction_of(const Vec3& normal);

/// Whether three numbers of a text look like a unit vector with the digits that programs write.
bool looks_like_unit(const Vec3& values);

/// Empties normals of which none has a direction, or which are not one per point.
void keep_whole_normals(Cloud& cloud);

/// Colours from numbers: fractions of 1 where no number is larger, bytes up to 255, else 16 bits. `whole`: the numbers are of
/// an integer type, so that 1 is a dark byte. NaN and what is negative count as 0.
std::vector<Colour> colours_from(const std::vector<Vec3>& values, bool whole);

/// Greys from intensities, whose units differ from scanner to scanner: black up to the value that a hundredth of the points
/// are below, white from the one that a hundredth are above.
std::vector<Colour> greys_from(const std::vector<double>& values);

}  // namespace dsc::cloud
