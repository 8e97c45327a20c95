// Reads a sweep file: its schema, and the points that its axes make.
#include "dsc/sweep/sweep.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>

#include <dsc/config/diagnostics.hpp>
#include <dsc/config/overrides.hpp>
#include <dsc/config/params.hpp>
#include <dsc/run/sha256.hpp>

#include "axes.hpp"

namespace dsc::sweep {
namespace {

using config::ConfigEntry;
using config::ConfigNode;
using config::Diagnostics;

/// A map from dotted paths to values. Its keys are keys of experiments, which no schema here lists.
struct Paths {};
void declare_paths(config::ParamSchema<Paths>&) {}

struct RandomAxis {
    std::uint64_t n = Draw{}.n;
    std::uint64_t seed = Draw{}.seed;
    Paths ranges;
};

/// Exactly one of the members is given.
struct SweepAxis {
    std::optional<Paths> grid;
    std::optional<Paths> zip;
    std::vector<Paths> list;
    std::optional<RandomAxis> random;
};

struct SweepFile {
    std::uint32_t format = 1;  ///< key `sweep`
    std::string base;
    std::optional<std::string> truth;
    std::optional<Paths> set;
    std::vector<SweepAxis> axes;
    std::vector<int> seeds;
    std::optional<std::uint32_t> repeat;
};

void declare_random(config::ParamSchema<RandomAxis>& s) {
    s.integer("n", &RandomAxis::n)
        .range(1, most_sweep_points, "points")
        .doc("Number of draws. A larger number only adds points.");
    s.integer("seed", &RandomAxis::seed)
        .at_least(0, "dimensionless")
        .doc("Seed of the draws, not of the experiments.");
    s.object("ranges", &RandomAxis::ranges, declare_paths)
        .doc("Dotted path to {from, to, scale: linear or log, integer}.");
}

void declare_axis(config::ParamSchema<SweepAxis>& s) {
    s.object("grid", &SweepAxis::grid, declare_paths)
        .doc("Dotted path to a list of values or {from, to, count, scale, integer}: every "
             "combination.");
    s.object("zip", &SweepAxis::zip, declare_paths)
        .doc("Dotted path to a list of values: the i-th values of all lists together.");
    s.list("list", &SweepAxis::list, declare_paths)
        .doc("Maps of dotted paths to values, point by point.");
    s.object("random", &SweepAxis::random, declare_random).doc("Values drawn out of ranges.");
    s.check(
        [](const SweepAxis& p) {
            return int(p.grid.has_value()) + int(p.zip.has_value()) + int(!p.list.empty()) +
                       int(p.random.has_value()) ==
                   1;
        },
        "an axis is exactly one of 'grid', 'zip', 'list' and 'random'");
}

void declare_sweep(config::ParamSchema<SweepFile>& s) {
    s.integer("sweep", &SweepFile::format)
        .range(1, 1, "dimensionless")
        .required()
        .doc("Version of the format: 1.");
    s.file("base", &SweepFile::base)
        .required()
        .doc("The experiment on which all points are based.");
    s.file("truth", &SweepFile::truth)
        .doc("The true surface. The results of all points are compared with it. An axis may have "
             "the key 'truth' instead, for example in a zip with input.cloud.file.");
    s.object("set", &SweepFile::set, declare_paths)
        .doc("Dotted path to value: overrides of all points.");
    s.list("axes", &SweepFile::axes, declare_axis)
        .doc("The varied values. The points are all combinations of the axes.");
    s.integers("seeds", &SweepFile::seeds)
        .at_least(0)
        .doc("Repeats every point with each of these seeds.");
    s.integer("repeat", &SweepFile::repeat)
        .range(1, most_sweep_points, "dimensionless")
        .doc("Number of repetitions of every point, with the seeds 1, 2, ...");
    s.check([](const SweepFile& p) { return p.seeds.empty() || !p.repeat; },
            "'seeds' and 'repeat' must not both be given");
    s.check([](const SweepFile& p) { return !p.axes.empty() || !p.seeds.empty() || p.repeat; },
            "a sweep needs 'axes', 'seeds' or 'repeat'");
}

// ---- the schema sees maps of dotted paths as empty maps -----------------------------------------

ConfigNode blank(const ConfigNode& node) {
    return node.is_map() ? ConfigNode::map().placed(node.position()) : node;
}

ConfigNode blank_items(const ConfigNode& list) {
    ConfigNode out = list;
    for (std::size_t i = 0; list.is_list() && i < list.size(); ++i)
        out = out.with_item(i, blank(list.items()[i]));
    return out;
}

/// A copy of a map in which the value at `key`, if there is one, is replaced by `change` of it.
template <class Change>
ConfigNode changed(const ConfigNode& map, const char* key, Change change) {
    const ConfigEntry* entry = map.find_entry(key);
    return entry == nullptr ? map : map.with(key, change(entry->value), entry->position);
}

ConfigNode blank_axis(const ConfigNode& axis) {
    ConfigNode out = changed(axis, "grid", blank);
    out = changed(out, "zip", blank);
    out = changed(out, "list", blank_items);
    return changed(out, "random",
                   [](const ConfigNode& random) { return changed(random, "ranges", blank); });
}

ConfigNode without_paths(const ConfigNode& root) {
    return changed(changed(root, "set", blank), "axes", [](const ConfigNode& axes) {
        ConfigNode out = axes;
        for (std::size_t i = 0; axes.is_list() && i < axes.size(); ++i)
            out = out.with_item(i, blank_axis(axes.items()[i]));
        return out;
    });
}

// ---- points -------------------------------------------------------------------------------------

Alternatives read_axis(const ConfigNode& node, const SweepAxis& axis, Diagnostics& diagnostics) {
    if (axis.grid) return grid_axis(node.at("grid"), diagnostics);
    if (axis.zip) return zip_axis(node.at("zip"), diagnostics);
    if (!axis.list.empty()) return list_axis(node.at("list"), diagnostics);
    const ConfigNode& random = node.at("random");
    const ConfigNode* ranges = random.find("ranges");
    return random_axis(ranges != nullptr ? *ranges : ConfigNode::map().placed(random.position()),
                       {axis.random->n, axis.random->seed}, diagnostics);
}

Alternatives seed_axis(const ConfigNode& root, const SweepFile& file) {
    Alternatives all;
    const auto add = [&](std::int64_t seed, const ConfigNode& place) {
        all.push_back(
            {ConfigEntry("seed", ConfigNode(seed).placed(place.position()), place.position())});
    };
    for (std::size_t i = 0; i < file.seeds.size(); ++i) add(file.seeds[i], root.at("seeds").at(i));
    for (std::uint32_t i = 1; i <= file.repeat.value_or(0); ++i) add(i, root.at("repeat"));
    return all;
}

/// A later override that covers an earlier one would silently undo it.
class Order {
public:
    explicit Order(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

    /// All paths of one axis, after those of the axes before it.
    void add(const Alternatives& axis) {
        std::set<std::string> own;
        for (const Overrides& overrides : axis) {
            std::set<std::string> before = earlier_;
            for (const ConfigEntry& entry : overrides) {
                if (own.insert(entry.key).second) require_free(entry, before);
                before.insert(entry.key);
            }
        }
        earlier_.insert(own.begin(), own.end());
    }

private:
    void require_free(const ConfigEntry& entry, const std::set<std::string>& before) {
        for (const std::string& path : before) {
            if (path != entry.key && path.rfind(entry.key + ".", 0) != 0) continue;
            const bool same = path == entry.key;
            diagnostics_.error(
                "config.sweep_order", entry.position,
                same ? "'" + path + "' is already set by an earlier axis"
                     : "'" + entry.key + "' would undo '" + path + "', which is set before it",
                same ? "name a key in one axis only" : "set the whole before its part");
        }
    }

    Diagnostics& diagnostics_;
    std::set<std::string> earlier_;
};

/// The truth of a point: a value of an axis, relative to the file that names it, or the truth of
/// all points.
ConfigEntry truth_of(const Overrides& overrides, const ConfigEntry& of_all,
                     Diagnostics& diagnostics) {
    const auto own = std::find_if(overrides.begin(), overrides.end(),
                                  [](const ConfigEntry& entry) { return entry.key == truth_key; });
    if (own == overrides.end()) return of_all;
    const config::SourcePosition& place = own->value.position();
    if (!own->value.is_string()) {
        diagnostics.error("config.wrong_type", place.known() ? place : own->position,
                          "'truth' must be the name of a file", "write the path of a surface");
        return of_all;
    }
    namespace fs = std::filesystem;
    const fs::path folder =
        place.known() ? fs::absolute(place.source->name).parent_path() : fs::current_path();
    const std::string file = (folder / own->value.as_string()).lexically_normal().string();
    return ConfigEntry(truth_key, ConfigNode(file).placed(place), own->position);
}

/// 1, 1.0 and 1e0 are the same value.
ConfigNode canonical(const ConfigNode& node) {
    if (node.is_number()) return ConfigNode(node.as_real());
    if (node.is_list()) {
        std::vector<ConfigNode> items;
        for (const ConfigNode& item : node.items()) items.push_back(canonical(item));
        return ConfigNode::list(std::move(items));
    }
    if (!node.is_map()) return node;
    std::vector<ConfigEntry> entries;
    for (const ConfigEntry& entry : node.entries())
        entries.emplace_back(entry.key, canonical(entry.value));
    std::sort(entries.begin(), entries.end(),
              [](const auto& a, const auto& b) { return a.key < b.key; });
    return ConfigNode::map(std::move(entries));
}

SweepPoint point_of(const Overrides& overrides, ConfigEntry truth) {
    SweepPoint point;
    point.truth = std::move(truth);
    point.overrides = ConfigNode::map(overrides);
    point.name = run::sha256(config::flow_text(canonical(point.overrides))).substr(0, 12);
    return point;
}

}  // namespace

std::shared_ptr<const config::Schema> sweep_schema() {
    static const std::shared_ptr<const config::Schema> schema = [] {
        config::ParamSchema<SweepFile> s;
        declare_sweep(s);
        return s.shared_schema();
    }();
    return schema;
}

Sweep load_sweep(const std::string& file, const config::YamlOptions& options) {
    const ConfigNode root = config::load_yaml(file, options);
    Diagnostics diagnostics;
    const ConfigNode resolved = config::validate(without_paths(root), *sweep_schema(),
                                                 config::NoStrategies(), diagnostics, "the sweep");
    diagnostics.throw_if_errors();
    config::ParamSchema<SweepFile> reader;
    declare_sweep(reader);
    const SweepFile given = reader.read(resolved);

    Sweep sweep;
    sweep.base = given.base;
    Order order(diagnostics);
    ConfigEntry truth(truth_key, ConfigNode());
    if (given.truth) {
        const ConfigEntry& entry = *root.find_entry("truth");
        truth = ConfigEntry(truth_key, ConfigNode(*given.truth).placed(entry.value.position()),
                            entry.position);
        order.add({{truth}});
    }
    if (given.set) {
        sweep.set = root.at("set");
        order.add({sweep.set.entries()});
    }
    std::vector<Alternatives> axes;
    for (std::size_t i = 0; i < given.axes.size(); ++i)
        axes.push_back(read_axis(root.at("axes").at(i), given.axes[i], diagnostics));
    if (!given.seeds.empty() || given.repeat) axes.push_back(seed_axis(root, given));
    for (const Alternatives& axis : axes) order.add(axis);
    const Alternatives all = product(axes, most_sweep_points, root.position(), diagnostics);
    diagnostics.throw_if_errors();

    std::set<std::string> names;
    for (const Overrides& overrides : all) {
        SweepPoint point = point_of(overrides, truth_of(overrides, truth, diagnostics));
        if (names.insert(point.name).second) {
            sweep.points.push_back(std::move(point));
        } else {
            ++sweep.repeated;
        }
    }
    diagnostics.throw_if_errors();
    return sweep;
}

}  // namespace dsc::sweep
