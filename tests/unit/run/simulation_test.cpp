// The simulation with the real kernel and small strategies.
#include <cmath>
#include <map>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <dsc/base/error.hpp>
#include <dsc/run/measure.hpp>
#include <dsc/run/run_experiment.hpp>
#include <dsc/run/simulation.hpp>

#include "fakes.hpp"

using namespace dsc;
using dsc::test::Folder;
namespace fs = std::filesystem;
using dsc::test::load_text;
using dsc::test::minimal;

namespace {

struct Simulated {
    run::SimulationResult result;
    std::vector<run::StepMetrics> rows;
};

Simulated simulate(const std::vector<std::string>& overrides, Workers* workers = nullptr) {
    const dsc::test::Strategies catalogue;
    const run::LoadedExperiment loaded = load_text(minimal, overrides);
    run::Strategies strategies = run::make_strategies(loaded.experiment, catalogue);
    Simulated simulated;
    run::SimulationOptions options;
    options.workers = workers;
    options.on_step = [&](const run::StepMetrics& row, std::uint64_t) {
        simulated.rows.push_back(row);
    };
    simulated.result = run::simulate(loaded.experiment, strategies, nullptr, options);
    return simulated;
}

// Goes half of the way to the nearest point, and counts where the host's answer is not the
// search's.
class Homing final : public hooks::VelocityField {
public:
    void prepare(const hooks::StepContext& context) override {
        surface_ = &context.surface;
        cloud_ = context.cloud;
        nearest_ = context.nearest;
        wrong += nearest_.size() == surface_->vertex_count() ? 0 : 1;
        for (std::size_t i = 0; i < nearest_.size(); ++i) {
            const cloud::Neighbour asked = cloud_->search().nearest(surface_->positions[i]);
            wrong +=
                nearest_[i].index == asked.index && nearest_[i].distance == asked.distance ? 0 : 1;
        }
    }
    void evaluate(hooks::Range range, std::span<Vec3> out) const override {
        for (std::size_t i = 0; i < out.size(); ++i) {
            const std::size_t v = range.begin + i;
            out[i] = 0.5 * ((*cloud_)[nearest_[v].index] - surface_->positions[v]);
        }
    }
    std::size_t wrong = 0;

private:
    const surface::SurfaceView* surface_ = nullptr;
    const cloud::TargetCloud* cloud_ = nullptr;
    std::span<const cloud::Neighbour> nearest_;
};

}  // namespace

TEST_CASE("strategies find the cloud point nearest to each vertex, also after a refinement, and "
          "the figures are theirs") {
    cloud::Normalized points;
    for (const double x : {-0.4, 0.0, 0.4}) {
        for (const double y : {-0.4, 0.0, 0.4}) points.points.emplace_back(x, y, 0.1 * x - 0.3);
    }
    const cloud::TargetCloud target(points);
    const dsc::test::Strategies catalogue;
    const run::LoadedExperiment loaded =
        load_text(minimal, {"schedule=[{steps: 2}, {refine: {type: all}}, {steps: 2}]"});
    run::Strategies strategies = run::make_strategies(loaded.experiment, catalogue);
    auto homing = std::make_unique<Homing>();
    const Homing& velocity = *homing;
    strategies.velocity = std::move(homing);
    std::size_t wrong = 0, states = 0;
    run::SimulationOptions options;
    run::StepMetrics last;
    options.on_step = [&](const run::StepMetrics& row, std::uint64_t) { last = row; };
    options.on_state = [&](const hooks::StepContext& context, const mesh::Complex&) {
        double sum = 0, largest = 0;
        for (const Vec3& p : context.surface.positions) {
            const double distance = target.search().nearest(p).distance;
            sum += distance;
            largest = std::max(largest, distance);
        }
        wrong +=
            last.vertex_to_cloud_mean == sum / static_cast<double>(context.surface.vertex_count())
                ? 0
                : 1;
        wrong += last.vertex_to_cloud_max == largest ? 0 : 1;
        ++states;
    };
    run::simulate(loaded.experiment, strategies, &target, options);
    CHECK(states == 5);
    CHECK(wrong == 0);
    CHECK(velocity.wrong == 0);
}

