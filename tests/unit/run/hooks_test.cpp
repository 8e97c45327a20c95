// What the simulation promises strategies: how often it calls them, what they receive, and what
// becomes of what they publish.
#include <cmath>
#include <map>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/io/series.hpp>
#include <dsc/run/measure.hpp>
#include <dsc/run/run_experiment.hpp>
#include <dsc/run/simulation.hpp>

#include "fakes.hpp"

using namespace dsc;
using dsc::test::load_text;
using dsc::test::minimal;

namespace {

// Counts its calls. The first steps move everything, the later ones nothing; it is done after
// `last` steps.
class Staged final : public hooks::VelocityField {
public:
    explicit Staged(std::uint64_t last) : last_(last) {}
    void advance(const hooks::StepContext& context) override {
        ++advances;
        wrong += context.step == advances ? 0 : 1;
        wrong += context.planned_steps == last_ ? 0 : 1;
        order += 'a';
    }
    void prepare(const hooks::StepContext& context) override {
        surface_ = &context.surface;
        order += 'p';
    }
    void evaluate(hooks::Range range, std::span<Vec3> out) const override {
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = -0.01 * surface_->positions[range.begin + i];
    }
    bool can_sample() const override { return true; }
    void sample(std::span<const Vec3>, std::span<const Vec3>, std::span<Vec3> out) const override {
        std::fill(out.begin(), out.end(), Vec3::Zero());
    }
    void publish(hooks::Attributes& out) const override {
        std::vector<double> heights;
        for (const Vec3& p : surface_->positions) heights.push_back(p.z() + 10.0);
        out.push_back({"height", heights});
    }
    bool finished() const override { return advances >= last_; }
    std::uint64_t planned_steps() const override { return last_; }
    void save(std::ostream& out) const override { out << advances << "\n"; }
    void load(std::istream& in) override { in >> advances; }

    std::uint64_t advances = 0;
    std::size_t wrong = 0;
    std::string order;

private:
    const surface::SurfaceView* surface_ = nullptr;
    std::uint64_t last_;
};

// Splits the longest edge in each of its first passes, and says how long edges shall be.
class Remesher final : public hooks::RefinementPolicy {
public:
    bool sampling = false, owns = false;
    unsigned most = 1, wanted = 0;
    double length = 0.0;
    std::vector<unsigned> passes_seen;
    std::size_t with_velocity = 0, with_height = 0, vertices = 0, grown = 0;
    std::vector<double> lengths_seen;

    bool needs_sampling() const override { return sampling; }
    bool owns_sizing() const override { return owns; }
    unsigned passes() const override { return most; }
    void refine(const hooks::RefinementContext& context, hooks::RefinementRequests& out) override {
        const surface::SurfaceView& view = context.step.surface;
        passes_seen.push_back(context.pass);
        with_velocity += context.velocity != nullptr ? 1 : 0;
        with_height +=
            !context.step.attributes.empty() && context.step.attributes[0].name == "height" ? 1 : 0;
        grown += view.vertex_count() > vertices ? 1 : 0;
        vertices = view.vertex_count();
        lengths_seen.push_back(context.step.target_length);
        if (length > 0.0) out.target_length = length;
        if (context.pass < wanted) out.split_faces.push_back(context.pass);
    }
};

struct Fixture {
    run::LoadedExperiment loaded;
    run::Strategies strategies;
    Staged* velocity;
    Remesher* refinement = nullptr;
    explicit Fixture(const std::string& schedule, std::uint64_t last = 3)
        : loaded(load_text(minimal, {"schedule=" + schedule})) {
        static const dsc::test::Strategies catalogue;
        strategies = run::make_strategies(loaded.experiment, catalogue);
        auto staged = std::make_unique<Staged>(last);
        velocity = staged.get();
        strategies.velocity = std::move(staged);
        for (auto& r : strategies.refinements) {
            if (!r) continue;
            auto remesher = std::make_unique<Remesher>();
            refinement = remesher.get();
            r = std::move(remesher);
        }
    }
    run::SimulationResult simulate(const run::SimulationOptions& options = {}) {
        return run::simulate(loaded.experiment, strategies, nullptr, options);
    }
};

}  // namespace

TEST_CASE(
    "advance runs once per step, and only a refinement that samples prepares the velocity again") {
    for (const bool sampling : {false, true}) {
        Fixture f("[{refine: {type: all}}, {steps: 3, every: 1, refine: {type: all}}]");
        for (auto& r : f.strategies.refinements) static_cast<Remesher&>(*r).sampling = sampling;
        f.simulate();
        CHECK(f.velocity->advances == 3);
        CHECK(f.velocity->wrong == 0);
        CHECK(f.velocity->order == (sampling ? "pappappapp" : "apapap"));
        CHECK(f.refinement->with_velocity == (sampling ? 3 : 0));
    }
}

TEST_CASE("until: finished ends a series as converged, and belongs to one with steps") {
    Fixture f("[{steps: 9, until: finished}, {steps: 2}]");
    const run::SimulationResult result = f.simulate();
    CHECK(result.totals.steps == 5);
    Fixture g("[{steps: 9, until: finished}]");
    CHECK(g.simulate().totals.status == run::Status::converged);
    Fixture h("[{steps: 2, until: finished}]");
    CHECK(h.simulate().totals.status == run::Status::max_steps);
    Fixture deaf("[{steps: 9}]");
    CHECK(deaf.simulate().totals.steps == 9);
    CHECK_THROWS_AS(load_text(minimal, {"schedule=[{refine: {type: all}, until: finished}]"}),
                    ConfigError);
    CHECK_THROWS_AS(load_text(minimal, {"schedule=[{steps: 2, until: tomorrow}]"}), ConfigError);
}

