#include "parameters.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include <dsc/base/random.hpp>
#include <dsc/config/yaml.hpp>

namespace dsc::conformance {
namespace {

using config::Bound;
using config::ConfigNode;
using config::Field;
using config::FieldType;

std::string text(const ConfigNode& value) {
    std::string yaml = config::to_yaml(ConfigNode::map({{"v", value}}));
    yaml.erase(0, 2);
    std::replace(yaml.begin(), yaml.end(), '\n', ' ');
    return yaml;
}

Variation vary(const ConfigNode& base, const Field& field, const ConfigNode& value,
               const std::string& what) {
    return {field.name + " =" + text(value) + "(" + what + ")", base.with(field.name, value)};
}

bool is_number(const Field& field) {
    return field.type == FieldType::integer || field.type == FieldType::real;
}

// The last value inside a bound; for an open bound the next double or integer inside.
double inside(const Field& field, const Bound& bound, bool lower) {
    if (!bound.open) return bound.value;
    if (field.type == FieldType::integer) return lower ? bound.value + 1 : bound.value - 1;
    const double step = std::max(std::abs(bound.value), 1.0) * 1e-9;
    return lower ? bound.value + step : bound.value - step;
}

double outside(const Field& field, const Bound& bound, bool lower) {
    if (bound.open) return bound.value;
    const double step =
        field.type == FieldType::integer ? 1.0 : std::max(std::abs(bound.value), 1.0) * 1e-3;
    return lower ? bound.value - step : bound.value + step;
}

ConfigNode number(const Field& field, double value) {
    if (field.type == FieldType::integer) return ConfigNode(static_cast<std::int64_t>(value));
    return ConfigNode(value);
}

double base_value(const Field& field, const ConfigNode& base) {
    const ConfigNode* node = base.find(field.name);
    return node != nullptr && node->is_number() ? node->as_real() : 0.0;
}

void add_number(const Field& field, const ConfigNode& base, std::vector<Variation>& out) {
    if (field.minimum)
        out.push_back(
            vary(base, field, number(field, inside(field, *field.minimum, true)), "least"));
    if (field.maximum && !field.has_tag("costly"))
        out.push_back(
            vary(base, field, number(field, inside(field, *field.maximum, false)), "greatest"));
}

// If a range has only one end, values up to ten times the usual one; powers of two if the ends are
// far apart.
double draw(const Field& field, double usual, RandomStream& random) {
    const double reach = 10.0 * std::max(std::abs(usual), 1e-3);
    const double low = field.minimum ? inside(field, *field.minimum, true) : -reach;
    double high = field.maximum ? inside(field, *field.maximum, false) : std::max(low, 0.0) + reach;
    if (field.has_tag("costly")) high = std::max(low, std::min(high, usual));
    if (low > 0 && high > 100 * low) return std::exp(random.uniform(std::log(low), std::log(high)));
    return random.uniform(low, high);
}

ConfigNode random_value(const Field& field, const ConfigNode& base, RandomStream& random) {
    const double usual = base_value(field, base);
    switch (field.type) {
        case FieldType::boolean: return ConfigNode(random.index(2) == 1);
        case FieldType::integer:
            return ConfigNode(static_cast<std::int64_t>(std::round(draw(field, usual, random))));
        case FieldType::real: return ConfigNode(draw(field, usual, random));
        case FieldType::choice:
            return ConfigNode(field.choices[random.index(field.choices.size())]);
        case FieldType::vec3:
            return ConfigNode::list(
                {draw(field, 1.0, random), draw(field, 1.0, random), draw(field, 1.0, random)});
        default: {
            const ConfigNode* node = base.find(field.name);
            return node != nullptr ? *node : ConfigNode();
        }
    }
}

ConfigNode other_type(const Field& field) {
    switch (field.type) {
        case FieldType::boolean:
        case FieldType::integer:
        case FieldType::real: return ConfigNode("a word");
        case FieldType::string:
        case FieldType::choice:
        case FieldType::file: return ConfigNode::list({1, 2});
        default: return ConfigNode(true);
    }
}

}  // namespace

std::vector<Variation> extremes(const config::Schema& schema, const ConfigNode& base) {
    std::vector<Variation> out;
    for (const Field& field : schema.fields()) {
        if (is_number(field)) add_number(field, base, out);
        if (field.type == FieldType::boolean) {
            for (const bool value : {false, true})
                out.push_back(vary(base, field, value, "a truth value"));
        }
        if (field.type == FieldType::choice) {
            for (const std::string& choice : field.choices)
                out.push_back(vary(base, field, choice, "a choice"));
        }
        if (field.optional) out.push_back(vary(base, field, ConfigNode(), "unset"));
    }
    return out;
}

Variation random_variation(const config::Schema& schema, const ConfigNode& base,
                           std::uint64_t seed) {
    RandomStream random(RandomKey{seed, stream_id("fuzz"), 0, 0});
    ConfigNode parameters = base;
    std::string name = fmt::format("seed {}:", seed);
    for (const Field& field : schema.fields()) {
        const bool unset = field.optional && random.index(4) == 0;
        const ConfigNode value = unset ? ConfigNode() : random_value(field, base, random);
        if (value.is_null() && !field.optional) continue;
        parameters = parameters.with(field.name, value);
        if (!value.is_map() && !value.is_list()) name += " " + field.name + ":" + text(value);
    }
    return {name, parameters};
}

std::vector<Variation> wrong(const config::Schema& schema, const ConfigNode& base) {
    std::vector<Variation> out;
    for (const Field& field : schema.fields()) {
        if (is_number(field)) {
            if (field.minimum)
                out.push_back(vary(base, field, number(field, outside(field, *field.minimum, true)),
                                   "below its range"));
            if (field.maximum)
                out.push_back(vary(base, field,
                                   number(field, outside(field, *field.maximum, false)),
                                   "above its range"));
        }
        if (field.type == FieldType::choice)
            out.push_back(vary(base, field, "no_such_choice", "not a choice"));
        out.push_back(vary(base, field, other_type(field), "another type"));
    }
    out.push_back({"a key that does not exist", base.with("no_such_parameter", 1)});
    return out;
}

}  // namespace dsc::conformance
