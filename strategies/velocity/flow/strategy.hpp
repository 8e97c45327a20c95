#pragma once
// Velocity `flow`: the interface moves with a velocity field in closed form.

#include <dsc/hooks/velocity_field.hpp>
#include <dsc/plugin/plugin.hpp>

#include "fields.hpp"

namespace dsc::strategies {

/// Step n covers the time from (n - 1) dt to n dt: time needs no state, and a resumed run continues where it
/// stopped. A refinement between steps gets the velocity of the step before it.
class Flow final : public hooks::VelocityField {
public:
    static constexpr hooks::Traits traits = {.rigid = false};
    struct Params : Field {
        double time_step = 0.01;
        int substeps = 1;
    };
    static void declare(config::ParamSchema<Params>& schema);

    Flow(const Params& params, const plugin::Setup& setup);

    void prepare(const hooks::StepContext& context) override;
    void evaluate(hooks::Range range, std::span<Vec3> out) const override;

    bool can_sample() const override { return true; }
    void sample(std::span<const Vec3> points, std::span<const Vec3> unit_normals,
                std::span<Vec3> out) const override;

private:
    Vec3 displacement_of(const Vec3& point) const {
        return displacement(params_, point, time_, params_.time_step, params_.substeps);
    }

    Params params_;
    double time_ = 0.0;  // at the start of the step
    const surface::SurfaceView* surface_ = nullptr;
};

}  // namespace dsc::strategies
