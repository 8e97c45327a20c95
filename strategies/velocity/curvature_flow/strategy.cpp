// Velocity `curvature_flow`: the interface moves by its mean curvature, like a soap film.
//
//     displacement = -2 H N dt
//
// where H N is the curvature vector of the nested estimator: an explicit step of mean curvature
// flow. A sphere of radius r0 has the radius sqrt(r0^2 - 4 t) at time t [Huisken1984].
#include <algorithm>
#include <array>

#include <dsc/base/version.hpp>
#include <dsc/hooks/curvature_estimator.hpp>
#include <dsc/hooks/velocity_field.hpp>
#include <dsc/plugin/plugin.hpp>

namespace {

using dsc::Vec3;

class CurvatureFlow final : public dsc::hooks::VelocityField {
public:
    /// The parameters that an experiment may set; the values here are the defaults.
    struct Params {
        double time_step = 1e-3;
        dsc::config::StrategyConfig curvature{"implicit_fairing", dsc::config::ConfigNode::map()};
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.real("time_step", &Params::time_step)
            .greater(0, "length^2")
            .doc("Time per step. The step is explicit: above about an eighth of the squared "
                 "shortest edge, neighbouring vertices overtake each other.");
        schema.strategy("curvature", &Params::curvature, "curvature")
            .doc("Estimator of the mean curvature normal, 1/r on a sphere of radius r.");
    }

    CurvatureFlow(const Params& params, const dsc::plugin::Setup& setup)
        : time_step_(params.time_step),
          curvature_(setup.create<dsc::hooks::CurvatureEstimator>("curvature", params.curvature)) {}

    void prepare(const dsc::hooks::StepContext& context) override {
        surface_ = &context.surface;
        curvature_->prepare(context);
    }

    // The estimator writes the vectors into `out`; its scalars are written to the stack, in pieces,
    // so that nothing is allocated.
    void evaluate(dsc::hooks::Range range, std::span<Vec3> out) const override {
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

private:
    double time_step_;
    std::unique_ptr<dsc::hooks::CurvatureEstimator> curvature_;
    const dsc::surface::SurfaceView* surface_ = nullptr;
};

}  // namespace

DSC_PLUGIN("curvature_flow", DSC_VERSION, "BSD-3-Clause", "Mean curvature flow of the interface") {
    registrar.add<CurvatureFlow>("curvature_flow",
                                 "moves the interface by mean curvature flow, -2 H N");
}