TEST_CASE(
    "a refinement is called with fresh views until it asks for nothing, or its passes are over") {
    Fixture f("[{refine: {type: all}}]");
    f.refinement->most = 8;
    f.refinement->wanted = 3;
    run::SimulationResult result = f.simulate();
    CHECK(f.refinement->passes_seen == std::vector<unsigned>{0, 1, 2, 3});
    CHECK(f.refinement->grown == 4);
    CHECK(result.totals.refine_committed == 3);
    CHECK(result.totals.refinements == 1);
    Fixture g("[{refine: {type: all}}]");
    g.refinement->most = hooks::refinement_passes;
    g.refinement->wanted = 1000;
    g.simulate();
    CHECK(g.refinement->passes_seen.size() == 32);
    Fixture once("[{refine: {type: all}}]");
    once.refinement->wanted = 1000;
    once.simulate();
    CHECK(once.refinement->passes_seen.size() == 1);
}

TEST_CASE("L is the owner's, or the mean edge after splits") {
    for (const bool owns : {true, false}) {
        Fixture f("[{steps: 3, every: 1, refine: {type: all}}]");
        f.refinement->owns = owns;
        f.refinement->length = 0.4;
        f.refinement->wanted = 1;
        const run::SimulationResult result = f.simulate();
        CHECK((result.totals.target_length == 0.4) == owns);
        REQUIRE(f.refinement->lengths_seen.size() == 3);
        CHECK((f.refinement->lengths_seen[2] == 0.4) == owns);
    }
}

TEST_CASE("where a refinement owns the sizing, steps leave no tet below 0.02; elsewhere they may") {
    for (const bool owns : {true, false}) {
        Fixture f("[{steps: 60, every: 60, refine: {type: all}}]", 60);
        f.refinement->owns = owns;
        const mesh::TetMesh mesh = f.simulate().mesh;
        double least = 1.0;
        for (const auto& [a, b, c, d] : mesh.tets) {
            least = std::min(least, geometry::tet_quality(mesh.points[a], mesh.points[b],
                                                          mesh.points[c], mesh.points[d]));
        }
        CHECK((least >= 0.02) == owns);
    }
}

TEST_CASE("attributes are carried to the end of the run, and a run that was stopped goes on to the "
          "same bytes") {
    const std::string schedule =
        "[{steps: 4, every: 2, refine: {type: all}}, {refine: {type: all}}, {steps: 1}]";
    std::map<std::uint64_t, std::string> states;
    run::SimulationOptions options;
    options.checkpoint_every = 1;
    options.on_checkpoint = [&](std::string state, std::uint64_t steps) {
        states[steps] = std::move(state);
    };
    std::size_t with_attributes = 0;
    options.on_state = [&](const hooks::StepContext& context, const mesh::Complex&) {
        if (context.attributes.empty()) return;
        ++with_attributes;
        CHECK(context.attributes[0].values.size() == context.surface.vertex_count());
    };
    Fixture f(schedule, 4);
    const auto remesh = [](Fixture& fixture) {
        for (auto& r : fixture.strategies.refinements) {
            if (r) static_cast<Remesher&>(*r).wanted = 1;
        }
    };
    remesh(f);
    const run::SimulationResult whole = f.simulate(options);
    CHECK(with_attributes == 5);
    CHECK(f.refinement->with_height == 1);
    REQUIRE(whole.attributes.size() == 1);
    CHECK(whole.attributes[0].name == "height");
    REQUIRE(whole.attributes[0].values.size() == whole.mesh.points.size());
    std::vector<std::uint32_t> vertex_of;
    surface::extract_interface(whole.mesh, &vertex_of);
    std::vector<char> on_surface(whole.mesh.points.size(), 0);
    for (const std::uint32_t v : vertex_of) on_surface[v] = 1;
    std::size_t finite = 0;
    for (std::size_t i = 0; i < on_surface.size(); ++i) {
        const double value = whole.attributes[0].values[i];
        CHECK(std::isnan(value) == (on_surface[i] == 0));
        if (on_surface[i] == 0) continue;
        ++finite;
        // Published a step of 1 % ago; the linear function goes through splits unchanged.
        CHECK(value - 10.0 == doctest::Approx(whole.mesh.points[i].z() / 0.99).epsilon(1e-9));
    }
    CHECK(finite == vertex_of.size());
    for (const std::uint64_t from : {1U, 2U, 3U}) {
        REQUIRE(states.count(from) == 1);
        Fixture resumed(schedule, 4);
        remesh(resumed);
        run::SimulationOptions on;
        on.resume = states[from];
        const run::SimulationResult end = resumed.simulate(on);
        CHECK(end.mesh.points == whole.mesh.points);
        CHECK(std::equal(end.attributes[0].values.begin(), end.attributes[0].values.end(),
                         whole.attributes[0].values.begin(), [](double a, double b) {
                             return a == b || (std::isnan(a) && std::isnan(b));
                         }));
    }
}
