#pragma once
// The separate parts of Field::summary(), for tables.

#include <string>

#include <dsc/config/schema.hpp>

namespace dsc::config {

/// The values that a field accepts, without unit and default: "real, (0, 1]", "list of strings out
/// of obj | ply, 1 to 4 items". [setup]
std::string type_text(const Field& field);

/// "0.2", "[0, 0, 1]"; "required"; "unset" for an optional field; empty for a map, because its
/// fields have their own defaults. [setup]
std::string default_text(const Field& field);

}  // namespace dsc::config
