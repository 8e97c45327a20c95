#pragma once
// The axes of a sweep file: from their maps of dotted paths to lists of overrides.

#include <dsc/config/diagnostics.hpp>
#include <dsc/config/node.hpp>
#include <vector>

namespace dsc::run {

/// Overrides that belong together: dotted path, value and where the path is written.
using Overrides = std::vector<config::ConfigEntry>;

/// The alternatives of an axis, one of them in every point.
using Alternatives = std::vector<Overrides>;

/// How an axis draws.
struct Draw {
    std::uint64_t n = 10;
    std::uint64_t seed = 1;
};

/// Every combination; the last key changes fastest. A value list may be a map {from, to, count, scale}.
Alternatives grid_axis(const config::ConfigNode& map, config::Diagnostics& diagnostics);
/// The lists side by side, all of one length.
Alternatives zip_axis(const config::ConfigNode& map, config::Diagnostics& diagnostics);
/// Maps as they stand.
Alternatives list_axis(const config::ConfigNode& list, config::Diagnostics& diagnostics);
/// Values out of ranges. The i-th draw of a key depends on the seed, the key and i: a larger n only adds points.
Alternatives random_axis(const config::ConfigNode& ranges, const Draw& draw, config::Diagnostics& diagnostics);

/// Every combination of the axes, the last one fastest. More than `most` are a fault at `place`.
Alternatives product(const std::vector<Alternatives>& axes, std::size_t most, const config::SourcePosition& place,
                     config::Diagnostics& diagnostics);

}  // namespace dsc::run
