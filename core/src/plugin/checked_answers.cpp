// Checks that answers of every kind of strategy share: names, attributes, rules for creases,
// figures and warnings.
#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include <dsc/text/words.hpp>

#include "plugin/checked.hpp"

namespace dsc::plugin {

void check_answer(const Call& current, const hooks::Attributes& attributes, std::size_t vertices) {
    std::vector<std::string_view> seen;
    for (const hooks::Attribute& a : attributes) {
        if (!hooks::may_name_attribute(a.name) ||
            std::find(seen.begin(), seen.end(), a.name) != seen.end()) {
            fail(current, "strategy.range", "gave an attribute the name '" + a.name + "'",
                 "names are snake_case, differ, and are not reserved for other data in files; "
                 "report this to the plugin's authors");
        }
        seen.push_back(a.name);
        if (a.values.size() != vertices) {
            fail(current, "strategy.size",
                 fmt::format("gave the attribute '{}' {} values for {} vertices", a.name,
                             a.values.size(), vertices),
                 report_it);
        }
        for (std::size_t i = 0; i < vertices; ++i) {
            if (std::isfinite(a.values[i])) continue;
            fail(current, "strategy.not_finite",
                 fmt::format("gave the attribute '{}' the value {:f} at {}", a.name, a.values[i],
                             entry("vertex", i)),
                 report_it);
        }
    }
}

void check_answer(const Call& current, const std::optional<repair::CreaseRule>& creases) {
    if (!creases) return;
    constexpr double pi = 3.14159265358979323846;
    for (const double angle : {creases->dihedral, creases->turn}) {
        if (angle > 0 && angle <= pi) continue;
        fail(current, "strategy.range", fmt::format("gave the angle {:f} for creases", angle),
             "angles are above 0 and at most pi; report this to the plugin's authors");
    }
}

// Figures for columns and keys: names in snake_case, each once; finite values.
void check_answer(const Call& current, const hooks::Figures& figures) {
    std::vector<std::string_view> seen;
    for (const auto& [name, value] : figures) {
        if (!text::is_snake_case(name) || std::find(seen.begin(), seen.end(), name) != seen.end()) {
            fail(current, "strategy.range", "gave a figure the name '" + name + "'",
                 "names are snake_case and differ; report this to the plugin's authors");
        }
        seen.push_back(name);
        if (!std::isfinite(value)) {
            fail(current, "strategy.not_finite",
                 fmt::format("gave the figure '{}' the value {:f}", name, value), report_it);
        }
    }
}

// Warnings for people and programs: a code of lower-case words and dots, and a text.
void check_answer(const Call& current, const hooks::Warnings& warnings) {
    for (const hooks::Warning& warning : warnings) {
        const bool plain = std::all_of(warning.code.begin(), warning.code.end(), [](char c) {
            return text::is_lower(c) || text::is_digit(c) || c == '_' || c == '.';
        });
        if (warning.code.empty() || !plain || warning.text.empty()) {
            fail(current, "strategy.range",
                 "gave a warning with the code '" + warning.code + "' and the text '" +
                     warning.text + "'",
                 "a code has lower-case letters, digits, '_' and '.', a text is not empty; report "
                 "this to the plugin's authors");
        }
    }
}

}  // namespace dsc::plugin
