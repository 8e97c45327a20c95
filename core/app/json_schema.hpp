#pragma once
// The JSON Schema of an experiment.

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <dsc/config/schema.hpp>

#include "describe.hpp"

namespace dsc::app {

/// Draft-07, which editors support. It accepts what the program's own checker accepts, except that
/// it only describes the conditions between parameters and does not check that files exist.
///
/// A strategy is checked by if/then on its `type`: an editor then shows what is wrong with the
/// strategy that was meant, not that none of twenty fits. Required keys are separate from allowed
/// keys, because a file with `include` need not be complete.
nlohmann::ordered_json json_schema(const std::vector<Described>& strategies);

/// Names in `definitions`: text with an environment variable; a strategy of a kind, and its
/// required keys.
std::string variable_definition();
std::string kind_definition(const std::string& kind);
std::string required_definition(const std::string& kind);

/// `{"$ref": "#/definitions/NAME"}`.
nlohmann::ordered_json reference(const std::string& definition);

/// The schema of the value of one field. Items of a list are complete, because `include` replaces
/// lists.
nlohmann::ordered_json value_schema(const config::Field& field);

/// A map with these fields and no others; `id` is that of a strategy, whose map also has a `type`.
/// Required keys are not part of it.
nlohmann::ordered_json map_schema(const config::Schema& schema, const std::string& id = "");

/// The required keys of a map, including nested ones; empty if nothing is required.
nlohmann::ordered_json required_schema(const config::Schema& schema);

/// "Also checked: ..." for the conditions of a map; empty if there are none.
std::string conditions_text(const config::Schema& schema);

}  // namespace dsc::app
