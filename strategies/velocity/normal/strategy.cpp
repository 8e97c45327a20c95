#include "strategy.hpp"

namespace dsc::strategies {

void Normal::declare(config::ParamSchema<Params>& schema) {
    schema.real("speed", &Params::speed)
        .unit("length")
        .doc("Distance that a vertex moves outwards per step; negative: inwards.");
}

Normal::Normal(const Params& params, const plugin::Setup&) : speed_(params.speed) {}

void Normal::prepare(const hooks::StepContext& context) { surface_ = &context.surface; }

void Normal::evaluate(hooks::Range range, std::span<Vec3> out) const {
    for (std::size_t i = 0; i < out.size(); ++i) {
        const std::size_t v = range.begin + i;
        out[i] = surface_->movable[v] ? Vec3(speed_ * surface_->normals[v]) : Vec3(Vec3::Zero());
    }
}

void Normal::sample(std::span<const Vec3>, std::span<const Vec3> unit_normals, std::span<Vec3> out) const {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = speed_ * unit_normals[i];
}

}  // namespace dsc::strategies