TEST_CASE("steps shrink the cube as the velocity says") {
    const Simulated d = simulate({"velocity.factor=-0.05", "schedule.0.steps=2"});
    REQUIRE(d.rows.size() == 3);
    CHECK(d.rows[0].step == 0);
    CHECK(d.rows[2].step == 2);
    CHECK(d.rows[0].volume == doctest::Approx(1.0));
    CHECK(d.rows[1].volume == doctest::Approx(std::pow(0.95, 3)));
    CHECK(d.rows[2].volume == doctest::Approx(std::pow(0.95, 6)));
    CHECK(d.rows[1].max_speed == doctest::Approx(0.025 * std::sqrt(3.0)));
    CHECK_FALSE(d.rows[1].vertex_to_cloud_mean.has_value());
    CHECK(d.result.totals.status == run::Status::max_steps);
    CHECK(d.result.totals.steps == 2);
    CHECK(d.result.totals.volume_initial == doctest::Approx(1.0));
    CHECK(run::measure(d.result.mesh).solid());
}

TEST_CASE("converged: the last series ended slow, further items still run") {
    const std::vector<std::string> slow = {"velocity.factor=0",
                                           "stop={speed: 1.0e-3, patience: 2}"};
    const Simulated one = simulate({slow[0], slow[1], "schedule.0.steps=9"});
    CHECK(one.result.totals.status == run::Status::converged);
    CHECK(one.result.totals.steps == 2);
    const Simulated three =
        simulate({slow[0], slow[1], "schedule=[{steps: 9}, {refine: {type: all}}, {steps: 9}]"});
    CHECK(three.result.totals.steps == 4);
    CHECK(three.result.totals.refinements == 1);
    CHECK(three.result.surface.faces.size() > 192);
    const Simulated fast = simulate({"velocity.factor=-0.01", slow[1], "schedule.0.steps=3"});
    CHECK(fast.result.totals.status == run::Status::max_steps);
}

TEST_CASE("stalled: without repair the motion is blocked in the end") {
    const Simulated d =
        simulate({"velocity.factor=0", "velocity.shift=[0.2, 0, 0]", "schedule.0.steps=100"});
    CHECK(d.result.totals.status == run::Status::stalled);
    CHECK(d.result.totals.steps < 100);
    CHECK(run::measure(d.result.mesh).solid());
}

TEST_CASE("refinement: by faces, by a sizing field, every few steps") {
    CHECK(simulate({"schedule=[{refine: {type: all}}]"}).result.surface.points.size() > 98);
    const Simulated coarse = simulate({"schedule=[{refine: {type: all, sizing: 5}}]"});
    CHECK(coarse.result.surface.points.size() == 98);
    CHECK(coarse.result.totals.refine_requested == 0);
    // Edges are 0.25 and 0.354 long: 0.3 splits each diagonal once.
    const Simulated fine = simulate({"schedule=[{refine: {type: all, sizing: 0.3}}]"});
    CHECK(fine.result.totals.refine_committed == 96);
    const Simulated often = simulate(
        {"velocity.factor=0", "schedule=[{steps: 4, every: 2, refine: {type: all, sizing: 5}}]"});
    CHECK(often.result.totals.refinements == 2);
}

TEST_CASE("a refinement that samples is refused beside a velocity that cannot be sampled") {
    const std::vector<std::string> bad = {"schedule=[{refine: {type: all, sampling: true}}]"};
    CHECK_THROWS_AS(simulate(bad), ConfigError);
    CHECK_NOTHROW(simulate({bad[0], "velocity.sampled=true"}));
}

