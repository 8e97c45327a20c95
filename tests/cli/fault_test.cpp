// A strategy that misbehaves: exit 4, a message that names it, no result.
#include <doctest/doctest.h>

#include "process.hpp"

using dsc::test::Cli;
using dsc::test::Result;

namespace {

Result run(const Cli& cli, const std::string& fault, int step = 1) {
    cli.write("a.yaml", "dsc: 1\nname: faulty\ninitial_mesh: {type: grid, cells: 12, half_width: "
                        "0.5}\nvelocity: {type: faulty, fault: " +
                            fault + ", step: " + std::to_string(step) +
                            "}\nimprovement: {type: dsc}\nschedule: [{steps: 3}]\n");
    return cli.dsc({"run", "a.yaml", "-o", "out", "-q", "--plugin", DSC_TEST_FAULTY});
}

}  // namespace

TEST_CASE("without a fault the plugin runs, and is told in the provenance") {
    const Cli cli;
    CHECK(run(cli, "none").code == 0);
    CHECK(cli.read("out/provenance.json").find("\"name\": \"faulty\"") != std::string::npos);
}

TEST_CASE("a strategy that throws") {
    const Cli cli;
    const Result result = run(cli, "throws");
    CHECK(result.code == 4);
    CHECK(result.err ==
          "error: velocity 'faulty' (plugin faulty 0.3.0, " DSC_TEST_FAULTY
          ", at 'velocity' in the experiment, a.yaml:4:11): evaluate at step 1 threw: division by "
          "zero; check its parameters or report this to the plugin's authors\n");
    CHECK_FALSE(dsc::test::looks_finished(cli.folder() / "out"));
    CHECK(cli.read("out/status.json").find("\"error_code\": \"strategy.threw\"") !=
          std::string::npos);
}

TEST_CASE("a strategy that returns NaN: the first vertex is named") {
    const Cli cli;
    const Result result = run(cli, "nan");
    CHECK(result.code == 4);
    CHECK(result.err.find("): evaluate at step 1 gave the displacement (") != std::string::npos);
    CHECK(result.err.find(") to vertex 7 (birth id ") != std::string::npos);
    CHECK(result.err.find("must be written with a finite number") != std::string::npos);
    CHECK_FALSE(dsc::test::looks_finished(cli.folder() / "out"));
}

TEST_CASE("a strategy that writes behind its output") {
    const Cli cli;
    const Result result = run(cli, "outside");
    CHECK(result.code == 4);
    CHECK(result.err.find(", a.yaml:4:11): evaluate at step 1 wrote outside the ") !=
          std::string::npos);
    CHECK(result.err.find(
              " entries of its output, for the block that begins with vertex 0 (birth id ") !=
          std::string::npos);
    CHECK(cli.read("out/status.json").find("\"error_code\": \"strategy.outside\"") !=
          std::string::npos);
}

TEST_CASE("after a strategy's fault the last good state is kept, and is a start for another run") {
    const Cli cli;
    CHECK(run(cli, "throws", 3).code == 4);
    CHECK_FALSE(dsc::test::looks_finished(cli.folder() / "out"));
    CHECK(cli.dsc({"info", "out/last_good/surface.obj", "--require-solid"}).code == 0);
    cli.write("b.yaml", "dsc: 1\ninitial_mesh: {type: dsc_file, file: "
                        "out/last_good/volume.dsc}\nvelocity: {type: normal}\n"
                        "improvement: {type: dsc}\nschedule: [{steps: 1}]\n");
    CHECK(cli.dsc({"run", "b.yaml", "-o", "again", "-q"}).code == 0);
    // A later run of the same folder takes it away.
    CHECK(run(cli, "none").code == 0);
    CHECK_FALSE(std::filesystem::exists(cli.folder() / "out" / "last_good"));
}

TEST_CASE("a strategy that ends the process: no success, and the run folder tells") {
    for (const std::string fault : {"exits", "quick_exits", "ends"}) {
        CAPTURE(fault);
        const Cli cli;
        const Result result = run(cli, fault, 2);
        CHECK(result.code == 4);
        CHECK(result.err.find("error: velocity 'faulty' (plugin faulty 0.3.0, ") == 0);
        CHECK(result.err.find("evaluate at step 2: ended the process") != std::string::npos);
        CHECK_FALSE(dsc::test::looks_finished(cli.folder() / "out"));
        CHECK(cli.read("out/status.json").find("\"error_code\": \"strategy.exit\"") !=
              std::string::npos);
        CHECK(cli.read("out/status.json").find("\"failed\"") != std::string::npos);
        CHECK(cli.dsc({"info", "out/last_good/surface.obj", "--require-solid"}).code == 0);
    }
}

TEST_CASE("what a plugin prints does not become data of the command") {
    const Cli cli;
    const Result result = run(cli, "prints");
    CHECK(result.code == 0);
    CHECK(result.out == "out\n");
    CHECK(result.err.find("** C **") != std::string::npos);
    CHECK(result.err.find("** C++ **") != std::string::npos);
}
