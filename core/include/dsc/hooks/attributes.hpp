#pragma once
// Attributes: numbers per vertex that a strategy publishes in addition to its main result.

#include <string>
#include <string_view>
#include <vector>

namespace dsc::hooks {

/// A number per view vertex. The kernel keeps it through edits: a vertex made by a split gets the
/// mean of the edge's ends; after a collapse the kept end keeps its value.
struct Attribute {
    std::string name;  ///< snake_case, the same in every step; not one of `reserved_attributes`
    std::vector<double> values;  ///< finite, one per view vertex
};

/// Attributes of one surface; their names must differ. If two strategies publish the same name, the
/// later values are used.
using Attributes = std::vector<Attribute>;

/// Names that the files of a run use for other data.
inline constexpr const char* reserved_attributes[] = {
    "x",    "y",     "z",     "nx",      "ny",     "nz",        "red",     "green",
    "blue", "alpha", "label", "quality", "normal", "curvature", "distance"};

/// Whether an attribute may have this name: snake_case and not reserved.
bool may_name_attribute(std::string_view name);

}  // namespace dsc::hooks
