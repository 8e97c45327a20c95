// Witnesses of geo.scale: lengths of their own.
#include <algorithm>

#include "witness.hpp"

namespace {

using witness::Velocity;

class FixedSpeed final : public Velocity {
    using Velocity::Velocity;
    dsc::Vec3 displacement(std::size_t vertex) const override {
        return 0.01 * context().surface.normals[vertex];
    }
};

// Stops where the cloud is nearer than a length of its own.
class FixedTolerance final : public Velocity {
    using Velocity::Velocity;
    dsc::Vec3 displacement(std::size_t vertex) const override {
        const bool near =
            context().cloud != nullptr && context().nearest_point(vertex).distance < 0.05;
        return near ? dsc::Vec3::Zero() : Velocity::displacement(vertex);
    }
};

// The mean of the areas round a vertex, with a term that shall avoid a division by zero.
class FixedTerm final : public dsc::hooks::CurvatureEstimator {
public:
    struct Params {};
    static void declare(dsc::config::ParamSchema<Params>&) {}
    FixedTerm(const Params&, const dsc::plugin::Setup&) {}
    void prepare(const dsc::hooks::StepContext& context) override { surface_ = &context.surface; }
    void evaluate(dsc::hooks::Range range, std::span<double> scalar,
                  std::span<dsc::Vec3> vector) const override {
        for (std::size_t i = 0; i < scalar.size(); ++i) {
            double area = 0;
            for (const std::uint32_t face : surface_->faces_of(range.begin + i))
                area += surface_->face_areas[face];
            scalar[i] = 1.0 / (area + 0.01);
            vector[i] = dsc::Vec3::Zero();
        }
    }

private:
    const dsc::surface::SurfaceView* surface_ = nullptr;
};

class FixedArea final : public dsc::hooks::RefinementPolicy {
public:
    struct Params {};
    static void declare(dsc::config::ParamSchema<Params>&) {}
    FixedArea(const Params&, const dsc::plugin::Setup&) {}
    void refine(const dsc::hooks::RefinementContext& context,
                dsc::hooks::RefinementRequests& out) override {
        const auto& areas = context.step.surface.face_areas;
        for (std::uint32_t face = 0; face < areas.size(); ++face) {
            if (areas[face] > 0.02) out.split_faces.push_back(face);
        }
    }
};

}  // namespace

DSC_PLUGIN("bad_scale", "1.0.0", "MIT", "Witnesses of geo.scale") {
    registrar.add<FixedSpeed>("geo_scale", "moves by a fixed length");
    registrar.add<FixedTolerance>("geo_scale_tolerance", "compares a distance with a fixed length");
    registrar.add<FixedTerm>("geo_scale", "adds a fixed area to an area");
    registrar.add<FixedArea>("geo_scale", "compares an area with a fixed one");
}
