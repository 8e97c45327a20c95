// The comparison of runs: names, groups, pairs, tables and the data for export.
#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <dsc/base/error.hpp>

#include "report/compared.hpp"
#include "report/thesis.hpp"
#include "runs.hpp"

using namespace dsc;
using dsc::test::abscissas;
using dsc::test::count;
using dsc::test::Folder;
using dsc::test::minimal;
using dsc::test::with_cloud;
using dsc::test::work;
namespace fs = std::filesystem;

namespace {

/// The JSON for the page's script.
nlohmann::json data_of(const std::string& page) {
    const std::string begin = "id=\"comparison\">";
    const std::size_t at = page.find(begin) + begin.size();
    return nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at));
}

/// Two settings with three seeds each, as points of a sweep, in a shuffled order. The volumes are
/// written by hand.
struct Sweep {
    Folder folder;
    std::vector<report::ComparedRun> runs;

    Sweep() {
        const double volumes[] = {1.0, 2.0, 3.0, 1.5, 2.25, 2.875};
        for (const std::size_t i : {4U, 0U, 5U, 2U, 1U, 3U}) {
            const std::string factor = i < 3 ? "-0.01" : "-0.02", seed = std::to_string(i % 3 + 1);
            const std::string name = "points/" + std::to_string(i) + "/run";
            work(folder, name, with_cloud(folder, ""),
                 {"velocity.factor=" + factor, "seed=" + seed});
            auto json = nlohmann::ordered_json::parse(folder.read(name + "/summary.json"));
            json["volume"] = volumes[i];
            folder.write(name + "/summary.json", json.dump());
            runs.push_back({folder.path() / name,
                            i,
                            {{"velocity.factor", factor}, {"seed", seed}},
                            {{"chamfer_percent", 0.5 + 0.125 * static_cast<double>(i)}}});
        }
    }
};

}  // namespace

TEST_CASE("the parts of paths that differ") {
    using Paths = std::vector<fs::path>;
    using Texts = std::vector<std::string>;
    CHECK(report::distinct_parts(Paths{"/x/a/run", "/x/b/run/"}) == Texts{"a", "b"});
    CHECK(report::distinct_parts(Paths{"/x/a/1/run", "/x/b/2/run"}) == Texts{"a/1", "b/2"});
    CHECK(report::distinct_parts(Paths{"/x/a", "/x/a/b"}) == Texts{"a", "a/b"});
    CHECK(report::distinct_parts(Paths{"/x/a", "/x/a"}) == Texts{"a", "a"});
}

TEST_CASE("comparison: runs named by their folders, what differs, what is the same") {
    const Folder folder;
    work(folder, "slow/run", with_cloud(folder, ""), {"velocity.factor=-0.01"});
    work(folder, "quick/run", with_cloud(folder, ""), {"velocity.factor=-0.02"});
    const report::ComparedRun runs[] = {{folder.path() / "slow/run"},
                                        {folder.path() / "quick/run/"}};
    const std::string page = report::comparison_html(runs, abscissas());
    for (const char* part :
         {"2 runs compared", "data-key=\"slow\">slow</td>", "<h3>quick</h3>", "<i></i>slow",
          "title=\"velocity.factor\"", "data-key=\"-0.02\">-0.02</td>", "id=\"view-1-scene\"",
          "What differs: 1 value", "<th>velocity.shift.0</th>", "Tables 6.1 and 6.2 for all runs",
          "class=\"comparison\""}) {
        CAPTURE(part);
        CHECK(page.find(part) != std::string::npos);
    }
    CHECK(page.find("id=\"groups\"") == std::string::npos);
    // Two settings with one pair.
    CHECK(page.find("id=\"pairs\"") != std::string::npos);
    const report::ComparedRun same[] = {{folder.path() / "slow/run"}, {folder.path() / "slow/run"}};
    const std::string twice = report::comparison_html(same, abscissas());
    CHECK(twice.find("The experiments are the same.") != std::string::npos);
    CHECK(twice.find("<h3>slow") == std::string::npos);  // nothing but the whole path is common
    CHECK(twice.find("<i></i>run (2)") != std::string::npos);
    CHECK_THROWS_AS(report::comparison_html({}, abscissas()), UsageError);
}

