#pragma once
// Steps in which nothing or nearly nothing moves: their cost must not know how large the volume is.

#include <nlohmann/json.hpp>

#include "pipeline.hpp"

namespace dsc::bench {

/// Medians of Deformer::step alone, in milliseconds: `idle_ms` with zero displacements,
/// `one_vertex_ms` with one vertex that goes to and fro by a twentieth of L. The body comes to rest
/// first.
nlohmann::ordered_json quiet_steps(Body& body);

/// Those of the cube of 2,402 interface vertices in the box of the thesis and in one of ten times
/// as many tets.
nlohmann::ordered_json exteriors(const Plugins& plugins);

}  // namespace dsc::bench
