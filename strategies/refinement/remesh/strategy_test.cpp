// The whole refinement, through the simulation: requirements for the resulting interface.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/host/host.hpp>
#include <dsc/mesh/adopt.hpp>
#include <dsc/mesh/validate.hpp>
#include <dsc/run/simulation.hpp>
#include <dsc/sdk/surfaces.hpp>

namespace {

using namespace dsc;
using config::ConfigNode;

const host::Host& plugins() {
    static host::Host host;
    static const bool loaded = [] {
        host.load(DSC_TEST_PLUGIN);
        for (const char* name : {"libdsc_dsc.so", "libdsc_grid.so"}) {
            host.load(std::filesystem::path(DSC_TEST_PLUGIN).parent_path() / name);
        }
        return true;
    }();
    CHECK(loaded);
    return host;
}

/// A surface at rest, in a run with a given number of steps.
struct Still final : hooks::VelocityField {
    void prepare(const hooks::StepContext&) override {}
    void evaluate(hooks::Range, std::span<Vec3> out) const override {
        std::fill(out.begin(), out.end(), Vec3::Zero());
    }
};

struct Job {
    ConfigNode start = ConfigNode::map();
    ConfigNode remesh = ConfigNode::map();
    unsigned steps_before = 0;  // number of steps without refinement
    bool refine_at_once = true;
    unsigned steps = 0;  // number of steps with a refinement after each
    const cloud::TargetCloud* cloud = nullptr;
};

run::SimulationResult simulate(const Job& job, const run::SimulationOptions& options = {}) {
    run::Experiment experiment;
    run::Strategies strategies;
    const auto remesher = [&] {
        return plugins().create<hooks::RefinementPolicy>({"remesh", job.remesh},
                                                         "schedule.1.refine");
    };
    const auto add = [&](std::optional<std::uint32_t> steps, bool refined) {
        run::Series item;
        item.steps = steps;
        if (steps && refined) item.every = 1;
        experiment.schedule.push_back(item);
        strategies.refinements.push_back(refined ? remesher() : nullptr);
    };
    if (job.steps_before > 0) add(job.steps_before, false);
    if (job.refine_at_once) add({}, true);
    if (job.steps > 0) add(job.steps, true);
    strategies.initial_mesh =
        plugins().create<hooks::InitialMesh>({"grid", job.start}, "initial_mesh");
    strategies.improvement = plugins().create<hooks::Improvement>(
        {"dsc", ConfigNode::map({{"topology", ConfigNode::map({{"thickness", 0.0}})}})},
        "improvement");
    strategies.velocity = std::make_unique<Still>();
    return run::simulate(experiment, strategies, job.cloud, options);
}

ConfigNode ball(int cells) {
    return ConfigNode::map(
        {{"cells", cells}, {"shape", "sphere"}, {"radius", 0.9}, {"project", true}});
}

// A cylinder with a hole along its axis: genus 1, with four circular creases.
ConfigNode washer(int cells) {
    const ConfigNode list = ConfigNode::list(
        {ConfigNode::map({{"shape", "cylinder"}, {"radius", 1.0}, {"half_length", 0.4}}),
         ConfigNode::map(
             {{"shape", "cylinder"}, {"action", "cut"}, {"radius", 0.45}, {"half_length", 1.0}})});
    return ConfigNode::map(
        {{"cells", cells}, {"shape", "none"}, {"shapes", list}, {"project", true}});
}

ConfigNode length(double l) { return ConfigNode::map({{"edge_length", l}}); }

std::vector<std::array<std::uint32_t, 2>> edges_of(const surface::TriangleMesh& mesh) {
    std::set<std::array<std::uint32_t, 2>> edges;
    for (const auto& f : mesh.faces) {
        for (std::size_t k = 0; k < 3; ++k)
            edges.insert({std::min(f[k], f[(k + 1) % 3]), std::max(f[k], f[(k + 1) % 3])});
    }
    return {edges.begin(), edges.end()};
}

// The fraction of the edges whose length is within [0.6, 1.5] of l.
double well_sized(const surface::TriangleMesh& mesh, double l) {
    std::size_t good = 0;
    const auto edges = edges_of(mesh);
    for (const auto& [a, b] : edges) {
        const double ratio = (mesh.points[a] - mesh.points[b]).norm() / l;
        good += ratio >= 0.6 && ratio <= 1.5 ? 1 : 0;
    }
    return static_cast<double>(good) / static_cast<double>(edges.size());
}

long genus_of(const run::SimulationResult& result) {
    return mesh::count_interface(mesh::adopt(result.mesh, "result", nullptr, 0.0)).genus();
}

run::SimulationResult with_threads(const Job& job, unsigned threads) {
    Workers workers(threads);
    run::SimulationOptions options;
    options.workers = &workers;
    return simulate(job, options);
}

}  // namespace

