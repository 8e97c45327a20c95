// schema.*: the declaration of the parameters.
#include <algorithm>
#include <array>

#include <dsc/base/error.hpp>
#include <dsc/config/spelling.hpp>
#include <dsc/config/yaml.hpp>
#include <dsc/text/words.hpp>

#include "test_table.hpp"

namespace dsc::conformance {
namespace {

using config::ConfigNode;
using config::Field;
using config::FieldType;

// The words of units; / or ^ joins them.
constexpr std::array unit_words = {
    "dimensionless",
    "1",
    "length",
    "curvature",
    "time",
    "radians",
    "degrees",
    "target lengths (L)",
    "current mean edges",
    "steps",
    "seconds",
    "vertices",
    "faces",
    "tets",
    "points",
    "diagonals",
    "radius",
    "cells",
    "finest cells",
    "directions",
    "levels",
    "point distances",
    "neighbour distances",
    "2",
    "3",
    "threads",
    "rounds",
    "spacings",
    "budgets",
    "sweeps",
};

std::string known_units() {
    std::string all;
    for (const std::string_view word : unit_words) {
        const bool exponent = word.size() == 1 && word != "1";
        if (!exponent) (all += all.empty() ? "" : ", ") += word;
    }
    return all;
}

bool is_unit(const std::string& unit) {
    std::string word;
    const auto known = [&word] {
        return std::find(unit_words.begin(), unit_words.end(), word) != unit_words.end();
    };
    // "length/time, radians/time or 1/time": alternatives where it depends on another parameter.
    std::string all = unit;
    for (std::size_t at; (at = all.find(" or ")) != std::string::npos;) all.replace(at, 4, "/");
    for (std::size_t at; (at = all.find(", ")) != std::string::npos;) all.replace(at, 2, "/");
    for (const char c : all) {
        if (c != '/' && c != '^') {
            word += c;
            continue;
        }
        if (!known()) return false;
        word.clear();
    }
    return known();
}

void lint_field(const Field& field, std::vector<std::string>& problems) {
    const std::string subject = "parameter '" + field.name + "' ";
    if (!text::is_snake_case(field.name))
        problems.push_back(subject + "is not named in snake_case");
    if (field.doc.empty() || field.doc.back() != '.')
        problems.push_back(subject + "has a doc that is not a sentence");
    if (!field.unit.empty() && !is_unit(field.unit))
        problems.push_back(subject + "has the unknown unit '" + field.unit +
                           "'; known are the words " + known_units() +
                           ", and their quotients and powers, such as length/time or 1/length^2");
    const bool number = field.type == FieldType::real || field.type == FieldType::real_list ||
                        field.type == FieldType::vec3;
    if (number && field.unit.empty())
        problems.push_back(subject + "is a real number without a unit (\"1\" for a pure number)");
    if (!field.object) return;
    for (const Field& inner : field.object->fields()) lint_field(inner, problems);
}

void lint(const Subject& subject) {
    std::vector<std::string> problems = subject.schema().problems(true);
    for (const Field& field : subject.schema().fields()) lint_field(field, problems);
    require(problems.empty(), config::join(problems, "; "));
}

// Defaults are accepted; written as YAML and read back, they are the same.
void parameters_roundtrip(const Subject& subject) {
    for (const Field& field : subject.schema().fields()) {
        if (field.required) {
            subject.defaults();  // from the notes, or a skip
            break;
        }
    }
    ConfigNode resolved;
    try {
        const bool needs_notes =
            std::any_of(subject.schema().fields().begin(), subject.schema().fields().end(),
                        [](const Field& field) { return field.required; });
        resolved = needs_notes ? subject.defaults() : subject.resolve(ConfigNode::map());
    } catch (const StrategyError& error) {
        throw Failed(std::string("its defaults cannot be validated: ") + error.what());
    } catch (const Failed& failed) {
        throw Failed(std::string("its own defaults are refused: ") + failed.what());
    }
    const ConfigNode again =
        subject.resolve(config::parse_yaml(config::to_yaml(resolved), "defaults"));
    require(again == resolved,
            "the defaults change when they are written and read back:\n" + config::to_yaml(again));
    for (const Field& field : subject.schema().fields()) {
        std::vector<std::string> choices = field.choices;
        std::sort(choices.begin(), choices.end());
        require(std::adjacent_find(choices.begin(), choices.end()) == choices.end(),
                "parameter '" + field.name + "' has a choice twice");
    }
}

// The schema decides clearly what is accepted: a bound is inside or outside, and validation throws
// nothing else.
void reject(const Subject& subject) {
    const ConfigNode& base = subject.defaults();
    for (const Variation& v : wrong(subject.schema(), base)) {
        bool refused = false;
        try {
            subject.resolve(v.parameters);
        } catch (const Failed&) {
            refused = true;
        }
        require(refused, "accepted " + v.name);
    }
    for (const Variation& v : extremes(subject.schema(), base)) {
        try {
            subject.resolve(v.parameters);
        } catch (const Failed&) {
            continue;  // a condition may refuse it
        } catch (const std::exception& error) {
            throw Failed("validation of " + v.name + " throws: " + error.what());
        }
    }
}

}  // namespace

void add_schema_tests(std::vector<Test>& table) {
    add(table,
        {"schema.lint", Level::smoke, false,
         "Parameters have names in snake_case and docs that are sentences, and numbers have known "
         "units."},
        lint);
    add(table,
        {"schema.roundtrip", Level::smoke, false,
         "The defaults are accepted, and stay the same when they are written as YAML and read "
         "back."},
        parameters_roundtrip);
    add(table,
        {"schema.reject", Level::standard, false,
         "Values outside a range, values of another type and unknown keys are refused; validation "
         "never throws."},
        reject);
}

}  // namespace dsc::conformance
