// Reads the axes of a sweep.
#include "axes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <dsc/base/random.hpp>
#include <dsc/config/params.hpp>
#include <dsc/config/schema.hpp>
#include <dsc/sweep/sweep.hpp>
#include <dsc/text/numbers.hpp>

namespace dsc::sweep {
namespace {

using config::ConfigEntry;
using config::ConfigNode;
using config::Diagnostics;

enum class Scale { linear, log };

/// A range of values. `count` is for a grid, which spaces the values evenly.
struct Range {
    double from = 0.0;
    double to = 1.0;
    Scale scale = Scale::linear;
    bool integer = false;
    std::uint32_t count = 2;

    double at(double part) const {
        if (scale == Scale::log)
            return std::exp(std::log(from) + part * (std::log(to) - std::log(from)));
        return from + part * (to - from);
    }
};

void declare_range(config::ParamSchema<Range>& s, bool counted) {
    s.real("from", &Range::from).required().doc("The least value.");
    s.real("to", &Range::to).required().doc("The greatest value.");
    s.choice("scale", &Range::scale, {{"linear", Scale::linear}, {"log", Scale::log}})
        .doc("Whether the values or their logarithms are spread evenly.");
    s.boolean("integer", &Range::integer).doc("Whether to round to integers.");
    if (counted)
        s.integer("count", &Range::count)
            .range(2, most_sweep_points, "dimensionless")
            .required()
            .doc("Number of values.");
    s.check([](const Range& p) { return p.from < p.to; }, "'to' must be above 'from'");
    s.check([](const Range& p) { return p.scale == Scale::linear || p.from > 0; },
            "'from' must be above 0 on a logarithmic scale");
}

/// The range, or nothing if it is faulty.
std::optional<Range> read_range(const ConfigEntry& entry, bool counted, Diagnostics& diagnostics) {
    config::ParamSchema<Range> schema;
    declare_range(schema, counted);
    const std::size_t before = diagnostics.error_count();
    const ConfigNode resolved =
        config::validate(entry.value, schema.schema(), config::NoStrategies(), diagnostics,
                         "the range of '" + entry.key + "'");
    if (diagnostics.error_count() > before) return std::nullopt;
    return schema.read(resolved);
}

/// Twelve digits, so that 0.0010000000000000002 becomes 0.001.
double rounded(double value) {
    text::parse_number(text::rounded(value, 12), value);
    return value;
}

/// A value of a range for the override, at the place of the range.
ConfigNode value_of(const Range& range, double value, const ConfigNode& place) {
    value = std::clamp(rounded(value), range.from, range.to);
    const ConfigNode node = range.integer
                                ? ConfigNode(static_cast<std::int64_t>(std::llround(value)))
                                : ConfigNode(value);
    return node.placed(place.position());
}

std::vector<ConfigNode> spaced(const Range& range, const ConfigNode& place) {
    std::vector<ConfigNode> values;
    for (std::uint32_t i = 0; i < range.count; ++i) {
        values.push_back(value_of(range, range.at(double(i) / (range.count - 1)), place));
    }
    return values;
}

/// The values in the list of a grid or zip entry.
std::vector<ConfigNode> listed(const ConfigEntry& entry, bool ranges, Diagnostics& diagnostics) {
    const ConfigNode& value = entry.value;
    if (ranges && value.is_map()) {
        const auto range = read_range(entry, true, diagnostics);
        return range ? spaced(*range, value) : std::vector<ConfigNode>{};
    }
    if (!value.is_list()) {
        diagnostics.error("config.wrong_type",
                          value.position().known() ? value.position() : entry.position,
                          "the values of '" + entry.key + "' must be a list",
                          ranges ? "write [...] or {from: A, to: B, count: N}" : "write [...]");
        return {};
    }
    if (value.size() == 0) {
        diagnostics.error("config.list_size", value.position(), "'" + entry.key + "' has no values",
                          "write at least one");
    }
    return value.items();
}

/// An empty map is an error.
bool require_entries(const ConfigNode& map, const char* what, Diagnostics& diagnostics) {
    if (map.size() > 0) return true;
    diagnostics.error("config.missing", map.position(), std::string(what) + " names no key",
                      "write path.to.key: VALUES");
    return false;
}

}  // namespace

Alternatives product(const std::vector<Alternatives>& axes, std::size_t most,
                     const config::SourcePosition& place, Diagnostics& diagnostics) {
    std::size_t count = 1;
    for (const Alternatives& axis : axes) {
        count *= axis.size();
        if (count > most) {
            diagnostics.error("config.sweep_size", place,
                              "more than " + std::to_string(most) + " combinations",
                              "use fewer values, or select some of the combinations with random");
            return {};
        }
    }
    Alternatives all(1);
    for (const Alternatives& axis : axes) {
        Alternatives longer;
        for (const Overrides& start : all) {
            for (const Overrides& next : axis) {
                longer.push_back(start);
                longer.back().insert(longer.back().end(), next.begin(), next.end());
            }
        }
        all = std::move(longer);
    }
    return all;
}

Alternatives grid_axis(const ConfigNode& map, Diagnostics& diagnostics) {
    if (!require_entries(map, "grid", diagnostics)) return {};
    std::vector<Alternatives> keys;
    for (const ConfigEntry& entry : map.entries()) {
        Alternatives key;
        for (const ConfigNode& value : listed(entry, true, diagnostics))
            key.push_back({ConfigEntry(entry.key, value, entry.position)});
        keys.push_back(std::move(key));
    }
    return product(keys, most_sweep_points, map.position(), diagnostics);
}

Alternatives zip_axis(const ConfigNode& map, Diagnostics& diagnostics) {
    if (!require_entries(map, "zip", diagnostics)) return {};
    Alternatives all;
    const ConfigEntry& first = map.entries().front();
    for (const ConfigEntry& entry : map.entries()) {
        const std::vector<ConfigNode> values = listed(entry, false, diagnostics);
        if (&entry == &first) all.resize(values.size());
        if (values.empty()) continue;  // already reported
        if (!all.empty() && values.size() != all.size()) {
            diagnostics.error("config.list_size", entry.value.position(),
                              "'" + entry.key + "' has " + std::to_string(values.size()) +
                                  " values and '" + first.key + "' has " +
                                  std::to_string(all.size()),
                              "all lists of a zip must have the same length");
            continue;
        }
        for (std::size_t i = 0; i < all.size(); ++i)
            all[i].emplace_back(entry.key, values[i], entry.position);
    }
    return all;
}

Alternatives list_axis(const ConfigNode& list, Diagnostics& diagnostics) {
    Alternatives all;
    for (const ConfigNode& item : list.items()) {
        if (require_entries(item, "a point of list", diagnostics)) all.push_back(item.entries());
    }
    return all;
}

Alternatives random_axis(const ConfigNode& ranges, const Draw& draw, Diagnostics& diagnostics) {
    if (!require_entries(ranges, "ranges", diagnostics)) return {};
    Alternatives all(draw.n);
    for (const ConfigEntry& entry : ranges.entries()) {
        const auto range = read_range(entry, false, diagnostics);
        if (!range) continue;
        // Integers: both ends get the range of a whole integer.
        Range wide = *range;
        if (range->integer && range->scale == Scale::linear) wide.from -= 0.5, wide.to += 0.5;
        for (std::size_t i = 0; i < all.size(); ++i) {
            RandomStream random({draw.seed, stream_id(entry.key), 0, i});
            all[i].emplace_back(entry.key, value_of(*range, wide.at(random.uniform()), entry.value),
                                entry.position);
        }
    }
    return all;
}

}  // namespace dsc::sweep
