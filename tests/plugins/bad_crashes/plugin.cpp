// Crashes inside a call, which the report names with the signal and the call.
#include <cstdlib>

#include "witness.hpp"

namespace {

using witness::Velocity;

// Without a cloud, a null pointer is used.
class NoCloud final : public Velocity {
    using Velocity::Velocity;
    dsc::Vec3 displacement(std::size_t vertex) const override {
        const volatile std::size_t size = context().cloud->size();
        static_cast<void>(size);
        return Velocity::displacement(vertex);
    }
};

class Aborts final : public Velocity {
public:
    using Velocity::Velocity;
    void prepare(const dsc::hooks::StepContext& context) override {
        Velocity::prepare(context);
        if (context.surface.face_count() == 0) std::abort();
    }
};

// The number of faces per vertex, of no vertices.
class Divides final : public Velocity {
public:
    using Velocity::Velocity;
    void prepare(const dsc::hooks::StepContext& context) override {
        Velocity::prepare(context);
        const volatile std::size_t vertices = context.surface.vertex_count();
        faces_ = context.surface.face_count() / vertices;
    }

private:
    volatile std::size_t faces_ = 0;
};

class Leaves final : public Velocity {
public:
    using Velocity::Velocity;
    void prepare(const dsc::hooks::StepContext& context) override {
        Velocity::prepare(context);
        if (context.surface.face_count() == 0) std::exit(0);
    }
};

class Always final : public Velocity {
public:
    using Velocity::Velocity;
    void advance(const dsc::hooks::StepContext&) override { std::abort(); }
};

}  // namespace

DSC_PLUGIN("bad_crashes", "1.0.0", "MIT", "Crashes inside a call") {
    registrar.add<NoCloud>("no_cloud", "uses a null pointer without a cloud");
    registrar.add<Aborts>("aborts", "aborts without a surface");
    registrar.add<Divides>("divides", "divides by zero without a surface");
    registrar.add<Leaves>("leaves", "ends the process without a surface");
    registrar.add<Always>("always", "aborts in its first call");
}
