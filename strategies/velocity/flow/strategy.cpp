// Velocity `flow`: the interface moves with a velocity field in closed form.
//
//     displacement = integral of u(x(t), t) dt over one step, by the Runge-Kutta method of order 4
//
// fields.hpp contains the fields u. Step n covers the time from (n - 1) dt to n dt: the time needs
// no state, and a resumed run continues where it stopped. A refinement between steps gets the
// velocity of the step before it.
#include <dsc/base/version.hpp>
#include <dsc/hooks/velocity_field.hpp>
#include <dsc/plugin/plugin.hpp>

#include "fields.hpp"

namespace {

using dsc::Vec3;
using dsc::strategies::Field;
using dsc::strategies::FieldKind;

class Flow final : public dsc::hooks::VelocityField {
public:
    static constexpr dsc::hooks::Traits traits = {.rigid = false};

    /// The parameters that an experiment may set; the values here are the defaults.
    struct Params : Field {
        double time_step = 0.01;
        int substeps = 1;
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema
            .choice("field", static_cast<FieldKind Params::*>(&Params::kind),
                    {{"translate", FieldKind::translate},
                     {"rotate", FieldKind::rotate},
                     {"shear", FieldKind::shear},
                     {"part", FieldKind::part},
                     {"enright", FieldKind::enright}})
            .doc(
                "Velocity field: 'translate' along axis; 'rotate' about axis; 'shear' along axis, "
                "with a speed that grows along across; 'part', two sides move apart or together "
                "along axis; 'enright', a deformation of the unit cube that returns to the start.");
        schema.vec3("centre", static_cast<Vec3 Params::*>(&Params::centre))
            .unit("length")
            .doc("Point where the speed of 'rotate', 'shear' and 'part' is 0.");
        schema.vec3("axis", static_cast<Vec3 Params::*>(&Params::axis))
            .unit("dimensionless")
            .doc("Direction of the field; its length does not matter.");
        schema.vec3("across", static_cast<Vec3 Params::*>(&Params::across))
            .unit("dimensionless")
            .doc("Direction in which the speed of 'shear' grows; perpendicular to axis.");
        schema.real("speed", &Params::speed)
            .unit("length/time, radians/time or 1/time")
            .doc("Speed of 'translate' and of both sides of 'part' (negative: together), angle of "
                 "'rotate', growth of 'shear'.");
        schema.real("width", &Params::width)
            .greater(0, "length")
            .doc("Half the thickness of the layer in which 'part' changes from one side to the "
                 "other.");
        schema.real("period", &Params::period)
            .greater(0, "time")
            .doc("Time at which 'enright' has moved everything back; the motion reverses at half "
                 "of this time.");
        schema.real("time_step", &Params::time_step).greater(0, "time").doc("Time per step.");
        schema.integer("substeps", &Params::substeps)
            .range(1, 1000, "dimensionless")
            .doc("Number of Runge-Kutta steps per step.");
        schema.check([](const Params& p) { return p.axis.norm() > 1e-9; },
                     "axis must not be the zero vector");
        schema.check(
            [](const Params& p) {
                return p.across.norm() > 1e-9 &&
                       (p.kind != FieldKind::shear ||
                        std::abs(p.across.normalized().dot(p.axis.normalized())) < 1e-9);
            },
            "across must be perpendicular to axis and not the zero vector");
    }

    Flow(const Params& params, const dsc::plugin::Setup&) : params_(params) {}

    void prepare(const dsc::hooks::StepContext& context) override {
        surface_ = &context.surface;
        time_ = context.step == 0 ? 0.0 : static_cast<double>(context.step - 1) * params_.time_step;
    }

    void evaluate(dsc::hooks::Range range, std::span<Vec3> out) const override {
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = displacement_of(surface_->positions[range.begin + i]);
    }

    bool can_sample() const override { return true; }

    void sample(std::span<const Vec3> points, std::span<const Vec3>,
                std::span<Vec3> out) const override {
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = displacement_of(points[i]);
    }

private:
    Vec3 displacement_of(const Vec3& point) const {
        return dsc::strategies::displacement(params_, point, time_, params_.time_step,
                                             params_.substeps);
    }

    Params params_;
    double time_ = 0.0;  // at the start of the step
    const dsc::surface::SurfaceView* surface_ = nullptr;
};

}  // namespace

DSC_PLUGIN("flow", DSC_VERSION, "BSD-3-Clause",
           "Advection of the interface by analytic velocity fields") {
    registrar.add<Flow>("flow", "moves the interface with an analytic velocity field");
}
