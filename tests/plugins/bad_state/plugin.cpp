// Witnesses of state.*, geo.rigid and err.throw: what is remembered, and what should not be known.
#include <istream>
#include <ostream>
#include <stdexcept>

#include "witness.hpp"

namespace {

using witness::Velocity;

class Forgetful : public Velocity {
public:
    using Velocity::Velocity;
    void prepare(const dsc::hooks::StepContext& context) override {
        Velocity::prepare(context);
        ++steps_;
    }

protected:
    dsc::Vec3 displacement(std::size_t vertex) const override {
        return steps_ * Velocity::displacement(vertex);
    }
    int steps_ = 0;
};

class Credulous final : public Forgetful {
public:
    using Forgetful::Forgetful;
    void save(std::ostream& out) const override { out << steps_ << "\n"; }
    void load(std::istream& in) override { in >> steps_; }
};

class Upwards final : public Velocity {
    using Velocity::Velocity;
    dsc::Vec3 displacement(std::size_t vertex) const override {
        return Velocity::displacement(vertex) + dsc::Vec3(0, 0, 0.01);
    }
};

// Notes that it is busy, and never that it has failed.
class Locked final : public Velocity {
public:
    using Velocity::Velocity;
    void prepare(const dsc::hooks::StepContext& context) override {
        if (busy_) throw std::runtime_error("busy");
        busy_ = true;
        if (context.surface.vertex_count() == 0) throw std::runtime_error("no surface");
        Velocity::prepare(context);
        busy_ = false;
    }

private:
    bool busy_ = false;
};

}  // namespace

DSC_PLUGIN("bad_state", "1.0.0", "MIT", "Witnesses of state.*, geo.rigid and err.throw") {
    registrar.add<Forgetful>("state_roundtrip", "has a state and does not save it");
    registrar.add<Credulous>("state_bad", "reads anything as its state");
    registrar.add<Upwards>("geo_rigid", "knows where up is");
    registrar.add<Locked>("err_throw", "is out of order after an exception");
}