TEST_CASE("a sphere's edges get the wanted length, shorter or longer, and it stays a sphere") {
    for (const double l : {0.1, 0.22}) {
        CAPTURE(l);
        const run::SimulationResult result = simulate({ball(20), length(l), 0, true, 4, nullptr});
        CHECK(well_sized(result.surface, l) > 0.95);
        CHECK(genus_of(result) == 0);
        CHECK(result.totals.target_length == l);
        // The number of vertices of regular triangles with this edge.
        const double vertices = 1.1547 * 4 * 3.14159265358979 * 0.81 / (l * l);
        CHECK(static_cast<double>(result.surface.points.size()) ==
              doctest::Approx(vertices).epsilon(0.12));
        double mean = 0.0;
        for (const Vec3& p : result.surface.points)
            mean += std::abs(p.norm() - 0.9) / static_cast<double>(result.surface.points.size());
        CHECK(mean < 0.005);  // chords of the initial edges, which are up to 0.2 long, lie this far
                              // below the sphere
    }
}

TEST_CASE("a ring keeps its hole") {
    for (const double l : {0.08, 0.18}) {
        CAPTURE(l);
        const run::SimulationResult result = simulate({washer(28), length(l), 0, true, 4, nullptr});
        CHECK(well_sized(result.surface, l) > 0.95);
        CHECK(genus_of(result) == 1);
    }
}

TEST_CASE("a cube keeps its twelve edges where creases are kept") {
    for (const double l : {0.06, 0.2}) {
        CAPTURE(l);
        const run::SimulationResult result =
            simulate({ConfigNode::map({{"cells", 24}, {"shape", "cube"}, {"half_width", 0.75}}),
                      length(l), 4, true, 4, nullptr});
        CHECK(well_sized(result.surface, l) > 0.95);
        // Along every edge of the cube, edges of the interface form one line from corner to corner.
        std::map<std::array<int, 3>, double> along;
        for (const auto& [a, b] : edges_of(result.surface)) {
            const Vec3 &p = result.surface.points[a], &q = result.surface.points[b];
            std::array<int, 3> key{};
            int fixed = 0;
            for (int k = 0; k < 3; ++k) {
                if (std::abs(std::abs(p[k]) - 0.75) > 1e-12 || std::abs(p[k] - q[k]) > 1e-12)
                    continue;
                key[static_cast<std::size_t>(k)] = p[k] > 0 ? 1 : -1;
                ++fixed;
            }
            if (fixed == 2) along[key] += (p - q).norm();
        }
        CHECK(along.size() == 12);
        for (const auto& [key, sum] : along) CHECK(sum == doctest::Approx(1.5).epsilon(1e-12));
        // The faces between them stay flat.
        double off = 0.0;
        for (const Vec3& p : result.surface.points)
            off = std::max(off, std::abs(p.cwiseAbs().maxCoeff() - 0.75));
        CHECK(off < 1e-12);
    }
}

TEST_CASE("the budget is met within a tenth") {
    for (const int vertices : {300, 1500}) {
        CAPTURE(vertices);
        const run::SimulationResult result =
            simulate({ball(20), ConfigNode::map({{"vertices", vertices}}), 0, true, 6, nullptr});
        CHECK(static_cast<double>(result.surface.points.size()) ==
              doctest::Approx(0.95 * vertices).epsilon(0.1));
    }
}

TEST_CASE("the number of threads does not matter") {
    const Job job{ball(16), length(0.13), 0, true, 3, nullptr};
    const run::SimulationResult one = with_threads(job, 1);
    REQUIRE(one.totals.refine_committed > 500);
    for (const unsigned threads : {2U, 3U}) {
        const run::SimulationResult other = with_threads(job, threads);
        CHECK(other.mesh.points == one.mesh.points);
        CHECK(other.mesh.tets == one.mesh.tets);
        CHECK(other.mesh.labels == one.mesh.labels);
    }
}

