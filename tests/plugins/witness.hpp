#pragma once
// What the witnesses of `dsc plugin check` have in common: strategies without a fault, of which
// each witness changes the one thing that its test asks for. The id of a witness is that of its
// test, with an underscore for the point, and a word of its own where a test has several.

#include <dsc/plugin/plugin.hpp>

namespace witness {

/// Along the normals. `Fault` derives from it and overrides what it does wrong.
class Velocity : public dsc::hooks::VelocityField {
public:
    struct Params {};
    static void declare(dsc::config::ParamSchema<Params>&) {}
    Velocity() = default;
    Velocity(const Params&, const dsc::plugin::Setup&) {}

    void prepare(const dsc::hooks::StepContext& context) override { context_ = &context; }
    void evaluate(dsc::hooks::Range range, std::span<dsc::Vec3> out) const override {
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = displacement(range.begin + i);
    }

protected:
    virtual dsc::Vec3 displacement(std::size_t vertex) const {
        return 0.1 * context().surface.mean_edge * context().surface.normals[vertex];
    }
    const dsc::hooks::StepContext& context() const { return *context_; }
    /// True on the surface and cloud that most tests use, and on no hostile one.
    bool ordinary() const { return context().cloud != nullptr && context().cloud->size() > 1200; }

private:
    const dsc::hooks::StepContext* context_ = nullptr;
};

/// Along the normals, multiplied by a factor for the whole step.
class Timed : public Velocity {
public:
    using Velocity::Velocity;
    void prepare(const dsc::hooks::StepContext& context) override {
        Velocity::prepare(context);
        factor_ = factor();
    }

protected:
    virtual double factor() const = 0;
    dsc::Vec3 displacement(std::size_t vertex) const override {
        return factor_ * Velocity::displacement(vertex);
    }

private:
    double factor_ = 1.0;
};

/// The same with a parameter.
class Gained : public Velocity {
public:
    struct Params {
        double gain = 0.5;
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.real("gain", &Params::gain)
            .range(0, 1, "dimensionless")
            .doc("How far along the normals.");
    }
    Gained(const Params& params, const dsc::plugin::Setup&) : gain_(params.gain) {}

protected:
    dsc::Vec3 displacement(std::size_t vertex) const override {
        return gain_ * Velocity::displacement(vertex);
    }
    double gain() const { return gain_; }

private:
    double gain_;
};

}  // namespace witness
