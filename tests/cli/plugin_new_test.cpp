// dsc plugin new: what it writes and what it refuses. That the projects build and run is tested in
// tests/package.
#include <algorithm>

#include <doctest/doctest.h>

#include "process.hpp"

using dsc::test::Cli;
using dsc::test::Result;

namespace {

std::size_t entries(const Cli& cli) {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(cli.folder()), {}));
}

}  // namespace

TEST_CASE("a project for each kind, its names filled in, nothing beside it") {
    for (const char* kind : {"velocity", "curvature", "refinement", "initial_mesh", "improvement",
                             "observer", "filter"}) {
        const Cli cli;
        const Result result = cli.dsc({"plugin", "new", "my_flow2", "--kind", kind});
        CAPTURE(result.err);
        CHECK(result.code == 0);
        CHECK(result.out == "my_flow2/CMakeLists.txt\nmy_flow2/README.md\nmy_flow2/"
                            "experiment.yaml\nmy_flow2/strategy.cpp\n"
                            "my_flow2/strategy_test.cpp\n");
        CHECK(entries(cli) == 1);
        const std::string code = cli.read("my_flow2/strategy.cpp");
        CHECK(code.find("class MyFlow2") != std::string::npos);
        CHECK(code.find("DSC_PLUGIN(\"my_flow2\"") != std::string::npos);
        CHECK(cli.read("my_flow2/experiment.yaml").find("plugins: [build/libdsc_my_flow2.so]") !=
              std::string::npos);
        CHECK(cli.read("my_flow2/README.md").find("type: my_flow2") != std::string::npos);
    }
}

TEST_CASE("the class tells the kind, once") {
    const Cli cli;
    CHECK(cli.dsc({"plugin", "new", "wind_velocity", "--kind", "velocity"}).code == 0);
    CHECK(cli.read("wind_velocity/strategy.cpp").find("class WindVelocity final") !=
          std::string::npos);
    CHECK(cli.dsc({"plugin", "new", "params", "--kind", "initial_mesh"}).code == 0);
    CHECK(cli.read("params/strategy.cpp").find("class ParamsInitialMesh final") !=
          std::string::npos);
}

TEST_CASE("wrong names and kinds: exit 2, one line, nothing written") {
    const Cli cli;
    const auto refused = [&](const std::string& name, const std::string& kind) {
        const Result result = cli.dsc({"plugin", "new", name, "--kind", kind});
        CHECK(result.code == 2);
        CHECK(result.out.empty());
        CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
        return result.err;
    };
    for (const char* name :
         {"", "Flow", "2flow", "_flow", "my-flow", "my flow", "../flow", "fl\xc3\xb6w"}) {
        CAPTURE(name);
        CHECK(refused(name, "velocity").find("cannot be the name of a plugin") !=
              std::string::npos);
    }
    CHECK(refused(std::string(64, 'a'), "velocity").find("at most 63") != std::string::npos);
    CHECK(refused("flow2", "velocty") ==
          "error: --kind: there is no kind of strategy 'velocty'; did you mean 'velocity'? the "
          "kinds are "
          "velocity, curvature, refinement, initial_mesh, improvement, observer, filter\n");
    CHECK(refused("point_cloud", "velocity").find("is the name of a plugin that comes with dsc") !=
          std::string::npos);
    CHECK(cli.dsc({"plugin", "new", "flow2"}).code == 2);
    CHECK(entries(cli) == 0);
}

TEST_CASE("what is there already stays as it is") {
    const Cli cli;
    cli.write("flow2/notes.txt", "mine");
    cli.write("flow3", "a file");
    for (const char* name : {"flow2", "flow3"}) {
        const Result result = cli.dsc({"plugin", "new", name, "--kind", "velocity"});
        CHECK(result.code == 2);
        CHECK(result.err == std::string("error: ") + name +
                                ": already exists here; use another name or another folder\n");
    }
    CHECK(cli.read("flow2/notes.txt") == "mine");
    CHECK(cli.read("flow3") == "a file");
    CHECK(entries(cli) == 2);
}
