#pragma once
// Makes sets of parameters for a strategy from its schema.

#include <cstdint>
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

}  // namespace dsc::conformance
