// Packs attributes of surfaces for the viewer.
#include "attributes.hpp"

#include <algorithm>
#include <cmath>

#include <dsc/cloud/search.hpp>
#include <dsc/hooks/attributes.hpp>
#include <dsc/io/picture.hpp>

#include "html.hpp"

namespace dsc::report {
namespace {

using nlohmann::ordered_json;

/// For each drawn point the nearest point of the source; the same point if nothing was thinned.
std::vector<std::uint32_t> nearest_points(const std::vector<Vec3>& source,
                                          const std::vector<Vec3>& drawn, Workers* workers) {
    std::vector<std::uint32_t> nearest(drawn.size());
    if (source == drawn) {
        for (std::size_t i = 0; i < nearest.size(); ++i) nearest[i] = static_cast<std::uint32_t>(i);
        return nearest;
    }
    const cloud::NearestSearch search(source);
    for_blocks(workers, drawn.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) nearest[i] = search.nearest(drawn[i]).index;
    });
    return nearest;
}

}  // namespace

std::vector<io::DataArray> attributes_among(std::vector<io::DataArray> arrays) {
    std::vector<io::DataArray> kept;
    for (io::DataArray& array : arrays) {
        const auto named = [&](const io::DataArray& other) { return other.name == array.name; };
        if (!hooks::may_name_attribute(array.name) || std::any_of(kept.begin(), kept.end(), named))
            continue;
        if (std::any_of(array.values.begin(), array.values.end(),
                        [](double v) { return std::isfinite(v); }))
            kept.push_back(std::move(array));
    }
    return kept;
}

AttributeSource with_values(const AttributeSource& source) {
    AttributeSource kept;
    for (const io::DataArray& array : source.arrays) kept.arrays.push_back({array.name, {}});
    for (std::size_t i = 0; i < source.points.size(); ++i) {
        const auto has_value = [&](const io::DataArray& array) {
            return std::isfinite(array.values[i]);
        };
        if (std::none_of(source.arrays.begin(), source.arrays.end(), has_value)) continue;
        kept.points.push_back(source.points[i]);
        for (std::size_t k = 0; k < kept.arrays.size(); ++k)
            kept.arrays[k].values.push_back(source.arrays[k].values[i]);
    }
    return kept;
}

ordered_json pack_attributes(const AttributeSource& source, const std::vector<Vec3>& drawn,
                             Workers* workers) {
    ordered_json packed = ordered_json::array();
    if (source.arrays.empty() || source.points.empty()) return packed;
    const std::vector<std::uint32_t> nearest = nearest_points(source.points, drawn, workers);
    for (const io::DataArray& array : source.arrays) {
        const io::ColourBounds bounds = io::colour_bounds(array.values);
        std::string levels;
        levels.reserve(nearest.size());
        for (const std::uint32_t i : nearest) {
            const double value = array.values[i];
            const long level = std::isfinite(value)
                                   ? std::lround((no_level - 1) * io::colour_part(value, bounds))
                                   : no_level;
            levels += static_cast<char>(static_cast<unsigned char>(level));
        }
        packed.push_back({{"name", array.name},
                          {"low", bounds.low},
                          {"high", bounds.high},
                          {"data", html::base64(levels)}});
    }
    return packed;
}

}  // namespace dsc::report
