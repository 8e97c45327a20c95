// What a sweep has: rows, groups of repeats, pairs of settings, the figures against a truth.
#include <cmath>

#include <doctest/doctest.h>

#include <dsc/base/log.hpp>
#include <dsc/sweep/results.hpp>

#include "bench.hpp"

using namespace dsc;
using dsc::test::Bench;
using dsc::test::contains;
using dsc::test::lines;
using dsc::test::names;

namespace {

const std::string done = R"({"format": "dsc-run-1", "state": "done"})";

/// The cube [low, high]^3 as OBJ.
std::string cube(double low, double high) {
    std::string text;
    for (int i = 0; i < 8; ++i) {
        text += "v";
        for (int k = 0; k < 3; ++k) text += " " + std::to_string((i >> k) % 2 == 0 ? low : high);
        text += "\n";
    }
    return text +
           "f 1 3 4\nf 1 4 2\nf 5 6 8\nf 5 8 7\nf 1 2 6\nf 1 6 5\nf 3 7 8\nf 3 8 4\nf 1 5 7\nf "
           "1 7 3\nf 2 4 8\nf 2 8 6\n";
}

std::vector<std::string> cells(const std::string& table, std::size_t row) {
    std::istringstream stream(table);
    std::string line;
    for (std::size_t i = 0; i <= row; ++i) std::getline(stream, line);
    std::vector<std::string> all;
    std::istringstream parts(line);
    for (std::string part; std::getline(parts, part, ',');) all.push_back(part);
    return all;
}

double number(const std::string& table, std::size_t row, const std::string& column) {
    const std::vector<std::string> header = cells(table, 0), values = cells(table, row);
    for (std::size_t i = 0; i < header.size() && i < values.size(); ++i) {
        if (header[i] == column) return values[i].empty() ? std::nan("") : std::stod(values[i]);
    }
    FAIL("no column " << column);
    return 0.0;
}

/// Two settings over five seeds of a sampled cloud; `volume` and `genus` are given per point.
struct Repeated {
    Bench bench;
    std::vector<std::string> all;

    Repeated() {
        bench.folder.write("base.yaml",
                           dsc::test::minimal + "input: {cloud: {sample: {n: 100}}}\n");
        const std::string text = "axes: [{grid: {velocity.factor: [0.1, 0.2]}}]\nrepeat: 5\n";
        bench.expand(text);
        all = names(bench.load(text));
    }
    void finish(std::size_t point, double volume) const {
        const std::string run = "out/points/" + all[point] + "/run/";
        bench.folder.write(run + "status.json", done);
        bench.folder.write(run + "summary.json", "{\"status\": \"max_steps\", \"genus\": 0, "
                                                 "\"volume\": " +
                                                     std::to_string(volume) + "}");
    }
    sweep::SweepResults results() const {
        return sweep::collect_sweep(bench.folder.path() / "out");
    }
};

}  // namespace

TEST_CASE("collect names a strategy whose plugin differs between the points") {
    const Bench bench;
    const std::string text = "axes: [{grid: {initial_mesh.cells: [1, 2, 3]}}]\n";
    bench.expand(text);
    const std::vector<std::string> all = names(bench.load(text));
    const auto finish = [&](std::size_t point, const std::string& version) {
        const std::string run = "out/points/" + all[point] + "/run/";
        bench.folder.write(run + "status.json",
                           R"({"format": "dsc-run-1", "state": "done", "strategies": )"
                           R"({"initial_mesh box": "same", "velocity mine": ")" +
                               version + "\"}}");
        bench.folder.write(run + "summary.json", R"({"status": "max_steps"})");
    };
    std::string said;
    set_log_sink([&said](LogLevel, std::string_view line) { said += std::string(line) + "\n"; });
    for (const std::size_t point : {0, 1, 2}) finish(point, "one");
    sweep::collect_sweep(bench.folder.path() / "out");
    CHECK(said.empty());
    finish(2, "another");
    sweep::collect_sweep(bench.folder.path() / "out");
    set_log_sink({});
    CAPTURE(said);
    CHECK(contains(said, "different versions of velocity mine"));
    CHECK(contains(said, "points/" + all[0] + " and points/" + all[2]));
    CHECK(lines(said) == 1);
}