TEST_CASE("cancelled: before the first step nothing has moved") {
    const dsc::test::Strategies catalogue;
    const run::LoadedExperiment loaded = load_text(minimal);
    run::Strategies strategies = run::make_strategies(loaded.experiment, catalogue);
    CancelToken token;
    token.cancel();
    run::SimulationOptions options;
    options.cancel = &token;
    const run::SimulationResult result =
        run::simulate(loaded.experiment, strategies, nullptr, options);
    CHECK(result.totals.status == run::Status::cancelled);
    CHECK(result.totals.steps == 0);
}

TEST_CASE("two observers of one type have names of their own") {
    const Simulated twice = simulate({"observers=[{type: counter}, {type: counter}]"});
    REQUIRE(twice.rows.back().observers.size() == 2);
    CHECK(twice.rows.back().observers[0].first == "observers.counter.count");
    CHECK(twice.rows.back().observers[1].first == "observers.counter_2.count");
    REQUIRE(twice.result.totals.observers.size() == 2);
    CHECK(twice.result.totals.observers[0].first == "counter");
    CHECK(twice.result.totals.observers[1].first == "counter_2");
}

TEST_CASE("the result does not depend on the number of threads") {
    Workers three(3);
    const std::vector<std::string> overrides = {
        "velocity.factor=-0.08", "schedule=[{steps: 3}, {refine: {type: all}}, {steps: 3}]"};
    const Simulated a = simulate(overrides), b = simulate(overrides, &three);
    CHECK(run::identical(a.result.surface, b.result.surface));
    CHECK(a.result.mesh.tets == b.result.mesh.tets);
    CHECK(a.result.last.volume == b.result.last.volume);
}

TEST_CASE("a whole run: the folder holds what it should, a second run the same bytes") {
    const Folder folder;
    const dsc::test::Strategies catalogue;
    // Plugins count by their content: the linked-in one has a file here.
    const auto work = [&](const std::string& name, unsigned threads) {
        const run::LoadedExperiment loaded = load_text(minimal, {"observers=[{type: counter}]"});
        run::RunOptions options;
        options.folder = folder.path() / name;
        options.threads = threads;
        return run::run_experiment(loaded, catalogue, options);
    };
    const fs::path here = fs::current_path();
    fs::current_path(folder.path());
    folder.write("libdsc_fake.so", "stands for a plugin");
    const run::RunOutcome outcome = work("one", 1);
    work("two", 2);
    fs::current_path(here);

    CHECK(outcome.conforms);
    CHECK(outcome.surface.solid());
    for (const char* name :
         {"result/surface.obj", "result/surface.ply", "result/volume.vtu", "result/volume.dsc",
          "metrics.csv", "events.jsonl", "preview.png", "config.resolved.yaml"}) {
        CAPTURE(name);
        CHECK(fs::exists(folder.path() / "one" / name));
        CHECK(folder.read(std::string("one/") + name) == folder.read(std::string("two/") + name));
    }
    const auto status = nlohmann::json::parse(folder.read("one/status.json"));
    CHECK(status["state"] == "done");
    CHECK(status["status"] == "max_steps");
    const auto summary = nlohmann::json::parse(folder.read("one/summary.json"));
    for (const char* key : {"status",
                            "steps",
                            "interface_vertices",
                            "interface_faces",
                            "tets",
                            "min_tet_quality",
                            "inverted_tets",
                            "components",
                            "genus",
                            "boundary_edges",
                            "nonmanifold_edges",
                            "nonmanifold_vertices",
                            "self_intersections",
                            "volume",
                            "volume_initial",
                            "shells",
                            "cavities",
                            "events",
                            "target_length",
                            "clamped",
                            "dropped_motion",
                            "edit_volume",
                            "relabelled_volume",
                            "rounds",
                            "refused",
                            "vertex_to_cloud",
                            "cloud_to_surface",
                            "wall_s",
                            "cpu_s",
                            "peak_rss_mb",
                            "phase_cpu_s",
                            "phase_wall_s"}) {
        CAPTURE(key);
        CHECK(summary.contains(key));
    }
    CHECK(summary["volume"].get<double>() == doctest::Approx(std::pow(0.95, 6)));
    CHECK(summary["components"] == 1);
    CHECK(summary["genus"] == 0);
    CHECK(summary["observers"]["counter"]["total"] == 2.0);
    const auto provenance = nlohmann::json::parse(folder.read("one/provenance.json"));
    CHECK(provenance["plugins"][0]["sha256"].get<std::string>().size() == 64);
    CHECK_FALSE(provenance["finished"].is_null());
}

