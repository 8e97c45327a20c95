#pragma once
// Converts between strategies, which use view vertices and faces, and the kernel: the requests of a
// refinement, and the numbers per vertex that strategies publish.

#include <dsc/hooks/refinement_policy.hpp>
#include <dsc/kernel/deformer.hpp>
#include <dsc/surface/surface_view.hpp>

namespace dsc::run {

/// Passes target lengths and attributes to the kernel. `view` must be a view of the deformer's
/// complex. [step]
void set_fields(kernel::Deformer& deformer, const surface::SurfaceView& view,
                const hooks::RefinementRequests& requests);
/// Passes the attributes to the kernel. [step]
void set_attributes(kernel::Deformer& deformer, const surface::SurfaceView& view,
                    const hooks::Attributes& attributes);

/// All attributes at these vertices of the deformer's complex; NaN off the interface.
hooks::Attributes attributes_at(const kernel::Deformer& deformer,
                                std::span<const mesh::VertexId> vertices);

/// The stricter bounds of two rules; the only rule if there is one; none if there is none.
std::optional<repair::CreaseRule> stricter(const std::optional<repair::CreaseRule>& a,
                                           const std::optional<repair::CreaseRule>& b);

/// The requests that change the mesh, without those for labels.
kernel::RefineRequests kernel_requests(const surface::SurfaceView& view,
                                       const hooks::RefinementRequests& requests, bool owns_sizing);

}  // namespace dsc::run
