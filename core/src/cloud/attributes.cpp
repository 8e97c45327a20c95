// Normals, colours and greys from the columns of a file.
#include "attributes.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include <dsc/decode/obj.hpp>
#include <dsc/text/words.hpp>

namespace dsc::cloud {

namespace {

constexpr double unit_squared_tolerance = 1e-6;
constexpr double written_unit_tolerance = 0.01;  // of the length; programs write at least two
                                                 // digits
constexpr double intensity_tail = 0.01;

std::optional<std::size_t> place_of(const std::vector<std::string>& names, std::string_view name) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) return std::nullopt;
    return static_cast<std::size_t>(found - names.begin());
}

using Triple = std::array<std::string_view, 3>;

std::optional<std::array<std::size_t, 3>> first_triple(const std::vector<std::string>& names,
                                                       std::initializer_list<Triple> wanted) {
    for (const Triple& triple : wanted) {
        std::array<std::size_t, 3> places{};
        std::size_t found = 0;
        for (std::size_t k = 0; k < 3; ++k)
            if (const auto place = place_of(names, triple[k])) {
                places[k] = *place;
                ++found;
            }
        if (found == 3) return places;
    }
    return std::nullopt;
}

std::optional<std::size_t> first_name(const std::vector<std::string>& names,
                                      std::initializer_list<std::string_view> wanted) {
    for (const std::string_view name : wanted)
        if (const auto place = place_of(names, name)) return place;
    return std::nullopt;
}

std::vector<std::string> all_in_lower_case(std::span<const std::string> names) {
    std::vector<std::string> out;
    for (const std::string& name : names) out.push_back(text::lower_case(name));
    return out;
}

/// The value with this rank from the smallest, counted from 0.
double ranked(std::vector<double> values, std::size_t rank) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rank),
                     values.end());
    return values[rank];
}

}  // namespace

AttributeColumns attribute_columns(std::span<const std::string> given) {
    const std::vector<std::string> names = all_in_lower_case(given);
    AttributeColumns out;
    out.normals = first_triple(names, {{"nx", "ny", "nz"}, {"normal_x", "normal_y", "normal_z"}});
    out.colours = first_triple(names, {{"red", "green", "blue"},
                                       {"r", "g", "b"},
                                       {"diffuse_red", "diffuse_green", "diffuse_blue"}});
    if (!out.colours) out.packed = first_name(names, {"rgb", "rgba"});
    if (!out.colours && !out.packed)
        out.intensity = first_name(names, {"intensity", "scalar_intensity"});
    return out;
}

std::vector<FoundProperty> found_properties(std::span<const std::string> names,
                                            const Cloud& cloud) {
    std::vector<FoundProperty> out;
    for (const std::string& name : names) out.push_back({name, ""});
    const std::vector<std::string> lower = all_in_lower_case(names);
    for (const std::string_view axis : {"x", "y", "z"})
        if (const auto place = place_of(lower, axis)) out[*place].use = "position";
    const AttributeColumns columns = attribute_columns(names);
    if (columns.normals && !cloud.normals.empty())
        for (const std::size_t k : *columns.normals) out[k].use = "normal";
    if (cloud.colours.empty()) return out;
    if (columns.colours)
        for (const std::size_t k : *columns.colours) out[k].use = "colour";
    if (columns.packed) out[*columns.packed].use = "colour";
    if (columns.intensity) out[*columns.intensity].use = "colour (grey)";
    return out;
}

Vec3 direction_of(const Vec3& normal) {
    if (!normal.allFinite()) return Vec3::Zero();
    if (std::abs(normal.squaredNorm() - 1.0) < unit_squared_tolerance) return normal;
    // first, so that squares neither underflow nor overflow
    const double largest = normal.cwiseAbs().maxCoeff();
    return largest > 0.0 ? Vec3((normal / largest).normalized()) : Vec3(Vec3::Zero());
}

bool looks_like_unit(const Vec3& values) {
    return std::abs(values.norm() - 1.0) < written_unit_tolerance;
}

void keep_whole_normals(Cloud& cloud) {
    const bool none = std::all_of(cloud.normals.begin(), cloud.normals.end(),
                                  [](const Vec3& n) { return n.isZero(0.0); });
    if (none || cloud.normals.size() != cloud.points.size()) cloud.normals.clear();
}

std::vector<Colour> colours_from(const std::vector<Vec3>& values, bool whole) {
    std::vector<Vec3> sound(values);
    double largest = 0.0;
    for (Vec3& value : sound) {
        for (int k = 0; k < 3; ++k)
            value[k] = std::isfinite(value[k]) ? std::max(value[k], 0.0) : 0.0;
        largest = std::max(largest, value.maxCoeff());
    }
    return decode::colour_bytes(sound, !whole && largest <= 1.0 ? 1.0
                                       : largest > 255.0        ? 65535.0
                                                                : 255.0);
}

std::vector<Colour> greys_from(const std::vector<double>& values) {
    std::vector<double> finite;
    for (const double value : values)
        if (std::isfinite(value)) finite.push_back(value);
    if (finite.empty()) return {};
    const auto tail = static_cast<std::size_t>(intensity_tail * static_cast<double>(finite.size()));
    const double low = ranked(finite, tail), high = ranked(finite, finite.size() - 1 - tail);
    std::vector<Colour> out;
    out.reserve(values.size());
    for (const double value : values) {
        const double share = high > low && std::isfinite(value)
                                 ? std::clamp((value - low) / (high - low), 0.0, 1.0)
                                 : 0.0;
        const auto grey = static_cast<std::uint8_t>(std::lround(255.0 * share));
        out.push_back({grey, grey, grey});
    }
    return out;
}

}  // namespace dsc::cloud