TEST_CASE("comparison of a sweep: index order, overrides as names, repeats in groups") {
    const Sweep sweep;
    const report::Comparison comparison = report::compare_runs(sweep.runs);
    CHECK(comparison.sweep);
    REQUIRE(comparison.runs.size() == 6);
    for (std::size_t i = 0; i < 6; ++i) CHECK(comparison.runs[i].index == i);
    CHECK(comparison.runs[0].name == "factor=-0.01, seed=1");
    CHECK(comparison.runs[5].name == "factor=-0.02, seed=3");
    REQUIRE(comparison.groups.size() == 2);
    CHECK(comparison.groups[1].runs == std::vector<std::size_t>{3, 4, 5});
    CHECK(comparison.group_name(comparison.groups[1]) == "factor=-0.02");
    CHECK(comparison.setting_name(0) == "factor=-0.01");
    CHECK(comparison.shown() == std::vector<std::size_t>{0, 3});
    CHECK(comparison.runs[2].figure("truth.chamfer_percent") == 0.75);
    CHECK(comparison.runs[2].figure("volume") == 3.0);

    const std::string page = report::comparison_html(sweep.runs, abscissas());
    CHECK(page.find("2 groups of 6 runs compared") != std::string::npos);
    CHECK(page.find("id=\"groups\"") < page.find("id=\"runs\""));
    // 1, 2, 3: mean 2, deviation 1, interval 2 -+ 4.302653 / root 3.
    CHECK(page.find("<b>2</b><span>&plusmn; 1</span><span>-0.4841 to 4.484</span>") !=
          std::string::npos);
    CHECK(count(page, "class=\"viewer\"") == 2);
    CHECK(page.find("Pictures of 4 other runs") != std::string::npos);

    const nlohmann::json data = data_of(page);
    REQUIRE(data["runs"].size() == 7);
    CHECK(data["runs"][1][1] == "factor=-0.01, seed=1");
    REQUIRE(data["groups"].size() == 3);
    // Differences 0.5, 0.25, -0.125: ranks 3, 2, 1; {} and {1} of the 8 signs; one of three is
    // negative.
    bool found = false;
    for (const nlohmann::json& row : data["pairs"]["0,1"]) {
        if (row[0] != "volume") continue;
        found = true;
        CHECK(row[1] == "3");
        CHECK(row[2] == "2");
        CHECK(row[3] == "2.208");
        CHECK(row[4] == "0.2083");
        CHECK(row[6] == "0.5");
        CHECK(row[7] == "2 / 1 / 0");
        CHECK(row[8] == "1");
    }
    CHECK(found);
}

TEST_CASE("comparison: more runs than colours: the others can be chosen") {
    const Folder folder;
    std::vector<report::ComparedRun> runs;
    for (int i = 0; i < 10; ++i) {
        const std::string name = "run" + std::to_string(i);
        work(folder, name, minimal, {"velocity.factor=-0.0" + std::to_string(i + 1)});
        runs.push_back({folder.path() / name});
    }
    const std::string page = report::comparison_html(runs, abscissas());
    const std::size_t at = page.find("aria-label=\"Vertices of the surface\"");
    const std::string plot = page.substr(at, page.find("</figure>", at) - at);
    CHECK(count(plot, "<path ") == 10);
    CHECK(count(plot, "class=\"curve off\"") == 2);
    CHECK(count(plot, "<span hidden>") == 2);
    CHECK(count(page, "type=\"checkbox\" value=") == 10);
    CHECK(count(page, " checked><i></i>") == 8);
    CHECK(count(page, "class=\"viewer\"") == 8);
}

TEST_CASE("keys are as short as they can be told apart") {
    report::Comparison comparison;
    comparison.keys = {"velocity.alpha", "velocity.curvature.alpha", "schedule.0.steps",
                       "initial_mesh.cells", "seed"};
    CHECK(comparison.short_key("initial_mesh.cells") == "cells");
    CHECK(comparison.short_key("velocity.curvature.alpha") == "curvature.alpha");
    CHECK(comparison.short_key("velocity.alpha") == "velocity.alpha");
    CHECK(comparison.short_key("schedule.0.steps") == "steps");
    CHECK(comparison.short_key("seed") == "seed");
}

TEST_CASE("the thesis' tables for several runs: a cloud of the thesis beside another one") {
    report::RunRecord cow, other;
    cow.summary = {{"input", {{"source", "/clouds/cow.obj"}}},
                   {"wall_s", 4.8},
                   {"cpu_s", 5.0},
                   {"interface_vertices", 2161},
                   {"interface_faces", 4322},
                   {"vertex_to_cloud", {{"mean", 0.02378}, {"min", 0.00035}, {"max", 0.08527}}},
                   {"shells", 2},
                   {"genus", 2},
                   {"self_intersections", 0}};
    other.summary = cow.summary;
    other.summary["input"]["source"] = "/clouds/kitten.obj";
    const report::NamedRecord runs[] = {{&cow, "one"}, {&other, "two"}};
    const std::string page = report::thesis_comparison(runs);
    // Table 6.1 of the thesis: 893 seconds, 2,355 vertices, 4,848 faces; 6.2: 0.02443, 0.00026,
    // 0.16622.
    CHECK(page.find("<td>one</td><td>cow</td><td>4.8 s</td><td>5 s</td><td>2,161</td><td>4,322</td>"
                    "<td>893</td><td>2,355</td><td>4,848</td>") != std::string::npos);
    CHECK(page.find("<td>one</td><td>cow</td><td>0.02378</td><td>0.02443</td><td>0.00035</td>"
                    "<td>0.00026</td><td>0.08527</td><td>0.1662</td><td>2 / 2</td><td>0</td>") !=
          std::string::npos);
    CHECK(page.find("<td>two</td><td>-</td><td>4.8 s</td><td>5 s</td><td>2,161</td><td>4,322</td>"
                    "<td>-</td>") != std::string::npos);
}
