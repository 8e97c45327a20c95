#include <filesystem>
#include <stdexcept>
#include <string>

#include <doctest/doctest.h>

#include "support.hpp"

using namespace dsc::config;
using test::parse;

TEST_CASE(
    "all defaults are written out in the order of the schema, numbers in the type of their field") {
    const ConfigNode resolved = test::resolve(
        parse("velocity: {curvature: {type: implicit_fairing}, type: point_cloud, alpha: 1}\n"
              "schedule: [{steps: 1e2}]\n"
              "estimators: [{type: angular_defect, per_area: true}]\n"
              "axis: [1, 0, 0]\n"));
    CHECK(to_yaml(resolved) == "name: unnamed\n"
                               "seed: 1\n"
                               "cloud: null\n"
                               "axis: [1.0, 0.0, 0.0]\n"
                               "levels: [0.5, 1.0]\n"
                               "surface: [obj]\n"
                               "sizes: []\n"
                               "topology:\n"
                               "  open: true\n"
                               "  thickness: 0.7\n"
                               "schedule:\n"
                               "  - steps: 100\n"
                               "    every: 0\n"
                               "velocity:\n"
                               "  type: point_cloud\n"
                               "  alpha: 1.0\n"
                               "  beta: 0.0\n"
                               "  k: 8\n"
                               "  radius: null\n"
                               "  curvature:\n"
                               "    type: implicit_fairing\n"
                               "    area: mixed\n"
                               "estimators:\n"
                               "  - type: angular_defect\n"
                               "    per_area: true\n");
}

TEST_CASE("a resolved tree is resolved already") {
    const ConfigNode once = test::resolve(parse("velocity: {type: point_cloud}\n"));
    CHECK(test::resolve(once) == once);
    CHECK(test::resolve(parse(to_yaml(once))) == once);
}

TEST_CASE("given values keep their places, defaults have none, paths are those of the tree") {
    const ConfigNode resolved = test::resolve(parse("velocity: {type: point_cloud, alpha: 1}\n"));
    CHECK(resolved.at("velocity").at("alpha").position().describe() == "a.yaml:1:38");
    CHECK_FALSE(resolved.at("velocity").at("beta").position().known());
    CHECK(resolved.at("velocity").at("beta").path() == "velocity.beta");
    CHECK(resolved.at("topology").at("thickness").path() == "topology.thickness");
}

TEST_CASE("a partly given nested map keeps the other defaults of its owner") {
    const ConfigNode resolved =
        test::resolve(parse("velocity: {type: normal}\ntopology: {open: false}\n"));
    CHECK(resolved.at("topology").at("open").as_boolean() == false);
    CHECK(resolved.at("topology").at("thickness").as_real() == 0.7);
    CHECK(test::resolve(parse("velocity: {type: normal}\ntopology:\n"))
              .at("topology")
              .at("open")
              .as_boolean());
}

TEST_CASE("a relative file counts from the folder of the file that names it") {
    namespace fs = std::filesystem;
    const ConfigNode given =
        parse_yaml("velocity: {type: normal}\ncloud: ../data/x.obj\n", "/home/ada/exp/a.yaml");
    CHECK(test::resolve(given).at("cloud").as_string() == "/home/ada/data/x.obj");
    const ConfigNode built_in = given.with("cloud", "x.OBJ");
    CHECK(test::resolve(built_in).at("cloud").as_string() ==
          (fs::current_path() / "x.OBJ").string());
    const ConfigNode absolute = given.with("cloud", "/data/./x.ply");
    CHECK(test::resolve(absolute).at("cloud").as_string() == "/data/x.ply");
}

TEST_CASE("an old name is taken with a warning") {
    Diagnostics diagnostics;
    const ConfigNode resolved = validate_strategy(parse("{type: point_cloud, neighbours: 3}\n"),
                                                  "velocity", test::FakeLookup(), diagnostics);
    CHECK(resolved.at("k").as_integer() == 3);
    CHECK(resolved.find("neighbours") == nullptr);
    CHECK_FALSE(diagnostics.has_errors());
    CHECK(diagnostics.text(Severity::warning) ==
          "a.yaml:1:21: warning: 'neighbours' in velocity 'point_cloud' is now called 'k'\n"
          "    1 | {type: point_cloud, neighbours: 3}\n"
          "      |                     ^~~~~~~~~~  rename it\n");
}

