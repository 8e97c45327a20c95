// A run that was interrupted and goes on is the run that was not: 40 steps against 20, a
// checkpoint, and 20, to the last bit.
#include <map>
#include <set>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/config/yaml.hpp>
#include <dsc/run/input.hpp>
#include <dsc/run/simulation.hpp>

#include "results.hpp"

namespace {

using namespace dsc;
using dsc::test::Cli;

/// Experiments of 40 steps that between them have every built-in strategy.
const std::map<std::string, std::string> experiments = {
    {"thesis, refined and with topology changes",
     "input: {cloud: {sample: {shape: teapot, n: 3000}}, normalize: {}}\n"
     "initial_mesh: {type: grid, cells: 16}\n"
     "velocity: {type: point_cloud, curvature: {type: implicit_fairing}}\n"
     "improvement: {type: dsc}\n"
     "schedule: [{steps: 13}, {refine: {type: average_area}}, {steps: 27}]\n"},
    {"selective curvature, refined as it goes",
     "input: {cloud: {sample: {shape: box_tunnel, n: 2000}}, normalize: {}}\n"
     "initial_mesh: {type: lattice, cells: 20, shapes: [{shape: sphere, radius: 1.1}]}\n"
     "velocity: {type: point_cloud, curvature_at: unsupported, beta: 3.0e-4, unsupported: {beyond: "
     "2}, curvature: {type: angular_defect}}\n"
     "improvement: {type: dsc}\n"
     "schedule: [{steps: 40, every: 6, refine: {type: centroid_speed}}]\n"},
    {"illinois", "initial_mesh: {type: corner_box, divisions: 4}\nvelocity: {type: rotate, "
                 "degrees: 3}\nimprovement: {type: illinois}\n"
                 "observers: [{type: analytic}]\nschedule: [{steps: 40}]\n"},
    {"a cloud through all filters, labelled by its winding field",
     "input: {cloud: {sample: {shape: sphere, n: 2000}, filters: [{type: duplicates}, {type: "
     "clusters}, {type: voxel_grid, size: 0.001},\n"
     "  {type: hidden}, {type: radius_outliers, radius: 0.1}, {type: statistical_outliers, "
     "deviations: 10}, {type: outliers},\n"
     "  {type: orient}]}, normalize: {}}\n"
     "initial_mesh: {type: indicator}\nvelocity: {type: point_cloud}\nimprovement: {type: "
     "dsc}\nschedule: [{steps: 40}]\n"},
    {"fitted and remeshed, through its hole fill and the last third",
     "input: {cloud: {sample: {shape: torus, n: 1200}, filters: [{type: duplicates, sort: true}, "
     "{type: orient}]}, normalize: {}}\n"
     "initial_mesh: {type: indicator}\nvelocity: {type: surface_fit, iterations: 40}\nimprovement: "
     "{type: dsc, topology: {thickness: 0}}\n"
     "schedule: [{steps: 40, every: 1, refine: {type: remesh}}]\n"},
    {"average",
     "initial_mesh: {type: grid, cells: 12}\nvelocity: {type: average}\nimprovement: {type: dsc}\n"
     "schedule: [{steps: 40}]\n"},
    {"curvature flow", "initial_mesh: {type: grid, cells: 14, shape: sphere}\nvelocity: {type: "
                       "curvature_flow, time_step: 0.002}\n"
                       "improvement: {type: dsc}\nobservers: [{type: analytic, solution: "
                       "sphere}]\nschedule: [{steps: 40}]\n"},
    {"normal, from a surface",
     "initial_mesh: {type: from_surface, file: \"" DSC_SOURCE_DIR
     "/configs/demos/torus.off\", cells: 16}\n"
     "velocity: {type: normal, speed: 0.01}\nimprovement: {type: dsc}\nschedule: [{steps: 40}]\n"},
    {"flow, several labels",
     "initial_mesh: {type: dsc_file, file: \"" DSC_SOURCE_DIR "/configs/demos/three_slabs.dsc\"}\n"
     "velocity: {type: flow, field: shear}\nimprovement: {type: dsc}\nschedule: [{steps: 40}]\n"},
};

struct Saved {
    std::uint64_t steps;
    std::string state;
};

/// What a run leaves: its mesh, its table, its sums; time is not among them.
struct Outcome {
    mesh::TetMesh mesh;
    std::string rows;
    std::string sums;
    std::vector<Saved> checkpoints;
};

class Runner {
public:
    explicit Runner(const std::string& text) {
        dsc::test::load_strategies(host_);
        const config::ConfigNode root = config::parse_yaml("dsc: 1\n" + text, "resume.yaml");
        loaded_ = run::resolve_experiment(
            root, [this](const std::vector<std::string>&) -> const config::StrategyLookup& {
                return host_;
            });
        if (loaded_.experiment.input)
            input_ = run::load_input(*loaded_.experiment.input, loaded_.experiment.seed, host_,
                                     *loaded_.files);
    }

