#pragma once
// The main job: an experiment derived from a cloud, the thesis' pipeline without a knob but the level of detail.

#include <dsc/cloud/cloud.hpp>
#include <dsc/config/node.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace dsc::run {

enum class Detail { low, medium, high };
/// Empty for any other word.
std::optional<Detail> detail_from_name(std::string_view name);

/// The configuration for `file`, whose points are `cloud`. Throws GeometryError as cloud::require_volume. [setup]
config::ConfigNode derive_experiment(const std::string& file, const cloud::Cloud& cloud, Detail detail);

}  // namespace dsc::run
