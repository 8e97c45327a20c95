#pragma once
// Sets of parameters for a strategy, made from its schema.

#include <cstdint>
#include <dsc/config/schema.hpp>
#include <string>
#include <vector>

namespace dsc::conformance {

/// A change of some parameters, and what it is in words: "alpha = 2 (its maximum)".
struct Variation {
    std::string name;
    config::ConfigNode parameters;  ///< a map without `type`, the others keep the values of `base`
};

/// Every parameter by itself at each end of its range (just inside an open one), each choice, both truth values, unset where
/// it may be. A parameter tagged "costly" goes no further up than `base` has it.
std::vector<Variation> extremes(const config::Schema& schema, const config::ConfigNode& base);

/// All parameters at random within their ranges; the same for the same seed.
Variation random_variation(const config::Schema& schema, const config::ConfigNode& base, std::uint64_t seed);

/// One wrong value for each parameter and each way of being wrong: below and above the range, another type, an unknown
/// choice; and a key that there is not.
std::vector<Variation> wrong(const config::Schema& schema, const config::ConfigNode& base);

}  // namespace dsc::conformance
