#pragma once
// The requests of refinements and the attributes of strategies: as numbers, and their faults.

#include <string>

#include <dsc/hooks/refinement_policy.hpp>

#include "trace.hpp"

namespace dsc::conformance {

/// The attribute that does not fit a surface with this number of vertices; empty: none.
std::string unfit(const hooks::Attributes& attributes, std::size_t vertices);
/// The target lengths that do not fit; empty: none. out.finite tests for values that are not
/// finite.
std::string unfit_lengths(const hooks::RefinementRequests& requests, std::size_t vertices);

/// All requests except the attributes, in parts whose names end with `at`.
void add_requests(const hooks::RefinementRequests& requests, const std::string& at, Trace& trace);

}  // namespace dsc::conformance
