#include <array>
#include <cmath>
#include <set>

#include <doctest/doctest.h>

#include <dsc/config/overrides.hpp>

#include "bench.hpp"

using namespace dsc;
using dsc::test::Bench;
using dsc::test::contains;
using dsc::test::lines;
using dsc::test::minimal;
using dsc::test::names;

namespace {

std::vector<std::string> texts(const sweep::Sweep& sweep) {
    std::vector<std::string> all;
    for (const sweep::SweepPoint& point : sweep.points)
        all.push_back(config::flow_text(point.overrides));
    return all;
}

const std::string six =
    "axes: [{grid: {velocity.factor: [0.1, 0.2, 0.3], initial_mesh.cells: [6, 8]}}]\n";

/// An observer whose figures depend on the seed.
class Noisy final : public hooks::Observer {
public:
    static constexpr hooks::Traits traits = {.stochastic = true};
    struct Params {};
    static void declare(config::ParamSchema<Params>&) {}
    Noisy(const Params&, const plugin::Setup&) {}
    void begin(const hooks::StepContext&) override {}
    hooks::Figures step(const hooks::StepContext&, const hooks::StepFigures&) override {
        return {};
    }
    hooks::Figures end(const hooks::StepContext&) override { return {}; }
};

}  // namespace

TEST_CASE("the schema of a sweep is sound") { CHECK(sweep::sweep_schema()->problems().empty()); }

TEST_CASE("axes: grid, zip and list, multiplied, the last fastest") {
    const Bench bench;
    CHECK(texts(bench.load("axes:\n"
                           "  - zip: {velocity.factor: [0.1, 0.2], initial_mesh.half: [0.5, 1]}\n"
                           "  - list: [{seed: 3}, {seed: 4, initial_mesh.cells: 6}]\n")) ==
          std::vector<std::string>{
              "{velocity.factor: 0.1, initial_mesh.half: 0.5, seed: 3}",
              "{velocity.factor: 0.1, initial_mesh.half: 0.5, seed: 4, initial_mesh.cells: 6}",
              "{velocity.factor: 0.2, initial_mesh.half: 1, seed: 3}",
              "{velocity.factor: 0.2, initial_mesh.half: 1, seed: 4, initial_mesh.cells: 6}"});
    CHECK(bench.load(six).points.size() == 6);
    CHECK(texts(bench.load("repeat: 3\n")) ==
          std::vector<std::string>{"{seed: 1}", "{seed: 2}", "{seed: 3}"});
    CHECK(texts(bench.load("seeds: [7, 5]\n")) ==
          std::vector<std::string>{"{seed: 7}", "{seed: 5}"});
}

TEST_CASE("a grid takes ranges, linear and logarithmic, both ends in them") {
    const Bench bench;
    CHECK(texts(bench.load("axes: [{grid: {velocity.factor: {from: 1.0e-5, to: 1.0e-2, count: 4, "
                           "scale: log}}}]\n")) ==
          std::vector<std::string>{"{velocity.factor: 0.00001}", "{velocity.factor: 0.0001}",
                                   "{velocity.factor: 0.001}", "{velocity.factor: 0.01}"});
    CHECK(
        texts(bench.load(
            "axes: [{grid: {initial_mesh.cells: {from: 6, to: 8, count: 3, integer: true}}}]\n")) ==
        std::vector<std::string>{"{initial_mesh.cells: 6}", "{initial_mesh.cells: 7}",
                                 "{initial_mesh.cells: 8}"});
}

TEST_CASE("random draws lie in their range, spread over it, and stay when there are more of them") {
    const Bench bench;
    const auto sweep = [&](int n, int seed, const std::string& range) {
        return bench.load("axes: [{random: {n: " + std::to_string(n) + ", seed: " +
                          std::to_string(seed) + ", ranges: {velocity.factor: " + range + "}}}]\n");
    };
    const std::string log = "{from: 1.0e-4, to: 1.0, scale: log}";
    const sweep::Sweep few = sweep(20, 1, log), many = sweep(400, 1, log),
                       other = sweep(20, 2, log);
    REQUIRE(many.points.size() == 400);
    const std::vector<std::string> start = names(many);
    CHECK(std::equal(few.points.begin(), few.points.end(), many.points.begin(),
                     [](const auto& a, const auto& b) { return a.name == b.name; }));
    CHECK(names(few) != names(other));
    std::array<int, 4> decades{};
    for (const sweep::SweepPoint& point : many.points) {
        const double value = point.overrides.at("velocity.factor").as_real();
        REQUIRE(value >= 1e-4);
        REQUIRE(value <= 1.0);
        ++decades.at(static_cast<std::size_t>(std::min(3.0, std::floor(std::log10(value) + 4))));
    }
    for (const int count : decades) CHECK(std::abs(count - 100) < 35);  // four deviations

    std::array<int, 3> cells{};
    const sweep::Sweep integers =
        bench.load("axes: [{random: {n: 300, ranges: {initial_mesh.cells: {from: 6, to: 8, "
                   "integer: true}, velocity.factor: {from: "
                   "0, to: 1}}}}]\n");
    for (const sweep::SweepPoint& point : integers.points)
        ++cells.at(
            static_cast<std::size_t>(point.overrides.at("initial_mesh.cells").as_integer() - 6));
    for (const int count : cells) CHECK(std::abs(count - 100) < 35);
}

