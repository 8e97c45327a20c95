#pragma once
// Hook `refinement`: what to split between steps.

#include <array>
#include <vector>

#include <dsc/hooks/context.hpp>
#include <dsc/hooks/velocity_field.hpp>

namespace dsc::hooks {

/// What a refinement sees beyond a step.
struct RefinementContext {
    const StepContext& step;
    const VelocityField* velocity = nullptr;  ///< prepared for this surface; sample() only where can_sample()
};

/// What it may ask for. Requests that the kernel refuses are counted, not repeated.
struct RefinementRequests {
    std::vector<std::uint32_t> split_faces;                 ///< view faces: split their longest edge at its midpoint
    std::vector<std::array<std::uint32_t, 2>> split_edges;  ///< pairs of joined view vertices: split at the midpoint
    std::vector<double> sizing;                             ///< empty, or a target length per view vertex: longer edges are split
    std::vector<std::array<std::uint32_t, 2>> relabel;      ///< (tet id, label)
};

/// Says what, the kernel owns how. [step]
class RefinementPolicy : public Strategy {
public:
    ~RefinementPolicy() override;

    /// Whether refine() calls velocity->sample().
    virtual bool needs_sampling() const { return false; }
    virtual void refine(const RefinementContext& context, RefinementRequests& out) = 0;
};

}  // namespace dsc::hooks
