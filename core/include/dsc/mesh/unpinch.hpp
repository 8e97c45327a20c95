#pragma once
// Makes every interface vertex regular by splitting the pinched ones (method.md, section 8.6).

#include <span>
#include <string_view>

#include <dsc/base/workers.hpp>
#include <dsc/mesh/complex.hpp>

namespace dsc::mesh {

/// Splits, or else relabels, until every vertex of `seeds`, and every vertex that these changes
/// concern, is regular. Returns the number of treated vertices. Throws GeometryError with vertex
/// and labels if neither works. [step]
std::size_t unpinch(Complex& complex, std::string_view name, std::span<const VertexId> seeds);
/// The same for all interface vertices. `workers`, null for one thread, share the search for
/// irregular vertices.
std::size_t unpinch(Complex& complex, std::string_view name, Workers* workers = nullptr);

}  // namespace dsc::mesh