TEST_CASE("a point's name depends on its overrides alone") {
    const Bench bench;
    const std::vector<std::string> all = names(bench.load(six));
    CHECK(std::set<std::string>(all.begin(), all.end()).size() == 6);
    for (const std::string& name : all) {
        CHECK(name.size() == 12);
        CHECK(name.find_first_not_of("0123456789abcdef") == std::string::npos);
    }
    // Other order of keys and values, another way to write a number, another axis, something set
    // for all.
    const std::vector<std::string> again =
        names(bench.load("set: {initial_mesh.half: 0.6}\naxes: [{list: [{initial_mesh.cells: 6.0, "
                         "velocity.factor: 1.0e-1}]}]\n"));
    CHECK(again == std::vector<std::string>{all[0]});
    CHECK(names(bench.load(
              "axes: [{list: [{velocity.factor: 0.1, initial_mesh.cells: 7}]}]\n"))[0] != all[0]);
}

TEST_CASE("equal points are one") {
    const Bench bench;
    const sweep::Sweep sweep = bench.load("axes: [{list: [{seed: 1}, {seed: 2}, {seed: 1.0}]}]\n");
    CHECK(sweep.points.size() == 2);
    CHECK(sweep.repeated == 1);
}

TEST_CASE("faults of a sweep file, all at once, with their places") {
    const Bench bench;
    CHECK(bench.load_fault("axes: [{gird: {a: [1]}}]\nrepaet: 2\n") ==
          "DIR/sweep.yaml:3:9: error: unknown key 'gird' in 'axes.0'\n"
          "    3 | axes: [{gird: {a: [1]}}]\n"
          "      |         ^~~~  did you mean 'grid'? (map, optional)\n"
          "      note: accepted keys: grid, zip, list, random\n"
          "DIR/sweep.yaml:4:1: error: unknown key 'repaet' in the sweep\n"
          "    4 | repaet: 2\n"
          "      | ^~~~~~  did you mean 'repeat'? (integer, [1, 20000], optional)\n"
          "      note: accepted keys: sweep, base, truth, set, axes, seeds, repeat\n"
          "2 errors; nothing was run");
    const std::string several = bench.load_fault(
        "axes:\n"
        "  - grid: {velocity.factor: 0.1, seed: []}\n"
        "  - zip: {initial_mesh.cells: [6, 7], initial_mesh.half: [0.5, 0.6, 0.7]}\n"
        "  - random: {ranges: {name: {from: 2, to: 1}, x: {from: 0, to: 1, scale: log}, y: {to: 1, "
        "size: 2}}}\n");
    for (const char* part :
         {":4:29: error: the values of 'velocity.factor' must be a list",
          ":4:40: error: 'seed' has no values",
          ":5:58: error: 'initial_mesh.half' has 3 values and 'initial_mesh.cells' has 2",
          "the range of 'name': 'to' must be above 'from'",
          "the range of 'x': 'from' must be above 0 on a logarithmic scale",
          "unknown key 'size' in the range of 'y'", "y.from' is missing in the range of 'y'",
          "7 errors"}) {
        CAPTURE(several);
        CHECK_MESSAGE(contains(several, part), part);
    }
    CHECK(contains(bench.load_fault("axes: [{grid: {a: [1]}, list: [{b: 1}]}]\n"),
                   "'axes.0': an axis is exactly one of 'grid', 'zip', 'list' and 'random'"));
    CHECK(contains(bench.load_fault(""), "a sweep needs 'axes', 'seeds' or 'repeat'"));
    CHECK(contains(bench.load_fault("repeat: 2\nseeds: [1]\n"),
                   "'seeds' and 'repeat' must not both be given"));
    CHECK(contains(bench.load_fault("axes: [{grid: {}}]\n"), "grid names no key"));
    CHECK(contains(
        bench.load_fault(
            "axes: [{grid: {a: {from: 1, to: 2, count: 300}, b: {from: 1, to: 2, count: 300}}}]\n"),
        "more than 20000 combinations"));
}