TEST_CASE("collect: a row a point, whatever its state") {
    const Bench bench;
    const std::string text = "axes: [{list: [{initial_mesh.cells: 1}, {initial_mesh.cells: 2}, "
                             "{initial_mesh.cells: 3, output.surface: [obj, ply]}, "
                             "{initial_mesh.cells: 4}, {initial_mesh.cells: 5}, "
                             "{initial_mesh.cells: 6}]}]\n";
    bench.expand(text);
    const std::vector<std::string> all = names(bench.load(text));
    const auto write = [&](std::size_t point, const std::string& file, const std::string& content) {
        bench.folder.write("out/points/" + all[point] + "/run/" + file, content);
    };
    write(0, "status.json", R"({"format": "dsc-run-1", "state": "done", "exit_code": 0})");
    write(0, "summary.json",
          R"({"status": "max_steps", "steps": 2, "volume": 0.1, "genus": 0, "vertex_to_cloud": null,
              "observers": {"analytic": {"radius_error": 1e-3}}, "wall_s": 0.5})");
    write(
        1, "status.json",
        R"({"format": "dsc-run-1", "state": "failed", "error_code": "run.vanished", "exit_code": 5})");
    write(2, "status.json", R"({"format": "dsc-run-1", "state": "running"})");
    // cannot be: of another run
    write(2, "summary.json", R"({"status": "max_steps", "steps": 99})");
    // its summary was taken away
    write(4, "status.json", R"({"format": "dsc-run-1", "state": "done"})");
    write(5, "status.json", R"({"format": "dsc-run-1", "state": "stopped", "exit_code": 75})");
    write(5, "summary.json",
          R"({"status": "cancelled", "steps": 1, "vertex_to_cloud": {"mean": 0.25}})");

    const sweep::SweepResults results = sweep::collect_sweep(bench.folder.path() / "out");
    const sweep::SweepStates& states = results.states;
    const std::string table = sweep::results_csv(results);
    CAPTURE(table);
    CHECK(states.points == 6);
    CHECK(states.done == 1);
    CHECK(states.failed == 1);
    CHECK(states.unfinished == 3);
    CHECK(states.missing == 1);
    CHECK(lines(table) == 7);
    CHECK(table.substr(0, table.find('\n')) ==
          "index,folder,status,ended,error,initial_mesh.cells,output.surface,steps,interface_"
          "vertices,interface_"
          "faces,tets,"
          "min_tet_quality,inverted_tets,components,genus,volume,volume_initial,boundary_edges,"
          "nonmanifold_edges,"
          "nonmanifold_vertices,self_intersections,vertex_to_cloud.mean,vertex_to_cloud.max,cloud_"
          "to_surface.mean,"
          "cloud_to_surface.max,observers.analytic.radius_error,wall_s,cpu_s,peak_rss_mb");
    const std::string none(15, ',');
    CHECK(contains(table, "\n0,points/" + all[0] +
                              ",done,max_steps,,1,,2,,,,,,,0,0.1,,,,,,,,,,0.001,0.5,,\n"));
    CHECK(contains(table, "\n1,points/" + all[1] + ",failed,,run.vanished,2,,"));
    CHECK(contains(table, "\n2,points/" + all[2] + ",unfinished,,,3,\"[obj, ply]\"," + none));
    CHECK(contains(table, "\n3,points/" + all[3] + ",missing,,,4,," + none));
    CHECK(contains(table, "\n4,points/" + all[4] + ",unfinished,,,5,,"));
    CHECK(contains(table, "\n5,points/" + all[5] + ",stopped,cancelled,,6,,1,"));
    CHECK(contains(table, ",0.25,"));
    CHECK(contains(bench.fault([&] { sweep::collect_sweep(bench.folder.path()); }),
                   "DIR: does not contain jobs.tsv"));
}

TEST_CASE("groups: n, mean, deviation and interval of the repeats that are finished") {
    const Repeated sweep;
    const double volumes[] = {4.1, 3.9, 4.4, 4.0, 4.3, 7.0};
    for (std::size_t i = 0; i < 6; ++i) sweep.finish(i, volumes[i]);
    const std::string table = sweep::groups_csv(sweep.results());
    CAPTURE(table);
    CHECK(lines(table) == 3);
    CHECK(table.rfind("group,setting,n,velocity.factor,steps.mean,", 0) == 0);
    CHECK(table.find("seed") == std::string::npos);
    CHECK(number(table, 1, "n") == 5);
    CHECK(number(table, 1, "velocity.factor") == 0.1);
    // By hand: 20.7 / 5, root of 0.172 / 4, 2.776445 deviations of the mean.
    CHECK(number(table, 1, "volume.mean") == doctest::Approx(4.14));
    CHECK(number(table, 1, "volume.deviation") == doctest::Approx(std::sqrt(0.043)));
    CHECK(number(table, 1, "volume.low") == doctest::Approx(3.8825231));
    CHECK(number(table, 1, "volume.high") == doctest::Approx(4.3974769));
    CHECK(number(table, 1, "genus.deviation") == 0.0);
    CHECK(std::isnan(number(table, 1, "steps.mean")));
    CHECK(number(table, 2, "n") == 1);
    CHECK(number(table, 2, "setting") == 1);
    CHECK(number(table, 2, "volume.mean") == 7.0);
    CHECK(std::isnan(number(table, 2, "volume.deviation")));
}

