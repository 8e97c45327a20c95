// Witnesses of in.bounds: reads beyond the end of an input.
#include "witness.hpp"

namespace {

using witness::Velocity;

// The sum over one entry too many; what is read does not change the answer.
class Positions final : public Velocity {
    using Velocity::Velocity;
    dsc::Vec3 displacement(std::size_t vertex) const override {
        const auto& positions = context().surface.positions;
        const dsc::Vec3& next = positions.data()[vertex + 1];
        return (next.x() == 12345.678 ? 1.0 : 2.0) * Velocity::displacement(vertex);
    }
};

// The same, and the answer depends on what is read: it looks like a random answer.
class Random final : public Velocity {
    using Velocity::Velocity;
    dsc::Vec3 displacement(std::size_t vertex) const override {
        const auto& normals = context().surface.normals;
        return Velocity::displacement(vertex) + 1e-3 * normals.data()[vertex + 1];
    }
};

class Faces final : public Velocity {
public:
    using Velocity::Velocity;
    void prepare(const dsc::hooks::StepContext& context) override {
        Velocity::prepare(context);
        const auto& faces = context.surface.faces;
        if (faces.empty()) return;
        std::uint32_t largest = 0;
        for (std::size_t f = 0; f <= faces.size(); ++f)
            largest = std::max(largest, faces.data()[f][0]);
        largest_ = largest;
    }

private:
    volatile std::uint32_t largest_ = 0;
};

class CloudPoints final : public Velocity {
public:
    using Velocity::Velocity;
    void prepare(const dsc::hooks::StepContext& context) override {
        Velocity::prepare(context);
        if (!ordinary()) return;
        double sum = 0;
        for (std::size_t i = 0; i <= context.cloud->size(); ++i)
            sum += context.cloud->points().data()[i].x();
        sum_ = sum;
    }

private:
    volatile double sum_ = 0;
};

}  // namespace

DSC_PLUGIN("bad_reads", "1.0.0", "MIT", "Witnesses of in.bounds") {
    registrar.add<Positions>("in_bounds", "reads one position too many");
    registrar.add<Random>("in_bounds_random", "uses one normal too many");
    registrar.add<Faces>("in_bounds_faces", "reads one face too many");
    registrar.add<CloudPoints>("in_bounds_cloud", "reads one point of the cloud too many");
}