TEST_CASE("all faults of all levels are found in one go") {
    Diagnostics diagnostics;
    ParamSchema<test::Experiment> schema;
    test::Experiment::declare(schema);
    validate(parse("nme: x\n"
                   "velocity: {type: point_cloud, alpha: 2, curvature: {type: implicit_fairing, "
                   "area: 3, x: 1}}\n"
                   "schedule: [{steps: 0}, {every: 3}, 5]\n"
                   "estimators: [{type: none}, {}]\n"),
             schema.schema(), test::FakeLookup(), diagnostics);
    std::vector<std::string> codes;
    for (const Diagnostic& d : diagnostics.all()) codes.push_back(d.code);
    CHECK(codes == std::vector<std::string>{
                       "config.unknown_key", "config.out_of_range", "config.check",
                       "config.wrong_type", "config.out_of_range", "config.unknown_key",
                       "config.wrong_type", "config.unknown_strategy", "config.missing"});
}

TEST_CASE("cross checks wait until their map is sound") {
    const std::string message = test::error_in("velocity: {type: point_cloud, beta: 1.0, k: 0}\n");
    CHECK(message.find("needs a curvature") == std::string::npos);
    CHECK(message.find("1 error; nothing was run") != std::string::npos);
}

TEST_CASE("a cross check that throws is the strategy's fault") {
    Schema schema;
    schema.check({[](const ConfigNode&) -> bool { throw std::runtime_error("oops"); }, "m"});
    Diagnostics diagnostics;
    CHECK(test::code_of([&] {
              validate(ConfigNode::map(), schema, NoStrategies(), diagnostics);
          }) == "strategy.check");
}

TEST_CASE("faults of nodes made by code name them by path") {
    CHECK(test::error_of([] {
              test::resolve(ConfigNode::map(
                  {{"velocity", ConfigNode::map({{"type", "point_cloud"}, {"k", 0}})}}));
          }) == "built in: error: 'velocity.k': 0 is below the minimum 1\n"
                "      note: accepted: integer, [1, 512], default 8\n"
                "1 error; nothing was run");
}

TEST_CASE("what an integer member cannot hold is refused") {
    CHECK(test::error_in("velocity: {type: normal}\nseed: 4294967296\n")
              .find("'seed': 4294967296 is above the maximum 4294967295") != std::string::npos);
    CHECK(test::error_in("velocity: {type: normal}\nsizes: [3000000000]\n")
              .find("'sizes.0': 3000000000 is above the maximum 2147483647") != std::string::npos);
    CHECK(test::error_in("velocity: {type: normal}\nseed: 1e30\n")
              .find("'seed' must be an integer, not 1e+30") != std::string::npos);
}

TEST_CASE("hints at numbers that are written in another way") {
    const auto hint = [](const std::string& text) {
        const std::string message =
            test::error_in("velocity: {type: point_cloud, alpha: " + text + "}\n");
        const std::size_t begin = message.find("~  ");
        return begin == std::string::npos
                   ? message
                   : message.substr(begin + 3, message.find('\n', begin) - begin - 3);
    };
    CHECK(hint("'0.5'") == "remove the quotes");
    CHECK(hint("-.5") == "write -0.5");
    CHECK(hint("+0.5") == "write 0.5");
    CHECK(hint("5.") == "write 5.0");
    CHECK(hint("'0,5'") == "write 0.5");
    CHECK(hint("007") == "write 7");
    CHECK(hint("5.e3") == "write 5.0e3");
    CHECK(hint("half") == "accepted: real, (0, 1], default 0.2");
}

TEST_CASE("summaries of fields say what is accepted") {
    ParamSchema<test::PointCloud> schema;
    test::PointCloud::declare(schema);
    const auto summary = [&](const std::string& name) {
        return schema.schema().find(name)->summary();
    };
    CHECK(summary("alpha") == "real, (0, 1], default 0.2");
    CHECK(summary("radius") == "real in length, above 0, optional");
    CHECK(summary("curvature") == "curvature strategy, optional");
    ParamSchema<test::Experiment> experiment;
    test::Experiment::declare(experiment);
    CHECK(experiment.schema().find("surface")->summary() ==
          "list of strings out of obj | ply | off, default [obj]");
    CHECK(experiment.schema().find("cloud")->summary() == "file (.obj .ply), optional");
    CHECK(experiment.schema().find("topology")->summary() == "map");
}

TEST_CASE("one strategy by itself") {
    Diagnostics diagnostics;
    const ConfigNode resolved =
        validate_strategy(parse("{type: normal}\n"), "velocity", test::FakeLookup(), diagnostics);
    CHECK(resolved == ConfigNode::map({{"type", "normal"}, {"speed", 1.0}}));
    validate_strategy(parse("{type: x}\n"), "observer", test::FakeLookup(), diagnostics);
    CHECK(diagnostics.text(Severity::error) == "a.yaml:1:8: error: unknown observer 'x'\n"
                                               "    1 | {type: x}\n"
                                               "      |        ^\n"
                                               "      note: no observer strategy is loaded\n");
}
