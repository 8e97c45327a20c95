// Velocity `average`: every interface vertex moves towards the mean of its neighbours.
//
//     displacement = part * (mean of the neighbours on the interface - x)
//
// This is Laplacian smoothing [Saul2015, ch. 4, AverageFunc].
#include <dsc/base/version.hpp>
#include <dsc/hooks/velocity_field.hpp>
#include <dsc/plugin/plugin.hpp>

namespace {

using dsc::Vec3;

class Average final : public dsc::hooks::VelocityField {
public:
    /// The parameters that an experiment may set; the values here are the defaults.
    struct Params {
        double part = 0.5;
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.real("part", &Params::part)
            .range(0, 1, "dimensionless")
            .doc("Fraction of the way to the mean of the neighbours that a vertex moves per step.");
    }

    Average(const Params& params, const dsc::plugin::Setup&) : part_(params.part) {}

    void prepare(const dsc::hooks::StepContext& context) override { surface_ = &context.surface; }

    void evaluate(dsc::hooks::Range range, std::span<Vec3> out) const override {
        for (std::size_t i = 0; i < out.size(); ++i) {
            const std::size_t v = range.begin + i;
            out[i] = surface_->movable[v]
                         ? Vec3(part_ * (mean_of_neighbours(v) - surface_->positions[v]))
                         : Vec3(Vec3::Zero());
        }
    }

private:
    // Around a closed vertex every neighbour is in two faces, so the mean over the faces is the
    // mean over the neighbours.
    Vec3 mean_of_neighbours(std::size_t vertex) const {
        Vec3 sum = Vec3::Zero();
        std::size_t count = 0;
        for (const std::uint32_t face : surface_->faces_of(vertex)) {
            for (const std::uint32_t v : surface_->faces[face]) {
                if (v == vertex) continue;
                sum += surface_->positions[v];
                ++count;
            }
        }
        return count == 0 ? surface_->positions[vertex] : Vec3(sum / static_cast<double>(count));
    }

    double part_;
    const dsc::surface::SurfaceView* surface_ = nullptr;
};

}  // namespace

DSC_PLUGIN("average", DSC_VERSION, "BSD-3-Clause", "Smoothing of the interface by averages") {
    registrar.add<Average>("average", "moves vertices towards the mean of their neighbours");
}