TEST_CASE("an override that would undo an earlier one is refused") {
    const Bench bench;
    CHECK(contains(bench.load_fault("axes: [{grid: {seed: [1, 2]}}]\nrepeat: 2\n"),
                   ":4:9: error: 'seed' is already set by an earlier axis"));
    CHECK(
        contains(bench.load_fault(
                     "set: {velocity.factor: 1}\naxes: [{list: [{velocity: {type: linear}}]}]\n"),
                 ":4:17: error: 'velocity' would undo 'velocity.factor', which is set before it"));
    CHECK(contains(
        bench.load_fault("axes: [{grid: {velocity.factor: [1], velocity: [{type: linear}]}}]\n"),
        "'velocity' would undo 'velocity.factor'"));
    CHECK(bench.load("axes: [{grid: {velocity: [{type: linear}], velocity.factor: [1, 2]}}]\n")
              .points.size() == 2);
    CHECK(bench.load("axes: [{list: [{velocity.factor: 1}, {velocity: {type: linear}}]}]\n")
              .points.size() == 2);
}

TEST_CASE("expand: a folder a point that loads as the experiment, and a table") {
    const Bench bench;
    const sweep::Sweep sweep = bench.load("set: {schedule.0.steps: 3}\n" + six);
    const sweep::Expansion done =
        sweep::expand_sweep(sweep, bench.experiments(sweep), bench.folder.path() / "out");
    CHECK(done.added == 6);
    CHECK(done.kept == 0);
    CHECK(done.others == 0);
    CHECK(lines(bench.table()) == 7);
    const std::string first = sweep.points[0].name;
    CHECK(
        contains(bench.table(), "index\tfolder\toverrides\n0\tpoints/" + first +
                                    "\t{velocity.factor: 0.1, initial_mesh.cells: 6}\n1\tpoints/"));
    const std::string file =
        (bench.folder.path() / "out/points" / first / "experiment.yaml").string();
    const run::LoadedExperiment loaded = run::load_experiment(file, {}, bench.strategies.loader());
    CHECK(loaded.experiment.name == "base");
    CHECK(loaded.experiment.schedule.at(0).steps == 3U);
    CHECK(loaded.resolved.at("velocity").at("factor").as_real() == 0.1);
    CHECK(loaded.resolved.at("initial_mesh").at("cells").as_integer() == 6);
    CHECK(contains(
        bench.folder.read("out/points/" + first + "/experiment.yaml"),
        "# Point " + first + " of a sweep: {velocity.factor: 0.1, initial_mesh.cells: 6}\n"));
}

TEST_CASE("expand again: nothing is touched; with more points the table grows at its end") {
    const Bench bench;
    bench.expand(six);
    const std::string table = bench.table();
    const auto written = std::filesystem::last_write_time(bench.folder.path() / "out/jobs.tsv");
    CHECK(bench.expand(six).kept == 6);
    CHECK(bench.table() == table);
    CHECK(std::filesystem::last_write_time(bench.folder.path() / "out/jobs.tsv") == written);

    const sweep::Expansion more = bench.expand(
        "axes: [{grid: {initial_mesh.cells: [5, 6, 8], velocity.factor: [0.1, 0.2, 0.3]}}]\n");
    CHECK(more.added == 3);
    CHECK(more.kept == 6);
    CHECK(bench.table().substr(0, table.size()) == table);
    CHECK(lines(bench.table()) == 10);

    const sweep::Expansion fewer =
        bench.expand("axes: [{grid: {initial_mesh.cells: [5], velocity.factor: [0.1]}}]\n");
    CHECK(fewer.kept == 1);
    CHECK(fewer.others == 8);
    CHECK(lines(bench.table()) == 10);
}

TEST_CASE("a point that was started stays the experiment that it is") {
    const Bench bench;
    bench.expand(six);
    const std::string name = bench.load(six).points[2].name;
    bench.folder.write("base.yaml", minimal + "seed: 9\n");
    CHECK(bench.expand(six).kept == 6);  // none was started
    const std::string file = "out/points/" + name + "/experiment.yaml";
    const std::string nine = bench.folder.read(file);
    CHECK(contains(nine, "seed: 9\n"));

    bench.folder.write("out/points/" + name + "/run/status.json",
                       R"({"format": "dsc-run-1", "state": "running"})");
    CHECK(bench.expand(six).kept == 6);
    bench.folder.write("base.yaml", minimal + "seed: 10\n");
    const std::string message = bench.expand_fault(six);
    CHECK(contains(message, "1 point was started (DIR/out/points/" + name + ")"));
    CHECK(bench.folder.read(file) == nine);
    CHECK(contains(
        bench.folder.read("out/points/" + bench.load(six).points[0].name + "/experiment.yaml"),
        "seed: 9\n"));
}