    Outcome run(std::string_view resume, std::uint64_t every, unsigned threads = 1) {
        run::Strategies strategies = run::make_strategies(loaded_.experiment, host_);
        Outcome outcome;
        Workers workers(threads);
        run::SimulationOptions options;
        options.workers = &workers;
        options.resume = resume;
        options.checkpoint_every = every;
        options.on_checkpoint = [&](std::string state, std::uint64_t steps) {
            outcome.checkpoints.push_back({steps, std::move(state)});
        };
        options.on_step = [&](const run::StepMetrics& row, std::uint64_t) {
            outcome.rows += run::csv_row(row);
        };
        options.on_event = [&](const kernel::Event& event) {
            outcome.rows += run::event_line(event, {});
        };
        const run::SimulationResult result = run::simulate(
            loaded_.experiment, strategies, input_ ? &input_->target : nullptr, options);
        outcome.mesh = result.mesh;
        outcome.sums = sums(result.totals);
        return outcome;
    }

private:
    static std::string sums(const run::RunTotals& t) {
        std::string text = std::string(run::name(t.status));
        for (const double value :
             {static_cast<double>(t.steps), t.dropped_motion, t.edit_distance, t.edit_volume,
              t.relabelled_volume, t.target_length, t.volume_initial,
              static_cast<double>(t.refine_committed), static_cast<double>(t.events.merge),
              static_cast<double>(t.rounds)})
            text += " " + config::real_text(value);
        for (const auto& [id, figures] : t.observers) {
            for (const auto& [name, value] : figures)
                text += " " + name + "=" + config::real_text(value);
        }
        return text;
    }

    host::Host host_;
    run::LoadedExperiment loaded_;
    std::optional<run::LoadedInput> input_;
};

std::string tail(const std::string& all, std::size_t size) {
    return all.substr(all.size() - std::min(size, all.size()));
}

}  // namespace

TEST_CASE("40 steps against 20 and 20, with every built-in strategy") {
    std::set<std::string> used;
    for (const auto& [name, text] : experiments) {
        CAPTURE(name);
        Runner runner(text);
        const Outcome whole = runner.run({}, 20);
        REQUIRE(whole.checkpoints.size() >= 1);
        CHECK(whole.checkpoints[0].steps == 20);
        const Outcome rest = runner.run(whole.checkpoints[0].state, 0, 2);
        CHECK(rest.mesh.points == whole.mesh.points);
        CHECK(rest.mesh.tets == whole.mesh.tets);
        CHECK(rest.mesh.labels == whole.mesh.labels);
        CHECK(rest.sums == whole.sums);
        CHECK_FALSE(rest.rows.empty());
        CHECK(tail(whole.rows, rest.rows.size()) == rest.rows);
        for (std::size_t at = 0; (at = text.find("type: ", at)) != std::string::npos; ++at)
            used.insert(text.substr(at + 6, text.find_first_of(",}\n", at) - at - 6));
    }
    host::Host host;
    dsc::test::load_strategies(host);
    for (const plugin::StrategyInfo& info : host.list()) {
        CAPTURE(info.strategy->id);
        CHECK(used.count(info.strategy->id) == 1);
    }
}

TEST_CASE("a run may be interrupted at every step") {
    const std::string text = "initial_mesh: {type: grid, cells: 10}\nvelocity: {type: "
                             "average}\nimprovement: {type: dsc}\n"
                             "schedule: [{steps: 3}, {refine: {type: average_area}}, {steps: 4}]\n";
    Runner small(text);
    const Outcome whole = small.run({}, 1);
    CHECK(whole.checkpoints.size() == 7);
    for (const Saved& saved : whole.checkpoints) {
        CAPTURE(saved.steps);
        const Outcome rest = small.run(saved.state, 1);
        CHECK(rest.mesh.points == whole.mesh.points);
        CHECK(rest.mesh.tets == whole.mesh.tets);
        CHECK(rest.sums == whole.sums);
        // The states on the way are the same, too.
        for (std::size_t i = 0; i < rest.checkpoints.size(); ++i)
            CHECK(rest.checkpoints[rest.checkpoints.size() - 1 - i].steps ==
                  whole.checkpoints[whole.checkpoints.size() - 1 - i].steps);
    }
}

TEST_CASE("a damaged state ends in an error, never in a crash") {
    Runner small("initial_mesh: {type: grid, cells: 6}\nvelocity: {type: average}\nimprovement: "
                 "{type: dsc}\n"
                 "schedule: [{steps: 2}]\n");
    const std::string state = small.run({}, 1).checkpoints.front().state;
    for (std::size_t part = 1; part < 12; ++part)
        CHECK_THROWS_AS(small.run(std::string_view(state).substr(0, state.size() * part / 12), 0),
                        dsc::IoError);
}
