// Loads well; its strategies fail later.
#include <limits>
#include <stdexcept>

#include "velocity.hpp"

namespace {

class Refusing final : public dsc::hooks::VelocityField {
public:
    struct Params {};
    static void declare(dsc::config::ParamSchema<Params>&) {}
    Refusing(const Params&, const dsc::plugin::Setup&) {
        throw std::runtime_error("no table for this machine");
    }
    void prepare(const dsc::hooks::StepContext&) override {}
    void evaluate(dsc::hooks::Range, std::span<dsc::Vec3>) const override {}
};

class NotANumber final : public dsc::hooks::VelocityField {
public:
    struct Params {};
    static void declare(dsc::config::ParamSchema<Params>&) {}
    NotANumber(const Params&, const dsc::plugin::Setup&) {}
    void prepare(const dsc::hooks::StepContext&) override {}
    void evaluate(dsc::hooks::Range range, std::span<dsc::Vec3> out) const override {
        for (std::size_t i = 0; i < out.size(); ++i) {
            const double z = range.begin + i == 7 ? std::numeric_limits<double>::quiet_NaN() : 0.0;
            out[i] = dsc::Vec3(0.5, 0, z);
        }
    }
};

// A type of its own, known to nobody else.
struct Grumble : std::runtime_error {
    using std::runtime_error::runtime_error;
};

class Throwing final : public dsc::hooks::VelocityField {
public:
    struct Params {};
    static void declare(dsc::config::ParamSchema<Params>&) {}
    Throwing(const Params&, const dsc::plugin::Setup&) {}
    void prepare(const dsc::hooks::StepContext&) override {}
    void evaluate(dsc::hooks::Range, std::span<dsc::Vec3>) const override {
        throw Grumble("the matrix is singular");
    }
};

}  // namespace

DSC_PLUGIN("bad_constructor", "0.9.0", "MIT", "Strategies that fail when they are used") {
    registrar.add<Refusing>("refusing", "throws in its constructor");
    registrar.add<NotANumber>("not_a_number", "gives NaN to vertex 7");
    registrar.add<Throwing>("throwing", "throws in evaluate");
}
