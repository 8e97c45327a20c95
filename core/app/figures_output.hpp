#pragma once
// Prints figures on stdout: JSON for programs, aligned lines for people.

#include <nlohmann/json.hpp>

#include <dsc/geometry/vec.hpp>

namespace dsc::app {

/// `figures` is an object. As text: one line per figure, nested names joined by dots.
void print_figures(const nlohmann::ordered_json& figures, bool as_json);

/// {"low": [x, y, z], "high": [x, y, z], "diagonal": d}
nlohmann::ordered_json box_figures(const Box3& box);

}  // namespace dsc::app