TEST_CASE("faults of points: all at once, each once, at the value in the sweep file; nothing is "
          "written") {
    const Bench bench;
    const std::string message = bench.expand_fault(
        "axes:\n"
        "  - grid: {initial_mesh.cells: [6, 600, many], velocity.facter: [1, 2]}\n"
        "  - grid: {schedule.4.steps: [3]}\n");
    CAPTURE(message);
    CHECK(contains(
        message, "DIR/sweep.yaml:5:12: error: 'schedule' is a list of 1 item; it has no item '4'"));
    CHECK(contains(message, "in the point {initial_mesh.cells: 6, velocity.facter: 1, "
                            "schedule.4.steps: 3} and 5 others"));
    CHECK(contains(message, "DIR/sweep.yaml:4:48: error: unknown key 'facter'"));
    CHECK(contains(message, "4 errors; nothing was written"));
    CHECK_FALSE(std::filesystem::exists(bench.folder.path() / "out"));

    const std::string three = bench.expand_fault(
        "axes: [{grid: {initial_mesh.cells: [6, 600, many], velocity.facter: [1, 2]}}]\n");
    CAPTURE(three);
    CHECK(contains(
        three, "DIR/sweep.yaml:3:40: error: 'initial_mesh.cells': 600 is above the maximum 100"));
    CHECK(contains(three, "DIR/sweep.yaml:3:45: error: 'initial_mesh.cells' must be an integer, "
                          "not the string 'many'"));
    CHECK(contains(three, "DIR/sweep.yaml:3:52: error: unknown key 'facter' in velocity 'linear'"));
    CHECK(contains(three, "did you mean 'factor'?"));
    CHECK(contains(three, "3 errors; nothing was written"));
    CHECK_FALSE(std::filesystem::exists(bench.folder.path() / "out"));
}

TEST_CASE("a file that is not there is a fault of input and output") {
    const Bench bench;
    const std::string text = "axes: [{grid: {initial_mesh.file: [a.txt, b.txt]}}]\n";
    bench.folder.write("a.txt", "");
    const sweep::Sweep sweep = bench.load(text);
    CHECK_THROWS_AS(bench.experiments(sweep), IoError);
    CHECK(contains(bench.expand_fault(text), "DIR/b.txt does not exist"));
    bench.folder.write("b.txt", "");
    CHECK(bench.expand(text).added == 2);
    bench.folder.write("sweep.yaml", "sweep: 1\nbase: nowhere.yaml\nrepeat: 1\n");
    CHECK(contains(bench.fault([&] {
        bench.experiments(sweep::load_sweep((bench.folder.path() / "sweep.yaml").string()));
    }),
                   "nowhere.yaml"));
}

TEST_CASE("a folder with something else in it, or a damaged table, is refused") {
    const Bench bench;
    bench.folder.write("out/mine.txt", "precious");
    CHECK(contains(bench.expand_fault(six), "DIR/out: is not empty and does not contain a sweep"));
    CHECK(bench.folder.read("out/mine.txt") == "precious");
    std::filesystem::remove(bench.folder.path() / "out/mine.txt");
    bench.folder.write("out/.jobs.tsv.4711-0.tmp", "ind");  // of a call that was killed
    CHECK(bench.expand(six).added == 6);
    CHECK_FALSE(std::filesystem::exists(bench.folder.path() / "out/.jobs.tsv.4711-0.tmp"));
    std::filesystem::remove_all(bench.folder.path() / "out");
    for (const char* text :
         {"", "index\tfolder\n", "index\tfolder\toverrides\n1\tpoints/0123456789ab\t{a: 1}\n",
          "index\tfolder\toverrides\n0\t../0123456789ab\t{a: 1}\n",
          "index\tfolder\toverrides\n0\tpoints/0123456789ab\t[1]\n",
          "index\tfolder\toverrides\n0\tpoints/0123456789ab\t{a: 1}"}) {
        CAPTURE(text);
        bench.folder.write("out/jobs.tsv", text);
        CHECK(contains(bench.expand_fault(six), "DIR/out/jobs.tsv:"));
        CHECK(bench.folder.read("out/jobs.tsv") == text);
    }
    // What an interrupted call leaves is gone on with.
    bench.folder.write("out/jobs.tsv", "index\tfolder\toverrides\n");
    CHECK(bench.expand(six).added == 6);
}

