// Velocity `normal`: the interface grows or shrinks along its normals with constant speed.
//
//     displacement = speed * N
//
// where N is the outward unit normal [Saul2015, ch. 4, NormalFunc].
#include <dsc/base/version.hpp>
#include <dsc/hooks/velocity_field.hpp>
#include <dsc/plugin/plugin.hpp>

namespace {

using dsc::Vec3;

class Normal final : public dsc::hooks::VelocityField {
public:
    /// The parameters that an experiment may set; the values here are the defaults.
    struct Params {
        double speed = 0.01;
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.real("speed", &Params::speed)
            .unit("length")
            .doc("Distance that a vertex moves outwards per step; negative: inwards.");
    }

    Normal(const Params& params, const dsc::plugin::Setup&) : speed_(params.speed) {}

    void prepare(const dsc::hooks::StepContext& context) override { surface_ = &context.surface; }

    void evaluate(dsc::hooks::Range range, std::span<Vec3> out) const override {
        for (std::size_t i = 0; i < out.size(); ++i) {
            const std::size_t v = range.begin + i;
            out[i] =
                surface_->movable[v] ? Vec3(speed_ * surface_->normals[v]) : Vec3(Vec3::Zero());
        }
    }

    bool can_sample() const override { return true; }

    void sample(std::span<const Vec3>, std::span<const Vec3> unit_normals,
                std::span<Vec3> out) const override {
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = speed_ * unit_normals[i];
    }

private:
    double speed_;
    const dsc::surface::SurfaceView* surface_ = nullptr;
};

}  // namespace

DSC_PLUGIN("normal", DSC_VERSION, "BSD-3-Clause", "Growth of the interface along its normals") {
    registrar.add<Normal>("normal", "moves vertices along their normals with constant speed");
}
