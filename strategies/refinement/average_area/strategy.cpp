#include "strategy.hpp"

namespace dsc::strategies {

void AverageArea::declare(config::ParamSchema<Params>& schema) {
    schema.real("factor", &Params::factor)
        .greater(0)
        .unit("1")
        .doc("Area from which faces are split, in average areas.");
}

AverageArea::AverageArea(const Params& params, const plugin::Setup&) : factor_(params.factor) {}

void AverageArea::refine(const hooks::RefinementContext& context, hooks::RefinementRequests& out) {
    const std::vector<double>& areas = context.step.surface.face_areas;
    if (areas.empty()) return;
    double sum = 0;
    for (const double area : areas) sum += area;
    // Equal areas equal their average, in spite of rounding in the sum.
    constexpr double rounding = 1e-12;
    const double bound = factor_ * (sum / static_cast<double>(areas.size())) * (1 - rounding);
    for (std::uint32_t face = 0; face < areas.size(); ++face) {
        if (areas[face] >= bound) out.split_faces.push_back(face);
    }
}

}  // namespace dsc::strategies
