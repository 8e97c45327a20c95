// A velocity that misbehaves on demand, for tests of what the command makes of it.
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <stdexcept>

#include <dsc/plugin/plugin.hpp>

namespace {

class Faulty final : public dsc::hooks::VelocityField {
public:
    enum class Fault { none, throws, nan, outside, exits, quick_exits, ends, prints };
    struct Params {
        Fault fault = Fault::none;
        int step = 1;
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema
            .choice("fault", &Params::fault,
                    {{"none", Fault::none},
                     {"throws", Fault::throws},
                     {"nan", Fault::nan},
                     {"outside", Fault::outside},
                     {"exits", Fault::exits},
                     {"quick_exits", Fault::quick_exits},
                     {"ends", Fault::ends},
                     {"prints", Fault::prints}})
            .doc("What goes wrong.");
        schema.integer("step", &Params::step).at_least(0, "steps").doc("In which step.");
    }
    Faulty(const Params& params, const dsc::plugin::Setup&) : params_(params) {}
    void prepare(const dsc::hooks::StepContext& context) override {
        now_ = context.step == static_cast<std::uint64_t>(params_.step);
        surface_ = &context.surface;
    }
    void evaluate(dsc::hooks::Range range, std::span<dsc::Vec3> out) const override {
        if (now_ && params_.fault == Fault::throws) throw std::runtime_error("division by zero");
        if (now_ && params_.fault == Fault::exits) std::exit(0);
        if (now_ && params_.fault == Fault::quick_exits) std::quick_exit(0);
        if (now_ && params_.fault == Fault::ends) std::_Exit(0);
        if (now_ && params_.fault == Fault::prints) {
            std::puts("** C **");
            std::cout << "** C++ **" << std::endl;
        }
        for (std::size_t i = 0; i < out.size(); ++i) {
            out[i] = -0.01 * surface_->positions[range.begin + i];
            const bool bad = now_ && params_.fault == Fault::nan && range.begin + i == 7;
            if (bad) out[i].y() = std::numeric_limits<double>::quiet_NaN();
        }
        // One entry behind its last: the memory of whoever calls, if nobody takes care.
        if (now_ && params_.fault == Fault::outside) out.data()[out.size()] = dsc::Vec3::Zero();
    }

private:
    Params params_;
    bool now_ = false;
    const dsc::surface::SurfaceView* surface_ = nullptr;
};

}  // namespace

DSC_PLUGIN("faulty", "0.3.0", "BSD-3-Clause", "A velocity that misbehaves on demand") {
    registrar.add<Faulty>("faulty", "inwards, with a fault in one step");
}
