#pragma once
// Makes sets of parameters for a strategy from its schema.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <dsc/config/schema.hpp>

namespace dsc::conformance {

/// A change of some parameters, and its description: "alpha = 2 (its maximum)".
struct Variation {
    std::string name;
    config::ConfigNode parameters;  ///< a map without `type`; the other parameters keep the values
                                    ///< of `base`
};

/// Every single parameter at each end of its range (just inside an open end), each choice, both
/// truth values, unset where that is allowed. A parameter tagged "costly" is never larger than in
/// `base`.
std::vector<Variation> extremes(const config::Schema& schema, const config::ConfigNode& base);

/// Random values within the ranges for all parameters; the same for the same seed.
Variation random_variation(const config::Schema& schema, const config::ConfigNode& base,
                           std::uint64_t seed);

/// One wrong value for each parameter and each kind of error: below and above the range, another
/// type, an unknown choice; and a key that does not exist.
std::vector<Variation> wrong(const config::Schema& schema, const config::ConfigNode& base);

/// The parameters after a change of the unit of length: every real parameter is multiplied by
/// `factor` to the power of the length in its unit ("length" 1, "length^2" 2, "1/length" -1).
/// "curvature" counts as `curvature_power`, because it depends on the estimator: -1 for 1/length, 0
/// for radians. Empty if a unit depends on another parameter.
std::optional<config::ConfigNode> with_scaled_lengths(const config::Schema& schema,
                                                      const config::ConfigNode& given,
                                                      double factor, int curvature_power);

}  // namespace dsc::conformance
