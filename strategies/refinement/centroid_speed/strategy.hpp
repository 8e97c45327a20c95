#pragma once
// Refinement `centroid_speed`: splits faces that rest on three vertices but do not follow the target between them.

#include <dsc/hooks/refinement_policy.hpp>
#include <dsc/plugin/plugin.hpp>

namespace dsc::strategies {

/// Requests a split of every interface face whose three vertices are at rest while its centroid is not: "a face that is
/// out-of-place, but whose endpoints are happy where they are" [Saul2015, ch. 7]. The speed of a point is the length of
/// velocity->sample() there, with the normal of the vertex or of the face.
class CentroidSpeed final : public hooks::RefinementPolicy {
public:
    struct Params {
        double rest = 0.02;
        double moving = 0.02;
        double absolute = 0.0;
        double finest = 0.0;
    };
    static void declare(config::ParamSchema<Params>& schema);

    CentroidSpeed(const Params& params, const plugin::Setup& setup);

    bool needs_sampling() const override { return true; }
    void refine(const hooks::RefinementContext& context, hooks::RefinementRequests& out) override;

private:
    void mark_resting(const hooks::RefinementContext& context);
    void collect_faces(const hooks::StepContext& step);
    bool too_fine(const hooks::StepContext& step, std::uint32_t face) const;

    Params params_;
    // Kept between calls to reuse their memory.
    std::vector<std::uint8_t> resting_;      // of each vertex
    std::vector<std::uint32_t> candidates_;  // faces with three resting vertices
    std::vector<Vec3> points_, normals_, displacements_;
};

}  // namespace dsc::strategies
