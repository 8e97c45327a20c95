#pragma once
// Velocity `average`: every interface vertex moves towards the mean of its neighbours.

#include <dsc/hooks/velocity_field.hpp>
#include <dsc/plugin/plugin.hpp>

namespace dsc::strategies {

/// Displacement part * (mean of the neighbours on the interface - x): Laplacian smoothing [Saul2015, ch. 4,
/// AverageFunc].
class Average final : public hooks::VelocityField {
public:
    struct Params {
        double part = 0.5;
    };
    static void declare(config::ParamSchema<Params>& schema);

    Average(const Params& params, const plugin::Setup& setup);

    void prepare(const hooks::StepContext& context) override;
    void evaluate(hooks::Range range, std::span<Vec3> out) const override;

private:
    Vec3 mean_of_neighbours(std::size_t vertex) const;

    double part_;
    const surface::SurfaceView* surface_ = nullptr;
};

}  // namespace dsc::strategies
