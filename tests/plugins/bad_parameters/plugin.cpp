// Witnesses of schema.* and param.*: declarations that do not hold.
#include <cstdlib>
#include <limits>
#include <stdexcept>

#include "witness.hpp"

namespace {

using dsc::config::ParamSchema;
using witness::Gained;

class Furlongs final : public Gained {
public:
    using Gained::Gained;
    static void declare(ParamSchema<Params>& schema) {
        schema.real("gain", &Params::gain)
            .range(0, 1, "furlongs")
            .doc("How far along the normals.");
    }
};

class RefusesItself final : public Gained {
public:
    using Gained::Gained;
    static void declare(ParamSchema<Params>& schema) {
        Gained::declare(schema);
        schema.check([](const Params& p) { return p.gain > 0.9; }, "the gain is above 0.9");
    }
};

class ThrowingCheck final : public Gained {
public:
    using Gained::Gained;
    static void declare(ParamSchema<Params>& schema) {
        Gained::declare(schema);
        schema.check(
            [](const Params& p) {
                if (p.gain == 1.0) throw std::runtime_error("no gain without pain");
                return true;
            },
            "the gain is below 1");
    }
};

// Every value-initialised struct has another default than the one before.
class MovingDefault final : public witness::Velocity {
public:
    struct Params {
        Params() {
            static int made = 0;
            gain = 0.001 * (++made % 500);
        }
        double gain;
    };
    static void declare(ParamSchema<Params>& schema) {
        schema.real("gain", &Params::gain)
            .range(0, 1, "dimensionless")
            .doc("How far along the normals.");
    }
    MovingDefault(const Params& params, const dsc::plugin::Setup&) : gain_(params.gain) {}

private:
    dsc::Vec3 displacement(std::size_t vertex) const override {
        return gain_ * Velocity::displacement(vertex);
    }
    double gain_;
};

class BreaksAtTheEnd final : public Gained {
public:
    BreaksAtTheEnd(const Params& params, const dsc::plugin::Setup& setup) : Gained(params, setup) {
        if (params.gain == 1.0) std::abort();
    }
};

class BreaksInTheMiddle final : public Gained {
    using Gained::Gained;
    dsc::Vec3 displacement(std::size_t vertex) const override {
        const bool bad = gain() > 0.55 && gain() < 0.95;
        return bad ? dsc::Vec3::Constant(std::numeric_limits<double>::quiet_NaN())
                   : Gained::displacement(vertex);
    }
};

}  // namespace

DSC_PLUGIN("bad_parameters", "1.0.0", "MIT", "Witnesses of schema.* and param.*") {
    registrar.add<Furlongs>("schema_lint", "a unit that nobody knows");
    registrar.add<RefusesItself>("schema_roundtrip", "refuses its own defaults");
    registrar.add<ThrowingCheck>("schema_reject", "throws while its parameters are judged");
    registrar.add<MovingDefault>("param_default", "has another default each time");
    registrar.add<BreaksAtTheEnd>("param_bounds", "crashes at the end of a range");
    registrar.add<BreaksInTheMiddle>("param_fuzz", "has no answer in the middle of a range");
}
