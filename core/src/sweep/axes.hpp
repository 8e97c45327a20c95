#pragma once
// The axes of a sweep file: turns their maps of dotted paths into lists of overrides.

#include <vector>

#include <dsc/config/diagnostics.hpp>
#include <dsc/config/node.hpp>

namespace dsc::sweep {

/// Overrides that belong together: dotted path, value and where the path is written.
using Overrides = std::vector<config::ConfigEntry>;

/// The alternatives of an axis; every point uses one of them.
using Alternatives = std::vector<Overrides>;

/// Parameters of random draws.
struct Draw {
    std::uint64_t n = 10;
    std::uint64_t seed = 1;
};

/// All combinations; the last key changes fastest. A list of values may be a map {from, to, count,
/// scale}.
Alternatives grid_axis(const config::ConfigNode& map, config::Diagnostics& diagnostics);
/// The i-th values of all lists together; all lists have the same length.
Alternatives zip_axis(const config::ConfigNode& map, config::Diagnostics& diagnostics);
/// The maps without changes.
Alternatives list_axis(const config::ConfigNode& list, config::Diagnostics& diagnostics);
/// Random values from ranges. The i-th draw of a key depends on the seed, the key and i, so a
/// larger n only adds points.
Alternatives random_axis(const config::ConfigNode& ranges, const Draw& draw,
                         config::Diagnostics& diagnostics);

/// All combinations of the axes; the last axis changes fastest. More than `most` combinations are a
/// fault at `place`.
Alternatives product(const std::vector<Alternatives>& axes, std::size_t most,
                     const config::SourcePosition& place, config::Diagnostics& diagnostics);

}  // namespace dsc::sweep
