// Witnesses of out.*: answers that are wrong, missing or in the wrong place.
#include <cstdio>
#include <iostream>
#include <limits>

#include "witness.hpp"

namespace {

using witness::Velocity;

class NotFinite final : public Velocity {
    using Velocity::Velocity;
    dsc::Vec3 displacement(std::size_t vertex) const override {
        const bool bad = ordinary() && vertex == 7;
        return bad ? dsc::Vec3(0, std::numeric_limits<double>::infinity(), 0)
                   : Velocity::displacement(vertex);
    }
};

class Incomplete final : public Velocity {
public:
    using Velocity::Velocity;
    void evaluate(dsc::hooks::Range range, std::span<dsc::Vec3> out) const override {
        for (std::size_t i = 0; i < out.size(); ++i) {
            if (ordinary() && range.begin + i == 7) continue;
            out[i] = displacement(range.begin + i);
        }
    }
};

class Overrun final : public Velocity {
public:
    using Velocity::Velocity;
    void evaluate(dsc::hooks::Range range, std::span<dsc::Vec3> out) const override {
        Velocity::evaluate(range, out);
        if (ordinary()) out.data()[out.size()] = dsc::Vec3::Zero();
    }
};

class Meddler final : public Velocity {
public:
    using Velocity::Velocity;
    void prepare(const dsc::hooks::StepContext& context) override {
        Velocity::prepare(context);
        if (ordinary()) const_cast<dsc::Vec3&>(context.surface.positions[0]) *= 1.5;
    }
};

class Chatterbox final : public Velocity {
public:
    using Velocity::Velocity;
    void prepare(const dsc::hooks::StepContext& context) override {
        Velocity::prepare(context);
        std::puts("here I am");
    }
};

class Streams final : public Velocity {
public:
    using Velocity::Velocity;
    void prepare(const dsc::hooks::StepContext& context) override {
        Velocity::prepare(context);
        std::cout << "step " << context.step << "\n";
    }
};

class PrintsInEvaluate final : public Velocity {
public:
    using Velocity::Velocity;
    void evaluate(dsc::hooks::Range range, std::span<dsc::Vec3> out) const override {
        Velocity::evaluate(range, out);
        std::printf("vertices from %zu\n", range.begin);
    }
};

class Short final : public Velocity {
public:
    using Velocity::Velocity;
    void publish(dsc::hooks::Attributes& out) const override {
        const std::size_t vertices = context().surface.vertex_count();
        out.push_back({"density", std::vector<double>(ordinary() ? vertices - 1 : vertices, 1.0)});
    }
};

}  // namespace

DSC_PLUGIN("bad_output", "1.0.0", "MIT", "Witnesses of out.*") {
    registrar.add<NotFinite>("out_finite", "an infinite displacement");
    registrar.add<Incomplete>("out_complete", "leaves an entry out");
    registrar.add<Overrun>("out_bounds", "writes one entry too many");
    registrar.add<Meddler>("out_const", "changes the surface");
    registrar.add<Short>("out_attributes", "an attribute with one value too few");
    registrar.add<Chatterbox>("out_quiet", "prints");
    registrar.add<Streams>("out_quiet_stream", "writes to std::cout");
    registrar.add<PrintsInEvaluate>("out_quiet_evaluate", "prints in evaluate()");
}
