#pragma once
// What a refinement asks for and what strategies publish, as numbers and as faults.

#include <dsc/hooks/refinement_policy.hpp>
#include <string>

#include "trace.hpp"

namespace dsc::conformance {

/// Which attribute does not fit a surface with so many vertices; empty: none.
std::string unfit(const hooks::Attributes& attributes, std::size_t vertices);
/// Which target lengths do not fit; empty: none. Values that are not finite are the business of out.finite.
std::string unfit_lengths(const hooks::RefinementRequests& requests, std::size_t vertices);

/// All requests but the attributes, in parts whose names end with `at`.
void add_requests(const hooks::RefinementRequests& requests, const std::string& at, Trace& trace);

}  // namespace dsc::conformance
