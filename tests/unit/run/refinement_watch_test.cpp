// What a run says about its refinements: requests, commits, and the vertices five steps later.
#include "run/refinement_watch.hpp"

#include <algorithm>
#include <map>

#include <doctest/doctest.h>

#include <dsc/run/simulation.hpp>

#include "fakes.hpp"

using namespace dsc;
using dsc::test::load_text;
using dsc::test::minimal;

namespace {

struct WatchedRun {
    run::SimulationResult result;
    std::vector<run::StepMetrics> rows;
    std::map<std::uint64_t, std::string> states;
};

WatchedRun watched_run(const std::string& schedule, const std::string& resume = "") {
    static const dsc::test::Strategies catalogue;
    const run::LoadedExperiment loaded =
        load_text(minimal, {"velocity.factor=-0.01", "schedule=" + schedule});
    run::Strategies strategies = run::make_strategies(loaded.experiment, catalogue);
    WatchedRun simulated;
    run::SimulationOptions options;
    options.resume = resume;
    options.checkpoint_every = 1;
    options.on_checkpoint = [&](std::string state, std::uint64_t steps) {
        simulated.states[steps] = std::move(state);
    };
    options.on_step = [&](const run::StepMetrics& row, std::uint64_t) {
        simulated.rows.push_back(row);
    };
    simulated.result = run::simulate(loaded.experiment, strategies, nullptr, options);
    return simulated;
}

bool same_figures(const run::RefinementFigures& a, const run::RefinementFigures& b) {
    return a.item == b.item && a.calls == b.calls && a.skipped == b.skipped &&
           a.requested == b.requested && a.committed == b.committed && a.made == b.made &&
           a.followed == b.followed && a.present == b.present;
}

}  // namespace

TEST_CASE("a refinement is followed for five steps; one after the last step is skipped, with a "
          "warning") {
    const std::string schedule =
        "[{steps: 2}, {refine: {type: all}}, {steps: 7}, {refine: {type: all}}]";
    const WatchedRun run = watched_run(schedule);
    REQUIRE(run.rows.size() == 10);
    const std::uint64_t faces = run.rows[2].interface_faces;
    const std::uint64_t made = run.rows[3].interface_vertices - run.rows[2].interface_vertices;
    CHECK(made > 50);
    for (const run::StepMetrics& row : run.rows) {
        CAPTURE(row.step);
        REQUIRE(row.refinement.has_value());
        CHECK(row.refinement->requested == (row.step == 3 ? faces : 0));
        CHECK(row.refinement->made == (row.step == 3 ? made : 0));
        CHECK((row.refinement->committed > 0) == (row.step == 3));
        // Without repairs no vertex goes.
        CHECK(row.refinement->present ==
              (row.step == 7 ? std::optional(static_cast<double>(made)) : std::nullopt));
    }
    const auto& items = run.result.totals.refinement_items;
    REQUIRE(items.size() == 2);
    CHECK(items[0].item == 1);
    CHECK(items[0].calls == 1);
    CHECK(items[0].requested == faces);
    CHECK(items[0].committed == run.rows[3].refinement->committed);
    CHECK(items[0].made == made);
    CHECK(items[0].followed == made);
    CHECK(items[0].present == made);
    CHECK(items[1].item == 3);
    CHECK(items[1].skipped == 1);
    CHECK(items[1].calls == 0);
    CHECK(run.result.surface.points.size() == run.rows.back().interface_vertices);
    REQUIRE(run.result.totals.warnings.size() == 1);
    CHECK(run.result.totals.warnings[0].code == "refinement.skipped");
    CHECK(run.result.totals.warnings[0].text.find("schedule.3.refine") == 0);

    for (const auto& [steps, state] : run.states) {
        CAPTURE(steps);
        const WatchedRun rest = watched_run(schedule, state);
        const auto& resumed = rest.result.totals.refinement_items;
        CHECK(std::equal(resumed.begin(), resumed.end(), items.begin(), items.end(), same_figures));
        for (const run::StepMetrics& row : rest.rows)
            CHECK(run::csv_row(row) == run::csv_row(run.rows[row.step]));
        CHECK(rest.result.totals.warnings.size() == 1);
    }
}

TEST_CASE("vertices of the last steps are not followed; without refinements there are no figures") {
    const WatchedRun late = watched_run("[{steps: 2}, {refine: {type: all}}, {steps: 4}]");
    REQUIRE(late.result.totals.refinement_items.size() == 1);
    CHECK(late.result.totals.refinement_items[0].made > 50);
    CHECK(late.result.totals.refinement_items[0].followed == 0);
    CHECK(late.result.totals.warnings.empty());
    const WatchedRun none = watched_run("[{steps: 2}]");
    CHECK(none.result.totals.refinement_items.empty());
    CHECK_FALSE(none.rows[0].refinement.has_value());
    // A schedule of refinements only has no last step.
    const WatchedRun only = watched_run("[{refine: {type: all}}]");
    CHECK(only.result.totals.refinement_items[0].calls == 1);
}

TEST_CASE("present are the vertices of the refinement that are on the interface five steps later") {
    const run::LoadedExperiment loaded =
        load_text(minimal, {"schedule=[{steps: 9, every: 1, refine: {type: all}}]"});
    run::RefinementWatch watch(loaded.experiment);
    surface::SurfaceView view;
    watch.begin(10);
    watch.add(6, 4);
    view.births = {1, 5, 10, 11, 13};  // 12 was made and removed, or lies inside
    watch.end(0, 3, view);
    watch.begin(14);
    watch.add(2, 2);
    view.births = {1, 5, 10, 11, 13, 14};
    watch.end(0, 4, view);
    auto row = watch.row(5, view);
    CHECK(row->requested == 8);
    CHECK(row->committed == 6);
    CHECK(row->made == 4);
    CHECK_FALSE(row->present.has_value());
    view.births = {1, 10, 13, 14, 15};
    row = watch.row(8, view);
    CHECK(row->requested == 0);
    CHECK(row->present == 2.0);
    view.births = {1, 13, 20};
    CHECK(watch.row(9, view)->present == 0.0);
    CHECK_FALSE(watch.row(10, view)->present.has_value());
    const run::RefinementFigures& figures = watch.figures().at(0);
    CHECK(figures.made == 4);
    CHECK(figures.followed == 4);
    CHECK(figures.present == 2);
}