TEST_CASE("repeats of a deterministic run are refused, with what makes them differ") {
    Bench bench;
    bench.folder.write("cloud.xyz", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n");
    const auto fault = [&](const std::string& base, const std::string& text) {
        bench.folder.write("base.yaml", minimal + base);
        return bench.expand_fault(text);
    };
    const std::string three = fault("", "repeat: 3\n");
    CAPTURE(three);
    CHECK(contains(three, "DIR/sweep.yaml:3:9: error: runs that differ only in their seeds would "
                          "all be the same"));
    CHECK(contains(three, "note: in the point {seed: 2} and 1 other"));
    CHECK(contains(three, "1 error; nothing was written"));
    const std::string file = "input: {cloud: {file: cloud.xyz}, normalize: {scale: 0.9}}\n";
    CHECK(contains(fault(file, "seeds: [4, 7]\n"), "set input.cloud.vary: {subsample: 0.9"));
    CHECK(contains(fault("", "axes: [{grid: {seed: [1, 2]}}]\n"), "would all be the same"));
    CHECK_FALSE(std::filesystem::exists(bench.folder.path() / "out"));

    // One run per setting, another cloud per seed, and what depends on the seed.
    CHECK(fault("", "repeat: 1\naxes: [{grid: {velocity.factor: [0.1, 0.2]}}]\n") == "no error");
    std::filesystem::remove_all(bench.folder.path() / "out");
    CHECK(fault("", "axes: [{zip: {velocity.factor: [0.1, 0.2], seed: [1, 2]}}]\n") == "no error");
    std::filesystem::remove_all(bench.folder.path() / "out");
    CHECK(fault(file, "repeat: 3\nset: {input.cloud.vary: {}}\n") == "no error");
    std::filesystem::remove_all(bench.folder.path() / "out");
    CHECK(fault("input: {cloud: {sample: {n: 100}}}\n", "repeat: 3\n") == "no error");
    std::filesystem::remove_all(bench.folder.path() / "out");
    plugin::Registrar& registrar = bench.strategies;
    registrar.add<Noisy>("noisy", "depends on the seed");
    CHECK(fault("observers: [{type: counter}, {type: noisy}]\n", "repeat: 3\n") == "no error");
}

TEST_CASE("truth: of the sweep or of an axis, relative to the sweep file, never in an experiment") {
    const Bench bench;
    for (const char* name : {"a.obj", "b.obj"}) bench.folder.write(name, "v 0 0 0\n");
    const sweep::Sweep all = bench.load("truth: a.obj\n" + six);
    for (const sweep::SweepPoint& point : all.points)
        CHECK(point.truth.value.as_string() == (bench.folder.path() / "a.obj").string());
    CHECK(names(all) == names(bench.load(six)));
    bench.expand("truth: a.obj\n" + six);
    const std::string point = "out/points/" + all.points[3].name;
    CHECK(contains(bench.folder.read(point + "/truth.json"),
                   "\"mesh\": \"" + (bench.folder.path() / "a.obj").string() + "\""));
    CHECK(bench.folder.read(point + "/experiment.yaml").find("truth") == std::string::npos);
    CHECK(bench.expand("truth: b.obj\n" + six).kept == 6);
    CHECK(contains(bench.folder.read(point + "/truth.json"), "b.obj"));
    CHECK(bench.expand(six).kept == 6);
    CHECK_FALSE(std::filesystem::exists(bench.folder.path() / point / "truth.json"));

    const std::string zip = "axes: [{zip: {velocity.factor: [0.1, 0.2], truth: [a.obj, b.obj]}}]\n";
    const sweep::Sweep each = bench.load(zip);
    REQUIRE(each.points.size() == 2);
    CHECK(each.points[1].truth.value.as_string() == (bench.folder.path() / "b.obj").string());
    CHECK(bench.experiments(each).size() == 2);
    CHECK(contains(bench.load_fault("truth: a.obj\n" + zip),
                   "'truth' is already set by an earlier axis"));
    CHECK(contains(bench.load_fault("axes: [{grid: {truth: [3]}}]\n"),
                   "'truth' must be the name of a file"));
    CHECK(contains(bench.expand_fault("truth: c.obj\n" + six), "DIR/c.obj does not exist"));
}
