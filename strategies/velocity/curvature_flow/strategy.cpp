#include "strategy.hpp"

#include <algorithm>
#include <array>

namespace dsc::strategies {

void CurvatureFlow::declare(config::ParamSchema<Params>& schema) {
    schema.real("time_step", &Params::time_step)
        .greater(0)
        .unit("length^2")
        .doc(
            "Time per step. The step is explicit: above about an eighth of the squared shortest edge, neighbouring vertices "
            "overtake each other.");
    schema.strategy("curvature", &Params::curvature, "curvature")
        .doc("Estimator of the mean curvature normal, 1/r on a sphere of radius r.");
}

CurvatureFlow::CurvatureFlow(const Params& params, const plugin::Setup& setup)
    : time_step_(params.time_step),
      curvature_(setup.create<hooks::CurvatureEstimator>("curvature", params.curvature)) {}

void CurvatureFlow::prepare(const hooks::StepContext& context) {
    surface_ = &context.surface;
    curvature_->prepare(context);
}

// The estimator writes the vectors into `out`; its scalars are written to the stack, in pieces, so that nothing is allocated.
void CurvatureFlow::evaluate(hooks::Range range, std::span<Vec3> out) const {
    constexpr std::size_t piece = 128;
    std::array<double, piece> scalar{};
    for (std::size_t done = 0; done < out.size(); done += piece) {
        const std::size_t count = std::min(piece, out.size() - done);
        const std::size_t first = range.begin + done;
        curvature_->evaluate({first, first + count}, std::span(scalar).first(count),
                             out.subspan(done, count));
    }
    for (std::size_t i = 0; i < out.size(); ++i) {
        const bool movable = surface_->movable[range.begin + i] != 0;
        out[i] = movable ? Vec3(-2 * time_step_ * out[i]) : Vec3(Vec3::Zero());
    }
}

}  // namespace dsc::strategies
