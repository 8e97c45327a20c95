// Witnesses of long.*: what goes wrong after many steps.
#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "witness.hpp"

namespace {

using witness::Velocity;

class LaterNaN final : public Velocity {
    using Velocity::Velocity;
    dsc::Vec3 displacement(std::size_t vertex) const override {
        return std::sqrt(30.5 - static_cast<double>(context().step)) *
               Velocity::displacement(vertex);
    }
};

class LaterThrow final : public Velocity {
public:
    using Velocity::Velocity;
    void prepare(const dsc::hooks::StepContext& context) override {
        Velocity::prepare(context);
        if (context.step > 40) throw std::out_of_range("the table ends at 40");
    }
};

class Incomplete final : public Velocity {
public:
    using Velocity::Velocity;
    void evaluate(dsc::hooks::Range range, std::span<dsc::Vec3> out) const override {
        for (std::size_t i = 0; i < out.size(); ++i) {
            if (context().step < 20 || range.begin + i != 3) out[i] = displacement(range.begin + i);
        }
    }
};

// Keeps the surface of every step.
class Collector final : public Velocity {
public:
    using Velocity::Velocity;
    void advance(const dsc::hooks::StepContext& context) override {
        all_.push_back(context.surface.positions);
    }

private:
    std::vector<std::vector<dsc::Vec3>> all_;
};

}  // namespace

DSC_PLUGIN("bad_long", "1.0.0", "MIT", "Witnesses of long.*") {
    registrar.add<LaterNaN>("long_steps", "takes the root of what becomes negative");
    registrar.add<LaterThrow>("long_steps_throw", "has a table that ends");
    registrar.add<Incomplete>("long_steps_incomplete", "leaves an entry out, later");
    registrar.add<Collector>("long_memory", "keeps every surface");
}
