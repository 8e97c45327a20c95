#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/run/experiment.hpp>
#include <dsc/run/sha256.hpp>

#include "fakes.hpp"

using namespace dsc;
using dsc::test::Folder;
using dsc::test::load_text;
using dsc::test::minimal;

namespace {

/// Message of the ConfigError that loading `text` ends in.
std::string fault(const std::string& text, const std::vector<std::string>& overrides = {}) {
    try {
        load_text(text, overrides);
    } catch (const ConfigError& error) {
        return error.what();
    }
    return "no error";
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("sha256 of known texts") {
    CHECK(run::sha256("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    CHECK(run::sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST_CASE("the schema of format 1 is sound") {
    CHECK(run::experiment_schema()->problems().empty());
}

TEST_CASE("a minimal experiment gets its defaults, its name from the file") {
    const run::LoadedExperiment loaded = load_text(minimal);
    const run::Experiment& e = loaded.experiment;
    CHECK(e.name == "test");
    CHECK(e.seed == 1);
    CHECK(e.format == 1);
    CHECK_FALSE(e.input.has_value());
    CHECK_FALSE(e.stop.has_value());
    CHECK(e.observers.empty());
    CHECK(e.initial_mesh.type == "box");
    CHECK(e.initial_mesh.params.at("cells").as_integer() == 12);
    REQUIRE(e.schedule.size() == 1);
    CHECK(e.schedule[0].steps == 2U);
    CHECK(e.output.surface == std::vector<std::string>{"obj", "ply"});
    CHECK(e.output.volume == std::vector<std::string>{"vtu", "dsc"});
    CHECK(loaded.warnings.empty());
}

TEST_CASE("columns: names and numbers, three or six of them, for a file alone") {
    const auto cloud = [](const std::string& text) {
        return minimal + "input: {cloud: {" + text + "}}\n";
    };
    const run::LoadedExperiment loaded = load_text(cloud("file: a.csv, columns: [x, 3, '2']"));
    CHECK(loaded.experiment.input->cloud.columns == std::vector<std::string>{"x", "3", "2"});
    CHECK(contains(run::resolved_text(loaded), "columns: [x, \"3\", \"2\"]"));
    const std::string rule = "'columns' requires 'file' and must name 3 or 6 columns";
    CHECK(contains(fault(cloud("file: a.csv, columns: [1, 2]")), rule));
    CHECK(contains(fault(cloud("sample: {}, columns: [1, 2, 3]")), rule));
    CHECK(contains(fault(cloud("file: a.csv, columns: [1, 2, 2.5]")), "must be a string, not 2.5"));
    CHECK(load_text(cloud("file: a.csv")).experiment.input->cloud.columns.empty());
}

TEST_CASE("volumes: every format, one that can be read back among them") {
    CHECK(load_text(minimal + "output: {volume: [mesh, msh, dsc]}\n").experiment.output.volume ==
          std::vector<std::string>{"mesh", "msh", "dsc"});
    CHECK(
        contains(fault(minimal + "output: {volume: [msh, mesh]}\n"), "'volume' needs vtu or dsc"));
    CHECK(contains(fault(minimal + "output: {volume: [mdpa]}\n"),
                   "is not one of vtu, dsc, msh, mesh"));
}

TEST_CASE("the resolved text reproduces the experiment") {
    const std::string text =
        minimal +
        "name: a.b-c_1\nseed: 7\nstop: {speed: 0.5}\nobservers: [{type: counter}]\n"
        "input: {cloud: {sample: {n: 50}, filters: [{type: every_nth}]}, normalize: {}}\n";
    const run::LoadedExperiment loaded =
        load_text(text, {"velocity.factor=0.25", "schedule.0.steps=9"});
    CHECK(loaded.experiment.velocity.params.at("factor").as_real() == 0.25);
    CHECK(loaded.experiment.schedule[0].steps == 9U);
    CHECK(loaded.experiment.input->normalize->scale == 0.9);
    CHECK(loaded.experiment.stop->patience == 3);
    const run::LoadedExperiment again = load_text(run::resolved_text(loaded));
    CHECK(again.resolved == loaded.resolved);
    CHECK(run::resolved_text(again) == run::resolved_text(loaded));
}

TEST_CASE("faults name the place and what is accepted") {
    CHECK(contains(fault("dsc: 1\n"), "'velocity' is missing"));
    CHECK(contains(fault("dsc: 2\n" + minimal.substr(7)), "dsc"));
    CHECK(contains(fault(minimal + "velocty: 1\n"),
                   ":6:1: error: unknown key 'velocty' in the experiment"));
    CHECK(contains(fault(minimal + "velocty: 1\n"), "did you mean 'velocity'?"));
    CHECK(contains(fault(minimal, {"velocity.type=linnear"}), "did you mean 'linear'?"));
    CHECK(contains(fault(minimal, {"velocity.factor=2"}), "[-1, 1]"));
    CHECK(contains(fault(minimal, {"velocity.factor=2"}), "command line"));
    CHECK(contains(fault(minimal, {"schedule=[]"}), "schedule"));
    CHECK(
        contains(fault(minimal, {"schedule=[{every: 2}]"}), "needs 'steps' or 'refine', or both"));
    CHECK(contains(fault(minimal, {"schedule=[{steps: 3, every: 2}]"}),
                   "'every' must be given if an item has both"));
    CHECK(contains(fault(minimal, {"schedule=[{steps: 3, refine: {type: all}}]"}),
                   "'every' must be given if an item has both"));
    CHECK(contains(fault(minimal, {"name=../x"}), "name must be 1 to 100 letters"));
    CHECK(contains(fault(minimal, {"name=.x"}), "name must be 1 to 100 letters"));
    CHECK(contains(fault(minimal, {"input={cloud: {}}"}), "exactly one of 'file' and 'sample'"));
    CHECK(contains(fault(minimal, {"input={cloud: {file: a.obj, sample: {}}}"}),
                   "exactly one of 'file' and 'sample'"));
    CHECK(contains(fault(minimal, {"input={cloud: {sample: {shape: cup}}}"}),
                   "'cup' is not one of teapot, sphere"));
    CHECK(contains(fault(minimal, {"input={cloud: {sample: {}}, normalize: {scale: 2}}"}),
                   "(0, 1.5]"));
    CHECK(contains(fault(minimal, {"input={cloud: {sample: {}, filters: [{type: voxels}]}}"}),
                   "every_nth"));
    CHECK(contains(fault(minimal, {"output.surface=[dxf]"}), "dxf"));
    CHECK(contains(fault(minimal, {"output.surface=[]"}), "surface"));
}

TEST_CASE("all faults at once") {
    const std::string text =
        fault(minimal + "speed: 1\n", {"velocity.factor=x", "initial_mesh.cells=0"});
    CHECK(contains(text, "unknown key 'speed'"));
    CHECK(contains(text, "factor"));
    CHECK(contains(text, "cells"));
    CHECK(contains(text, "3 errors; nothing was run"));
}

TEST_CASE("an unset DSC_DATA is explained") {
    const Folder folder;
    const std::string file =
        folder.write("a.yaml", minimal + "input: {cloud: {file: \"${DSC_DATA}/cow.obj\"}}\n");
    const dsc::test::Strategies strategies;
    config::YamlOptions options;
    options.environment = [](const std::string&) { return std::nullopt; };
    try {
        run::load_experiment(file, {}, strategies.loader(), options);
        FAIL("no error");
    } catch (const ConfigError& error) {
        CHECK(contains(error.what(), "a.yaml:6:"));
        CHECK(contains(
            error.what(),
            "DSC_DATA is the folder with the thesis' clouds bunny.obj, teapot.obj and cow.obj"));
        CHECK(contains(error.what(), "they are public"));
    }
    options.environment = [](const std::string& name) -> std::optional<std::string> {
        if (name == "DSC_DATA") return "/clouds";
        return std::nullopt;
    };
    CHECK(
        run::load_experiment(file, {}, strategies.loader(), options).experiment.input->cloud.file ==
        "/clouds/cow.obj");
}

TEST_CASE("all that format 1 can have written is accepted without a word") {
    const std::string text =
        minimal + "output: {checkpoint: {every: 5}, series: {every: 2}, report: true}\n";
    const run::LoadedExperiment loaded = load_text(text);
    CHECK(loaded.warnings.empty());
    CHECK(load_text(minimal + "output: {report: false}\n").warnings.empty());
}

TEST_CASE(
    "plugins are loaded before the strategies are checked, relative to the file that names them") {
    const Folder folder;
    const std::string file = folder.write("sub/a.yaml", minimal + "plugins: [../lib, /abs/b.so]\n");
    const dsc::test::Strategies strategies;
    const auto loaded = run::load_experiment(file, {}, strategies.loader());
    const std::vector<std::string> expected = {(folder.path() / "lib").string(), "/abs/b.so"};
    CHECK(strategies.asked == expected);
    CHECK(loaded.experiment.plugins == expected);
}

TEST_CASE("a plugin may be named as a Python file") {
    const Folder folder;
    const std::string file =
        folder.write("sub/a.yaml", minimal + "plugins: [{python: x.py}, y.py]\n");
    const dsc::test::Strategies strategies;
    const auto loaded = run::load_experiment(file, {}, strategies.loader());
    const std::string sub = (folder.path() / "sub").string();
    CHECK(strategies.asked == std::vector{sub + "/x.py", sub + "/y.py"});
    CHECK(loaded.experiment.plugins == strategies.asked);
    for (const char* wrong : {"{perl: x.pl}", "{python: 3}", "{python: x.py, more: 1}", "{}"}) {
        folder.write("sub/a.yaml", minimal + "plugins: [" + wrong + "]\n");
        CHECK_THROWS_AS(run::load_experiment(file, {}, strategies.loader()), ConfigError);
    }
}

TEST_CASE("the hash depends on what is computed, not on names of files") {
    const dsc::test::Strategies lookup;
    const Folder folder;
    const std::string one = folder.write("one.xyz", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n");
    const std::string two = folder.write("deep/two.xyz", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n");
    const std::string other = folder.write("other.xyz", "0 0 0\n1 0 0\n0 1 0\n0 0 2\n");
    const auto hash = [&](const std::string& text, const std::vector<std::string>& overrides = {}) {
        return run::config_hash(load_text(text, overrides), lookup);
    };
    const auto with = [&](const std::string& file) {
        return hash(minimal + "input: {cloud: {file: " + file + "}}\n");
    };
    CHECK(hash(minimal).size() == 64);
    CHECK(hash(minimal) == hash(minimal));
    CHECK(hash("seed: 1\n" + minimal) == hash(minimal));
    CHECK(hash(minimal, {"seed=2"}) != hash(minimal));
    CHECK(hash(minimal, {"velocity.factor=-0.05"}) == hash(minimal));
    CHECK(hash(minimal, {"velocity.factor=-0.06"}) != hash(minimal));
    CHECK(with(one) == with(two));
    CHECK(with(one) != with(other));
    CHECK_THROWS_AS(with("/none/at/all.xyz"), IoError);
    // A file parameter of a strategy counts by its content too.
    CHECK(hash(minimal, {"initial_mesh.file=" + one}) ==
          hash(minimal, {"initial_mesh.file=" + two}));
    CHECK(hash(minimal, {"initial_mesh.file=" + one}) !=
          hash(minimal, {"initial_mesh.file=" + other}));
    const auto files = run::input_files(
        load_text(minimal + "input: {cloud: {file: " + one + "}}\n", {"initial_mesh.file=" + two}),
        lookup);
    CHECK(files == std::vector<std::string>{one, two});
}
