// Witnesses of cancel, leak, thr.race and perf.scale: what is used up.
#include <ctime>

#include "witness.hpp"

namespace {

using witness::Velocity;

double burn(double seconds) {
    double sum = 0;
    const std::clock_t end = std::clock() + static_cast<std::clock_t>(seconds * CLOCKS_PER_SEC);
    while (std::clock() < end) sum += 1;
    return sum;
}

class Deaf final : public Velocity {
public:
    using Velocity::Velocity;
    void prepare(const dsc::hooks::StepContext& context) override {
        Velocity::prepare(context);
        if (context.cancelled()) work_ = burn(3.0);
    }

private:
    double work_ = 0;
};

char* volatile lost = nullptr;

class Leaky final : public Velocity {
public:
    Leaky(const Params&, const dsc::plugin::Setup&) { lost = new char[4096]; }
};

class Racer final : public Velocity {
public:
    using Velocity::Velocity;
    void evaluate(dsc::hooks::Range range, std::span<dsc::Vec3> out) const override {
        Velocity::evaluate(range, out);
        ++calls_;
    }

private:
    mutable int calls_ = 0;
};

class Quadratic final : public Velocity {
public:
    using Velocity::Velocity;
    void prepare(const dsc::hooks::StepContext& context) override {
        Velocity::prepare(context);
        double sum = 0;
        for (const dsc::Vec3& p : context.surface.positions) {
            for (const dsc::Vec3& q : context.surface.positions) sum += (p - q).norm();
        }
        sum_ = sum;
    }

private:
    volatile double sum_ = 0;
};

}  // namespace

DSC_PLUGIN("bad_resources", "1.0.0", "MIT", "Witnesses of cancel, leak, thr.race and perf.scale") {
    registrar.add<Deaf>("cancel", "works on when it is cancelled");
    registrar.add<Leaky>("leak", "loses memory");
    registrar.add<Racer>("thr_race", "counts without a lock");
    registrar.add<Quadratic>("perf_scale", "compares each vertex with each");
}