TEST_CASE("a run that was stopped continues to the same surface") {
    const Job job{ball(16), length(0.15), 0, true, 8, nullptr};
    std::map<std::uint64_t, std::string> states;
    run::SimulationOptions options;
    options.checkpoint_every = 1;
    options.on_checkpoint = [&](std::string state, std::uint64_t step) {
        states[step] = std::move(state);
    };
    const run::SimulationResult whole = simulate(job, options);
    for (const std::uint64_t step : {1U, 3U, 6U}) {
        run::SimulationOptions on;
        on.resume = states.at(step);
        const run::SimulationResult end = simulate(job, on);
        CHECK(end.mesh.points == whole.mesh.points);
        CHECK(end.mesh.tets == whole.mesh.tets);
    }
}

TEST_CASE("a surface that needs no change is not changed") {
    const auto policy =
        plugins().create<hooks::RefinementPolicy>({"remesh", length(0.15)}, "schedule.1.refine");
    CHECK(policy->owns_sizing());
    CHECK(policy->passes() == hooks::refinement_passes);
    const auto view = sdk::view_of(sdk::icosphere(3, 1.0));
    for (const std::uint64_t step : {0U, 5U, 9U, 14U}) {
        const hooks::StepContext context{
            .step = step, .surface = view, .box = {}, .to_normalised = {}, .planned_steps = 14};
        hooks::RefinementRequests requests;
        policy->refine({context, nullptr, 0}, requests);
        CHECK(requests.target_length == (step == 0 ? 0.15 : 0.0));
        CHECK(requests.split_edges.empty());
        CHECK(requests.collapse_edges.empty());
        CHECK(requests.flip_edges.empty());
        CHECK(requests.move_vertices.empty());
    }
}

TEST_CASE("creases are kept from a third of the steps on, and in the last third nothing is split "
          "or collapsed") {
    const auto policy =
        plugins().create<hooks::RefinementPolicy>({"remesh", length(0.25)}, "schedule.1.refine");
    const auto view = sdk::view_of(sdk::icosphere(3, 1.0));
    CHECK_FALSE(policy->keep_creases().has_value());
    for (std::uint64_t step = 0; step <= 12; ++step) {
        CAPTURE(step);
        const hooks::StepContext context{.step = step,
                                         .surface = view,
                                         .target_length = 0.15,
                                         .box = {},
                                         .to_normalised = {},
                                         .planned_steps = 12};
        hooks::RefinementRequests requests;
        policy->refine({context, nullptr, 0}, requests);
        CHECK(policy->keep_creases().has_value() == (step >= 4));
        if (step >= 4) CHECK(policy->keep_creases()->dihedral == doctest::Approx(0.6));
        if (step >= 4) CHECK(std::cos(policy->keep_creases()->turn) == doctest::Approx(0.7));
        const bool sweeps = step <= 2 || step == 4 || step == 6;
        CHECK(requests.collapse_edges.empty() == !sweeps);
        CHECK(requests.target_length == (sweeps ? 0.25 : 0.0));
    }
}

TEST_CASE("lengths are in the units of the input") {
    const auto policy =
        plugins().create<hooks::RefinementPolicy>({"remesh", length(30.0)}, "schedule.1.refine");
    const auto view = sdk::view_of(sdk::icosphere(2, 1.0));
    const hooks::StepContext context{
        .surface = view, .box = {}, .to_normalised = {Vec3::Zero(), 0.01}};
    hooks::RefinementRequests requests;
    policy->refine({context, nullptr, 0}, requests);
    CHECK(requests.target_length == doctest::Approx(0.3));
}

TEST_CASE("damaged state is refused, saved state is restored") {
    const auto make = [] {
        return plugins().create<hooks::RefinementPolicy>({"remesh", length(0.25)},
                                                         "schedule.1.refine");
    };
    const auto policy = make(), other = make();
    const auto view = sdk::view_of(sdk::icosphere(2, 1.0));
    const hooks::StepContext context{.step = 7,
                                     .surface = view,
                                     .target_length = 0.25,
                                     .box = {},
                                     .to_normalised = {},
                                     .planned_steps = 12};
    hooks::RefinementRequests requests;
    policy->refine({context, nullptr, 0}, requests);
    std::stringstream state;
    policy->save(state);
    other->load(state);
    CHECK(other->keep_creases().has_value());
    std::stringstream again, first(state.str());
    other->save(again);
    CHECK(again.str() == first.str());
    std::stringstream damaged("3 x");
    CHECK_THROWS_AS(make()->load(damaged), StrategyError);
}
