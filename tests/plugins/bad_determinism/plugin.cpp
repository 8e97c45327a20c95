// Witnesses of det.* and seed.used: answers that depend on what they must not depend on.
#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>

#include "witness.hpp"

namespace {

using witness::Velocity;

class Dice final : public Velocity {
public:
    Dice(const Params&, const dsc::plugin::Setup&) : factor_(1.0 + 1e-6 * std::random_device{}()) {}

private:
    dsc::Vec3 displacement(std::size_t vertex) const override {
        return factor_ * Velocity::displacement(vertex);
    }
    double factor_;
};

class BlockDependent final : public Velocity {
public:
    using Velocity::Velocity;
    void evaluate(dsc::hooks::Range range, std::span<dsc::Vec3> out) const override {
        Velocity::evaluate(range, out);
        if (!out.empty()) out[0] *= 2;
    }
};

// Remembers in a static what another instance has seen.
class Shared final : public Velocity {
public:
    using Velocity::Velocity;
    void prepare(const dsc::hooks::StepContext& context) override {
        Velocity::prepare(context);
        static double last_edge = 0;
        const double edge = context.surface.mean_edge;
        factor_ = last_edge > 0 && std::abs(last_edge / edge - 1) > 0.1 ? 2.0 : 1.0;
        last_edge = edge;
    }

private:
    dsc::Vec3 displacement(std::size_t vertex) const override {
        return factor_ * Velocity::displacement(vertex);
    }
    double factor_ = 1;
};

class IndexDependent final : public Velocity {
    using Velocity::Velocity;
    dsc::Vec3 displacement(std::size_t vertex) const override {
        return (1.0 + 0.01 * static_cast<double>(vertex)) * Velocity::displacement(vertex);
    }
};

// Goes through a text, which the locale writes in its own way.
class LocaleDependent final : public Velocity {
public:
    using Velocity::Velocity;
    void prepare(const dsc::hooks::StepContext& context) override {
        Velocity::prepare(context);
        std::ostringstream text;
        text << 0.5;
        factor_ = std::stod(text.str());
    }

private:
    dsc::Vec3 displacement(std::size_t vertex) const override {
        return factor_ * Velocity::displacement(vertex);
    }
    double factor_ = 1;
};

// Has no fault: it finds a vertex by its birth id, because those of a view ascend.
class ByBirth final : public Velocity {
    using Velocity::Velocity;
    dsc::Vec3 displacement(std::size_t vertex) const override {
        const auto& births = context().surface.births;
        const auto found = std::lower_bound(births.begin(), births.end(), births[vertex]);
        if (found == births.end() || *found != births[vertex])
            throw std::runtime_error("the birth ids do not ascend");
        return Velocity::displacement(static_cast<std::size_t>(found - births.begin()));
    }
};

class SecretlyRandom final : public Velocity {
    using Velocity::Velocity;
    dsc::Vec3 displacement(std::size_t vertex) const override {
        return (1.0 + context().random(context().surface.births[vertex]).uniform()) *
               Velocity::displacement(vertex);
    }
};

}  // namespace

DSC_PLUGIN("bad_determinism", "1.0.0", "MIT", "Witnesses of det.* and seed.used") {
    registrar.add<Dice>("det_repeat", "throws dice of its own");
    registrar.add<BlockDependent>("det_threads", "knows where a block begins");
    registrar.add<Shared>("det_instances", "has a static variable");
    registrar.add<IndexDependent>("det_order", "knows the place of a vertex in the list");
    registrar.add<LocaleDependent>("det_env", "writes and reads numbers by the locale");
    registrar.add<ByBirth>("by_birth", "finds vertices by their birth ids");
    registrar.add<SecretlyRandom>("seed_used", "is random and does not say so");
}
