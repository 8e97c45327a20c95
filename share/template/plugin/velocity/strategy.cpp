// Velocity `@NAME@`: a balloon. Every interface vertex moves outwards along its normal and, like a
// skin under tension, towards the mean of its neighbours.
//
//     displacement = inflation * (mean edge) * N + tension * (mean of the neighbours - x)
//
// where x is the vertex and N its outward unit normal.
#include <dsc/hooks/velocity_field.hpp>
#include <dsc/plugin/plugin.hpp>

namespace {

using dsc::Vec3;

class @CLASS@ final : public dsc::hooks::VelocityField {
public:
    /// The parameters that an experiment may set; the values here are the defaults.
    struct Params {
        double inflation = 0.1;
        double tension = 0.3;
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.real("inflation", &Params::inflation)
            .range(-1, 1, "current mean edges")
            .doc("Distance that a vertex moves outwards per step; negative: inwards.");
        schema.real("tension", &Params::tension)
            .range(0, 1, "dimensionless")
            .doc("Fraction of the way to the mean of its neighbours that a vertex moves per step.");
    }

    @CLASS@(const Params& params, const dsc::plugin::Setup&) : params_(params) {}

    // Called before the other calls of a step. The context is valid until the next call; advance()
    // keeps state between steps.
    void prepare(const dsc::hooks::StepContext& context) override {
        surface_ = &context.surface;
        outwards_ = params_.inflation * surface_->mean_edge;
    }

    // Several threads call this at the same time, each for its own range: it only reads, and writes
    // only `out`.
    void evaluate(dsc::hooks::Range range, std::span<Vec3> out) const override {
        for (std::size_t i = 0; i < out.size(); ++i) {
            const std::size_t v = range.begin + i;
            const Vec3 inwards = mean_of_neighbours(v) - surface_->positions[v];
            out[i] = outwards_ * surface_->normals[v] + params_.tension * inwards;
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

    Params params_;
    const dsc::surface::SurfaceView* surface_ = nullptr;
    double outwards_ = 0.0;  // in normalised units
};

}  // namespace

DSC_PLUGIN("@NAME@", "0.1.0", "BSD-3-Clause", "Velocity @NAME@") {
    registrar.add<@CLASS@>("@NAME@",
                           "a balloon: moves outwards along the normals, held back by tension");
}
