// Bad experiments whose fault is not in their text alone: files, folders, plugins, the environment.
// The others are in tests/golden/errors.
#include <doctest/doctest.h>

#include "process.hpp"

using dsc::test::Cli;
using dsc::test::Result;

namespace {

const std::string good =
    "dsc: 1\n"
    "name: shrink\n"
    "input: {cloud: {sample: {shape: sphere, n: 500}}, normalize: {scale: 0.9}}\n"
    "initial_mesh: {type: grid, cells: 12}\n"
    "velocity: {type: point_cloud, alpha: 0.2}\n"
    "improvement: {type: dsc}\n"
    "schedule: [{steps: 1}]\n";

std::string with(const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return text;
}

Result run(const Cli& cli, const std::string& text, std::vector<std::string> more = {}) {
    cli.write("a.yaml", text);
    std::vector<std::string> arguments = {"run", "a.yaml", "-o", "out"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return cli.dsc(arguments);
}

/// Standard error of a run that must end with `code` and leave nothing behind.
std::string fault(const std::string& text, int code = 3,
                  const std::vector<std::string>& more = {}) {
    const Cli cli;
    const Result result = run(cli, text, more);
    CHECK(result.code == code);
    CHECK(result.out.empty());
    CHECK_FALSE(cli.exists("out"));
    return result.err;
}

}  // namespace

TEST_CASE("a variable that is not set") {
    const std::string text =
        fault(with("sample: {shape: sphere, n: 500}", "file: \"${DSC_DATA}/cow.obj\""));
    CHECK(text.find(R"(a.yaml:3:23: error: the environment variable 'DSC_DATA' is not set
    3 | input: {cloud: {file: "${DSC_DATA}/cow.obj"}, normalize: {scale: 0.9}}
      |                       ^~~~~~~~~~~~~~~~~~~~~  set it: export DSC_DATA=...
)") == 0);
    CHECK(text.find(
              "DSC_DATA is the folder with the thesis' clouds bunny.obj, teapot.obj and cow.obj") !=
          std::string::npos);
    CHECK(text.find("they are public") != std::string::npos);
}

TEST_CASE("an experiment that does not exist") {
    const Cli cli;
    const Result result = cli.dsc({"run", "none.yaml"});
    CHECK(result.code == 6);
    CHECK(result.err == "error: none.yaml: cannot read the configuration: the file does not exist; "
                        "name a readable YAML "
                        "file\n");
}

TEST_CASE("a plugin that does not load") {
    const Cli cli;
    cli.write("libdsc_text.so", "no library");
    const Result option = run(cli, good, {"--plugin", "libdsc_text.so"});
    CHECK(option.code == 4);
    CHECK(
        option.err ==
        "error: --plugin: DIR/libdsc_text.so: is not a shared library; give the file of a plugin, "
        "libdsc_NAME.so\n");
    const Result key = run(cli, good + "plugins: [missing/libdsc_x.so]\n");
    CHECK(key.code == 4);
    CHECK(key.err == "error: plugins: DIR/missing/libdsc_x.so: cannot be opened (No such file or "
                     "directory); check its "
                     "name and permissions\n");
    CHECK_FALSE(cli.exists("out"));
}

TEST_CASE("a velocity that needs a cloud without one") {
    const Cli cli;
    const Result result = run(
        cli,
        with("input: {cloud: {sample: {shape: sphere, n: 500}}, normalize: {scale: 0.9}}\n", ""));
    CHECK(result.code == 3);
    CHECK(result.err ==
          "error: velocity 'point_cloud': the experiment has no cloud; add input: {cloud: {file: "
          "...}}\n");
    CHECK_FALSE(dsc::test::looks_finished(cli.folder() / "out"));
}

TEST_CASE("a folder that is not ours is refused, nothing in it is touched") {
    const Cli cli;
    cli.write("out/thesis.tex", "text");
    const Result result = run(cli, good);
    CHECK(result.code == 2);
    CHECK(result.err == "error: out: is not empty and no run wrote it; nothing in it was changed; "
                        "name another folder with "
                        "-o or empty this one\n");
    CHECK(cli.read("out/thesis.tex") == "text");
    cli.write("file", "text");
    cli.write("a.yaml", good);
    CHECK(cli.dsc({"run", "a.yaml", "-o", "file"}).code == 2);
}

TEST_CASE("a run that fails takes the former result away") {
    const Cli cli;
    CHECK(run(cli, good, {"-q"}).code == 0);
    CHECK(dsc::test::looks_finished(cli.folder() / "out"));
    cli.write("flat.xyz", "0 0 0\n1 0 0\n0 1 0\n1 1 0\n");
    CHECK(run(cli, with("sample: {shape: sphere, n: 500}", "file: flat.xyz"), {"-q"}).code == 5);
    CHECK_FALSE(dsc::test::looks_finished(cli.folder() / "out"));
}
