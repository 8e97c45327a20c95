#pragma once
// Values of a configuration as JSON.

#include <nlohmann/json.hpp>

#include <dsc/config/node.hpp>

namespace dsc::app {

/// The same tree as JSON; keys keep their order.
nlohmann::ordered_json to_json(const config::ConfigNode& node);

/// A number without an unnecessary ".0".
nlohmann::ordered_json number_json(double value);

}  // namespace dsc::app
