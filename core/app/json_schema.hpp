#pragma once
// The JSON Schema of an experiment.

#include <dsc/config/schema.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "describe.hpp"

namespace dsc::app {

/// Draft-07, which editors support. It accepts what the program's own checker accepts, but for conditions between
/// parameters, which it can only tell, and refuses what that refuses, but for files that are not there.
///
/// A strategy is judged by if/then on its `type`: an editor then says what is wrong with the one that was meant, not that
/// none of twenty fits. What must be given is kept apart from what may be given, because a file with `include` need not
/// be complete.
nlohmann::ordered_json json_schema(const std::vector<Described>& strategies);

/// Names in `definitions`: text with an environment variable; a strategy of a kind, and what such a one must have.
std::string variable_definition();
std::string kind_definition(const std::string& kind);
std::string required_definition(const std::string& kind);

/// `{"$ref": "#/definitions/NAME"}`.
nlohmann::ordered_json reference(const std::string& definition);

/// The schema of one field's value. Items of a list are complete, as `include` replaces lists.
nlohmann::ordered_json value_schema(const config::Field& field);

/// A map with these fields and no others; `id` is that of a strategy, whose map has a `type` besides. What must be given
/// is no part of it.
nlohmann::ordered_json map_schema(const config::Schema& schema, const std::string& id = "");

/// What a map must have, in itself and below; empty where nothing is required.
nlohmann::ordered_json required_schema(const config::Schema& schema);

/// "Checked besides: ..." for the conditions of a map; empty without any.
std::string conditions_text(const config::Schema& schema);

}  // namespace dsc::app