TEST_CASE(
    "an improvement's requests are counted by its classes, in events.jsonl and in the summary") {
    const Folder folder;
    const dsc::test::Strategies catalogue;
    const fs::path here = fs::current_path();
    fs::current_path(folder.path());
    folder.write("libdsc_fake.so", "stands for a plugin");
    run::RunOptions options;
    options.folder = folder.path() / "out";
    const run::RunOutcome outcome = run::run_experiment(
        load_text(minimal, {"improvement.type=counted", "velocity.factor=-0.05"}), catalogue,
        options);
    fs::current_path(here);

    std::map<std::string, std::array<std::uint64_t, 2>> lines;
    std::istringstream events(folder.read("out/events.jsonl"));
    std::size_t count = 0;
    for (std::string line; std::getline(events, line); ++count) {
        const auto json = nlohmann::json::parse(line);
        CHECK(json["kind"] == "repair");
        CHECK(json["step"] == 1 + count / 2);
        CHECK(json["class"] == (count % 2 == 0 ? "inside" : "surface"));
        lines[json["class"]][0] += json["requested"].get<std::uint64_t>();
        lines[json["class"]][1] += json["committed"].get<std::uint64_t>();
    }
    // A class that was not asked for has no line; a request a round of each of the others.
    CHECK(count == 4);
    CHECK(lines["inside"][0] == outcome.totals.rounds);
    CHECK(lines["surface"][0] == outcome.totals.rounds);
    CHECK(lines["surface"][1] == 0);
    const auto classes = nlohmann::json::parse(folder.read("out/summary.json"))["repair_classes"];
    CHECK(classes.size() == 3);
    CHECK(classes["never"]["tried"] == 0);
    CHECK(classes["inside"]["tried"] == lines["inside"][0]);
    CHECK(classes["inside"]["committed"] == lines["inside"][1]);
    CHECK(classes["surface"]["not_applicable"] == lines["surface"][0]);
}

TEST_CASE("a run that fails leaves no result and says why") {
    const Folder folder;
    folder.write("flat.xyz", "0 0 0\n1 0 0\n0 1 0\n1 1 0\n");
    const dsc::test::Strategies catalogue;
    const fs::path here = fs::current_path();
    fs::current_path(folder.path());
    folder.write("libdsc_fake.so", "stands for a plugin");
    run::RunOptions options;
    options.folder = folder.path() / "run";
    run::run_experiment(load_text(minimal), catalogue, options);
    CHECK(fs::exists(folder.path() / "run/result/surface.obj"));
    const auto bad = load_text(
        minimal + "input: {cloud: {file: " + (folder.path() / "flat.xyz").string() + "}}\n");
    CHECK_THROWS_AS(run::run_experiment(bad, catalogue, options), GeometryError);
    fs::current_path(here);
    for (const char* name : {"result", "summary.json", "preview.png", ".result.part"}) {
        CAPTURE(name);
        CHECK_FALSE(fs::exists(folder.path() / "run" / name));
    }
    const auto status = nlohmann::json::parse(folder.read("run/status.json"));
    CHECK(status["state"] == "failed");
    CHECK(status["exit_code"] == 5);
    CHECK(status["error_code"] == "cloud.coplanar");
}
