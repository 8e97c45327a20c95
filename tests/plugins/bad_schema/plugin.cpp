// A parameter without a word about it.
#include "velocity.hpp"

namespace {

class Silent final : public dsc::hooks::VelocityField {
public:
    struct Params {
        double mystery = 1.0;
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.real("mystery", &Params::mystery);
    }
    Silent(const Params&, const dsc::plugin::Setup&) {}
    void prepare(const dsc::hooks::StepContext&) override {}
    void evaluate(dsc::hooks::Range, std::span<dsc::Vec3>) const override {}
};

}  // namespace

DSC_PLUGIN("bad_schema", "1.0.0", "MIT", "Declares a parameter without doc") {
    registrar.add<Silent>("silent", "says nothing");
}
