// Velocity `@NAME@`: a balloon. Every interface vertex goes outwards along its normal and, as a skin under tension would,
// towards the mean of its neighbours.
#include <dsc/hooks/velocity_field.hpp>
#include <dsc/plugin/plugin.hpp>

namespace {

using dsc::Vec3;

class @CLASS@ final : public dsc::hooks::VelocityField {
public:
    /// What an experiment may set; the values here are the defaults.
    struct Params {
        double inflation = 0.1;
        double tension = 0.3;
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.real("inflation", &Params::inflation)
            .range(-1, 1)
            .unit("mean edges")
            .doc("Length that a vertex goes outwards in a step; negative: inwards.");
        schema.real("tension", &Params::tension)
            .range(0, 1)
            .unit("1")
            .doc("Part of the way to the mean of its neighbours that a vertex goes in a step.");
    }

    @CLASS@(const Params& params, const dsc::plugin::Setup&) : params_(params) {}

    // Before the other calls of a step. The context lives until the next call; state from step to step belongs in advance().
    void prepare(const dsc::hooks::StepContext& context) override {
        surface_ = &context.surface;
        outwards_ = params_.inflation * surface_->mean_edge;
    }

    // Several threads call this at once, each for a range of its own: it reads, and writes nothing but `out`.
    void evaluate(dsc::hooks::Range range, std::span<Vec3> out) const override {
        for (std::size_t i = 0; i < out.size(); ++i) {
            const std::size_t v = range.begin + i;
            const Vec3 inwards = mean_of_neighbours(v) - surface_->positions[v];
            out[i] = outwards_ * surface_->normals[v] + params_.tension * inwards;
        }
    }

private:
    // Round a closed vertex every neighbour is in two faces, so the mean over the faces is that over the neighbours.
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
    double outwards_ = 0.0;  // normalised units
};

}  // namespace

DSC_PLUGIN("@NAME@", "0.1.0", "BSD-3-Clause", "Velocity @NAME@") {
    registrar.add<@CLASS@>("@NAME@", "a balloon: outwards along the normals, held by tension");
}
