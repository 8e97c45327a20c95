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
    void advance(const dsc::hooks::StepContext&) override { ++steps_; }

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

// Saves and loads as it should, but counts its steps where they are not to be counted.
class Impatient final : public Velocity {
public:
    using Velocity::Velocity;
    void prepare(const dsc::hooks::StepContext& context) override {
        Velocity::prepare(context);
        ++prepared_;
    }
    void save(std::ostream& out) const override { out << prepared_ << "\n"; }
    void load(std::istream& in) override {
        if (!(in >> prepared_)) throw std::runtime_error("no state");
    }

protected:
    dsc::Vec3 displacement(std::size_t vertex) const override {
        return prepared_ * Velocity::displacement(vertex);
    }

private:
    int prepared_ = 0;
};

class Upwards final : public Velocity {
    using Velocity::Velocity;
    dsc::Vec3 displacement(std::size_t vertex) const override {
        return Velocity::displacement(vertex) + dsc::Vec3(0, 0, 0.1 * context().surface.mean_edge);
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
    registrar.add<Impatient>("state_prepare", "goes on where it should only prepare");
    registrar.add<Upwards>("geo_rigid", "knows where up is");
    registrar.add<Locked>("err_throw", "is out of order after an exception");
}