TEST_CASE("compare: pairs of the same seed, by hand") {
    const Repeated sweep;
    CHECK(contains(sweep.bench.fault([&] { sweep::compare_settings(sweep.results(), 0, 1); }),
                   "settings 0 and 1: they have no finished points with the same seed"));
    // Seeds 1 to 5 of the first setting, then of the second; seed 5 is not finished in the second.
    const double volumes[] = {1.0, 2.0, 3.0, 4.0, 5.0, 1.5, 2.25, 2.875, 4.75};
    for (std::size_t i = 0; i < 9; ++i) sweep.finish(i, volumes[i]);
    const sweep::SettingsComparison c = sweep::compare_settings(sweep.results(), 0, 1);
    CHECK(c.first == "{velocity.factor: 0.1}");
    CHECK(c.second == "{velocity.factor: 0.2}");
    CHECK(c.pairs == 4);
    REQUIRE(c.figures.size() == 2);
    CHECK(c.figures[0].first == "genus");
    CHECK(c.figures[0].second.ranks.n == 0);
    CHECK(c.figures[0].second.signs.zero == 4);
    CHECK(c.figures[1].first == "volume");
    const statistics::PairedComparison& volume = c.figures[1].second;
    // Differences 0.5, 0.25, -0.125, 0.75; the rank of the negative one is 1: {} and {1} of 16.
    CHECK(volume.difference.mean == doctest::Approx(0.34375));
    CHECK(volume.ranks.statistic == 1.0);
    CHECK(volume.ranks.probability == 0.25);
    CHECK(volume.signs.positive == 3);
    CHECK(volume.signs.negative == 1);
    CHECK(volume.signs.probability == doctest::Approx(2.0 * 5.0 / 16.0));
    CHECK(contains(sweep.bench.fault([&] { sweep::compare_settings(sweep.results(), 0, 2); }),
                   "setting 2: the sweep has no setting with this number"));
}

TEST_CASE("truth: the figures of each result, kept until one of the surfaces changes") {
    const Bench bench;
    const std::string text =
        "truth: truth.obj\naxes: [{grid: {velocity.factor: [0.1, 0.2, 0.3]}}]\n";
    bench.folder.write("truth.obj", cube(0.0, 1.0));
    bench.expand(text);
    const std::vector<std::string> all = names(bench.load(text));
    const auto finish = [&](std::size_t i, const std::string& surface) {
        const std::string run = "out/points/" + all[i] + "/run/";
        bench.folder.write(run + "status.json", done);
        bench.folder.write(run + "summary.json", R"({"status": "max_steps", "steps": 1})");
        bench.folder.write(run + "result/surface.obj", surface);
    };
    finish(0, cube(0.0, 1.0));
    finish(1, cube(-0.1, 1.1));
    const auto table = [&] {
        return sweep::results_csv(sweep::collect_sweep(bench.folder.path() / "out"));
    };
    const std::string first = table();
    CAPTURE(first);
    CHECK(number(first, 1, "truth.chamfer_percent") == doctest::Approx(0.0));
    CHECK(number(first, 1, "truth.f_score_1_percent") == doctest::Approx(1.0));
    CHECK(number(first, 1, "truth.normal_consistency") == doctest::Approx(1.0).epsilon(1e-3));
    // The corners are root 3 times 0.1 away, which is 10 % of the diagonal; the faces 0.1.
    CHECK(number(first, 2, "truth.hausdorff_percent") < 10.0 + 1e-9);
    CHECK(number(first, 2, "truth.hausdorff_percent") > 9.0);
    CHECK(number(first, 2, "truth.completeness_percent") ==
          doctest::Approx(10.0 / std::sqrt(3.0)).epsilon(1e-9));
    CHECK(number(first, 2, "truth.f_score_1_percent") == 0.0);
    CHECK(cells(first, 3).size() <= cells(first, 0).size());
    CHECK(contains(cells(first, 3)[2], "missing"));

    const std::string kept = "out/points/" + all[1] + "/truth.json";
    std::string json = bench.folder.read(kept);
    const std::string key = "\"f_score_1_percent\": 0.0";
    REQUIRE(contains(json, key));
    json.replace(json.find(key), key.size(), "\"f_score_1_percent\": 0.33");
    bench.folder.write(kept, json);
    CHECK(number(table(), 2, "truth.f_score_1_percent") == 0.33);  // not measured again
    const std::filesystem::path runs[] = {bench.folder.path() / "out/points" / all[1] / "run",
                                          bench.folder.path() / "out"};
    const auto points = sweep::points_of_runs(runs);
    REQUIRE(points.size() == 2);
    CHECK_FALSE(points[1].has_value());
    const auto& point = points[0];
    REQUIRE(point.has_value());
    CHECK(point->index == 1);
    CHECK(point->overrides.at("velocity.factor").as_real() == 0.2);
    CHECK(point->truth[7] == std::pair<std::string, double>("f_score_1_percent", 0.33));
    finish(1, cube(0.0, 1.0));
    CHECK(number(table(), 2, "truth.f_score_1_percent") == doctest::Approx(1.0));
    bench.folder.write("truth.obj", cube(-0.1, 1.1));
    CHECK(number(table(), 1, "truth.f_score_1_percent") == 0.0);
    // A page is made without the figures of a truth that is gone.
    std::filesystem::remove(bench.folder.path() / "truth.obj");
    CHECK(sweep::points_of_runs(runs)[0]->truth.empty());
    CHECK_THROWS_AS(table(), IoError);
}
