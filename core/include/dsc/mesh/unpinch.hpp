#pragma once
// Making every interface vertex regular by splitting the pinched ones.

#include <span>
#include <string_view>

#include <dsc/base/workers.hpp>
#include <dsc/mesh/complex.hpp>

namespace dsc::mesh {

/// Splits, or else relabels, until every interface vertex of `seeds` and whatever that touches is regular; returns how
/// many vertices were treated. Throws GeometryError naming vertex and labels when neither works. [step]
std::size_t unpinch(Complex& complex, std::string_view name, std::span<const VertexId> seeds);
/// The same for all interface vertices. `workers`, null for one thread, share the search for irregular ones.
std::size_t unpinch(Complex& complex, std::string_view name, Workers* workers = nullptr);

}  // namespace dsc::mesh
