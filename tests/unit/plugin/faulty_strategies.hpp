#pragma once
// Strategies of all kinds with faults that a test chooses, to see how they are reported.
#include <functional>
#include <limits>
#include <sstream>

#include <dsc/base/error.hpp>
#include <dsc/base/random.hpp>
#include <dsc/plugin/guarded.hpp>

#include "fake_catalogue.hpp"

namespace faulty {

using dsc::Vec3;
namespace hooks = dsc::hooks;
namespace mesh = dsc::mesh;
namespace repair = dsc::repair;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

// Each test says what its strategy does.
template <class... Arguments>
struct Behaviour {
    static inline std::function<void(Arguments...)> act;
};

template <class Hook>
struct Base : Hook {
    struct Params {};
    static void declare(dsc::config::ParamSchema<Params>&) {}
};

struct Velocity final : Base<hooks::VelocityField> {
    using Act = Behaviour<hooks::Range, std::span<Vec3>>;
    Velocity(const Params&, const dsc::plugin::Setup&) {}
    void prepare(const hooks::StepContext&) override {}
    void evaluate(hooks::Range range, std::span<Vec3> out) const override { Act::act(range, out); }
    void save(std::ostream&) const override { throw std::runtime_error("disk full"); }
    static inline hooks::Attributes attributes;
    void publish(hooks::Attributes& out) const override { out = attributes; }
    void advance(const hooks::StepContext& context) override {
        if (context.step == 13) throw std::runtime_error("unlucky");
    }
};

struct Sampled final : Base<hooks::VelocityField> {
    using Act = Behaviour<std::span<const Vec3>, std::span<Vec3>>;
    Sampled(const Params&, const dsc::plugin::Setup&) {}
    void prepare(const hooks::StepContext&) override {}
    void evaluate(hooks::Range, std::span<Vec3>) const override {}
    bool can_sample() const override { return true; }
    void sample(std::span<const Vec3> points, std::span<const Vec3>,
                std::span<Vec3> out) const override {
        Act::act(points, out);
    }
};

struct Curvature final : Base<hooks::CurvatureEstimator> {
    using Act = Behaviour<std::span<double>, std::span<Vec3>>;
    Curvature(const Params&, const dsc::plugin::Setup&) {}
    void prepare(const hooks::StepContext&) override {}
    void evaluate(hooks::Range, std::span<double> scalar, std::span<Vec3> vector) const override {
        Act::act(scalar, vector);
    }
};

struct Filter final : Base<hooks::CloudFilter> {
    using Act = Behaviour<dsc::cloud::Filtered&, const hooks::FilterContext&>;
    Filter(const Params&, const dsc::plugin::Setup&) {}
    // Without a fault: the cloud as it is.
    dsc::cloud::Filtered apply(const dsc::cloud::Cloud& cloud,
                               const hooks::FilterContext& context) override {
        dsc::cloud::Filtered result{cloud, {}};
        result.report.kept = cloud.points.size();
        Act::act(result, context);
        return result;
    }
};

struct Refinement final : Base<hooks::RefinementPolicy> {
    using Act = Behaviour<hooks::RefinementRequests&>;
    Refinement(const Params&, const dsc::plugin::Setup&) {}
    void refine(const hooks::RefinementContext&, hooks::RefinementRequests& out) override {
        Act::act(out);
    }
};

struct InitialMesh final : Base<hooks::InitialMesh> {
    using Act = Behaviour<mesh::TetMesh&>;
    InitialMesh(const Params&, const dsc::plugin::Setup&) {}
    mesh::TetMesh build(const hooks::InitialMeshContext&) override {
        mesh::TetMesh one{
            {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}, {{0, 1, 2, 3}}, {1}};
        Act::act(one);
        return one;
    }
    static inline hooks::Figures told;
    hooks::Figures figures() const override { return told; }
};

struct Improvement final : Base<hooks::Improvement> {
    using Act = Behaviour<std::vector<repair::Request>&>;
    using Select = Behaviour<std::span<std::uint8_t>>;
    static inline double cosine = 0.99;
    static inline repair::TopologyLimits limits;
    static inline std::vector<std::string> classes;
    Improvement(const Params&, const dsc::plugin::Setup&) {}
    void propose(const hooks::StepContext&, const repair::RepairRound&,
                 std::vector<repair::Request>& out) override {
        Act::act(out);
    }
    double flatness() const override { return cosine; }
    repair::TopologyLimits topology_limits() const override { return limits; }
    std::vector<std::string> repair_classes() const override { return classes; }
    void select(const hooks::StepContext&, std::span<const repair::TopologyCandidate>,
                std::span<std::uint8_t> accept) override {
        Select::act(accept);
    }
};

struct Observer final : Base<hooks::Observer> {
    using Act = Behaviour<hooks::Figures&>;
    Observer(const Params&, const dsc::plugin::Setup&) {}
    void begin(const hooks::StepContext&) override {}
    hooks::Figures step(const hooks::StepContext&, const hooks::StepFigures&) override {
        return figures();
    }
    hooks::Figures end(const hooks::StepContext&) override { return figures(); }
    static hooks::Figures figures() {
        hooks::Figures result;
        Act::act(result);
        return result;
    }
};

// A velocity that calls the curvature `faulty` and lets its fault pass.
struct Nesting final : Base<hooks::VelocityField> {
    Nesting(const Params&, const dsc::plugin::Setup& setup)
        : inner(setup.create<hooks::CurvatureEstimator>("curvature", {"faulty", {}})) {}
    void prepare(const hooks::StepContext& context) override { inner->prepare(context); }
    void evaluate(hooks::Range range, std::span<Vec3> out) const override {
        std::vector<double> scalar(out.size());
        inner->evaluate(range, scalar, out);
    }
    std::unique_ptr<hooks::CurvatureEstimator> inner;
};

struct Bench {
    Bench() {
        catalogue.add<Velocity>("faulty", "a velocity");
        catalogue.add<Sampled>("sampled", "a velocity");
        catalogue.add<Nesting>("nesting", "a velocity");
        catalogue.add<Curvature>("faulty", "a curvature");
        catalogue.add<Refinement>("faulty", "a refinement");
        catalogue.add<InitialMesh>("faulty", "an initial mesh");
        catalogue.add<Improvement>("faulty", "an improvement");
        catalogue.add<Observer>("faulty", "an observer");
        catalogue.add<Filter>("faulty", "a filter");
        view.vertex_ids = {0, 1, 2, 3};
        view.births = {10, 11, 12, 13};
        view.positions = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
        view.faces = {{0, 1, 2}, {0, 1, 3}};
    }
    template <class Hook>
    std::unique_ptr<Hook> make(const char* id = "faulty") const {
        return catalogue.create<Hook>({id, {}}, "here");
    }
    hooks::StepContext context() const {
        return {.step = 5, .surface = view, .box = {}, .to_normalised = {}};
    }

    FakeCatalogue catalogue;
    dsc::surface::SurfaceView view;
};

struct Caught {
    std::string code;
    std::string text;
};
template <class Body>
Caught caught(Body&& body) {
    try {
        body();
    } catch (const dsc::StrategyError& error) {
        return {error.code(), error.what()};
    }
    return {};
}

inline std::string who(const std::string& kind, const std::string& id = "faulty",
                       const std::string& path = "here") {
    return kind + " '" + id + "' (plugin fake 0.1.0, libdsc_fake.so, at '" + path +
           "' in the experiment): ";
}
inline const std::string report = "; report this to the plugin's authors";

}  // namespace faulty
