// A sound plugin with two strategies; one nests the other.
#include <algorithm>
#include <istream>
#include <ostream>
#include <stdexcept>

#include <dsc/plugin/plugin.hpp>

namespace {

class Constant final : public dsc::hooks::CurvatureEstimator {
public:
    struct Params {
        double value = 1.0;
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.real("value", &Params::value)
            .unit("dimensionless")
            .doc("The curvature of every vertex.");
    }
    Constant(const Params& params, const dsc::plugin::Setup&) : value_(params.value) {}
    void prepare(const dsc::hooks::StepContext&) override {}
    void evaluate(dsc::hooks::Range, std::span<double> scalar,
                  std::span<dsc::Vec3> vector) const override {
        std::fill(scalar.begin(), scalar.end(), value_);
        std::fill(vector.begin(), vector.end(), dsc::Vec3::Zero());
    }

private:
    double value_;
};

class Upwards final : public dsc::hooks::VelocityField {
public:
    static constexpr dsc::hooks::Traits traits = {.rigid = false};
    struct Params {
        double speed = 0.5;
        dsc::config::StrategyConfig curvature;
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.real("speed", &Params::speed)
            .range(0, 1, "length")
            .doc("Displacement along z in a step.");
        schema.strategy("curvature", &Params::curvature, "curvature")
            .optional()
            .doc("Multiplies the speed.");
    }
    Upwards(const Params& params, const dsc::plugin::Setup& setup)
        : speed_(params.speed),
          curvature_(setup.create<dsc::hooks::CurvatureEstimator>("curvature", params.curvature)) {}

    void prepare(const dsc::hooks::StepContext& context) override {
        surface_ = &context.surface;
        if (curvature_) curvature_->prepare(context);
    }
    void evaluate(dsc::hooks::Range range, std::span<dsc::Vec3> out) const override {
        for (std::size_t i = 0; i < out.size(); ++i) {
            double factor = 1;
            dsc::Vec3 unused;
            if (curvature_)
                curvature_->evaluate({range.begin + i, range.begin + i + 1}, {&factor, 1},
                                     {&unused, 1});
            out[i] = dsc::Vec3(0, 0, factor * speed_);
        }
    }
    void publish(dsc::hooks::Attributes& out) const override {
        dsc::hooks::Attribute height{"height", {}};
        for (const dsc::Vec3& p : surface_->positions) height.values.push_back(p.z());
        out.push_back(height);
    }
    void save(std::ostream& out) const override { out << speed_; }
    void load(std::istream& in) override {
        if (!(in >> speed_)) throw std::runtime_error("no speed in the saved state");
    }

private:
    double speed_;
    std::unique_ptr<dsc::hooks::CurvatureEstimator> curvature_;
    const dsc::surface::SurfaceView* surface_ = nullptr;
};

}  // namespace

DSC_PLUGIN("good", "1.2.3", "MIT", "Two strategies without a fault", "A. Author") {
    registrar.add<Upwards>("upwards", "everything goes up");
    registrar.add<Constant>("constant", "the same curvature everywhere");
}
