#pragma once
// Contexts and calls for tests of strategies that have a surface and no kernel.

#include <vector>

#include <dsc/hooks/velocity_field.hpp>

namespace dsc::sdk {

/// The context of a step on the surface: no cloud, the box [-1.5, 1.5]^3, L is the mean edge.
/// `view` must outlive it.
hooks::StepContext step_context(const surface::SurfaceView& view, std::uint64_t step = 1);

/// One step of the field: advances and prepares it, and evaluates it for all vertices, in blocks as
/// the host does.
std::vector<Vec3> displacements(hooks::VelocityField& field, const hooks::StepContext& context,
                                unsigned threads = 1, std::size_t block = 64);

}  // namespace dsc::sdk
