// dsc sweep on real experiments: expand, run some, collect.
#include <algorithm>
#include <sstream>

#include <doctest/doctest.h>

#include "process.hpp"

using dsc::test::Cli;
using dsc::test::Result;
namespace fs = std::filesystem;

namespace {

constexpr const char* base =
    "dsc: 1\ninitial_mesh: {type: grid, cells: 10, shape: cube, half_width: 0.8}\nvelocity: {type: "
    "average, part: 0.5}\n"
    "improvement: {type: dsc}\nschedule: [{steps: 2}]\noutput: {surface: [obj], volume: [dsc]}\n";

std::vector<std::string> lines(const std::string& text) {
    std::vector<std::string> all;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) all.push_back(line);
    return all;
}

/// The second column of a line of the job table.
std::string folder_of(const std::string& line) {
    const std::size_t begin = line.find('\t') + 1;
    return line.substr(begin, line.find('\t', begin) - begin);
}

}  // namespace

TEST_CASE("a sweep of 12 points: expand, run two of them, collect") {
    const Cli cli;
    cli.write("base/cube.yaml", base);
    cli.write("a.yaml",
              "sweep: 1\nbase: base/cube.yaml\naxes:\n"
              "  - grid: {velocity.part: [0.25, 0.5, 0.75], initial_mesh.cells: [10, 12], "
              "schedule.0.steps: [2, 3]}\n");
    const Result check = cli.dsc({"sweep", "expand", "a.yaml", "--check"});
    CHECK(check.code == 0);
    CHECK(check.out == "a.yaml: valid, 12 points\n");
    CHECK_FALSE(cli.exists("out"));

    const Result expand = cli.dsc({"sweep", "expand", "a.yaml", "-o", "out"});
    CHECK(expand.code == 0);
    CHECK(expand.out == "out/jobs.tsv\n");
    CHECK(expand.err.find("12 points: 12 new, 0 kept") != std::string::npos);
    const std::string table = cli.read("out/jobs.tsv");
    const std::vector<std::string> rows = lines(table);
    REQUIRE(rows.size() == 13);
    CHECK(rows[1].find("\t{velocity.part: 0.25, initial_mesh.cells: 10, schedule.0.steps: 2}") !=
          std::string::npos);
    for (std::size_t i = 1; i < rows.size(); ++i)
        CHECK(cli.dsc({"run", "out/" + folder_of(rows[i]) + "/experiment.yaml", "--check"}).code ==
              0);

    for (const std::size_t row : {1U, 6U}) {
        const std::string point = "out/" + folder_of(rows[row]);
        CHECK(cli.dsc({"run", point + "/experiment.yaml", "-o", point + "/run", "-q"}).code == 0);
    }
    CHECK(cli.dsc({"sweep", "expand", "a.yaml", "-o", "out"}).code == 0);
    CHECK(cli.read("out/jobs.tsv") == table);

    const Result collect = cli.dsc({"sweep", "collect", "out", "-o", "results.csv"});
    CHECK(collect.code == 0);
    CHECK(collect.out == "results.csv\n");
    CHECK(collect.err.find("12 points: 2 done, 0 failed, 0 unfinished, 10 not started") !=
          std::string::npos);
    const std::vector<std::string> results = lines(cli.read("results.csv"));
    REQUIRE(results.size() == 13);
    CHECK(results[0].find("index,folder,status,ended,error,velocity.part,initial_mesh.cells,"
                          "schedule.0.steps,steps,") == 0);
    CHECK(results[1].find("0," + folder_of(rows[1]) + ",done,max_steps,,0.25,10,2,2,") == 0);
    CHECK(results[6].find("5," + folder_of(rows[6]) + ",done,max_steps,,0.5,10,3,3,") == 0);
    CHECK(results[2].find("1," + folder_of(rows[2]) + ",missing,,,0.25,10,3,,") == 0);
    for (const std::string& line : results)
        CHECK(std::count(line.begin(), line.end(), ',') ==
              std::count(results[0].begin(), results[0].end(), ','));
    CHECK(cli.dsc({"sweep", "collect", "out"}).out == cli.read("results.csv"));
    CHECK(cli.dsc({"sweep", "collect", "out", "-o", "none/results.csv"}).code == 6);
}

TEST_CASE("a sweep with faults: exit 3, all of them, and nothing is written") {
    const Cli cli;
    cli.write("cube.yaml", base);
    cli.write("a.yaml", "sweep: 1\nbase: cube.yaml\naxes: [{grid: {velocity.prat: [0.25, 0.5], "
                        "initial_mesh.cells: [6, -8]}}]\n");
    const Result expand = cli.dsc({"sweep", "expand", "a.yaml", "-o", "out"});
    CHECK(expand.code == 3);
    CHECK(expand.out.empty());
    CHECK(expand.err.find("a.yaml:3:16: error: unknown key 'prat' in velocity 'average'") !=
          std::string::npos);
    CHECK(expand.err.find("did you mean 'part'?") != std::string::npos);
    CHECK(expand.err.find("a.yaml:3:68: error: 'initial_mesh.cells': -8 is below") !=
          std::string::npos);
    CHECK(expand.err.find("2 errors; nothing was written") != std::string::npos);
    CHECK_FALSE(cli.exists("out"));
    cli.write("a.yaml", "sweep: 1\nbase: nowhere.yaml\nrepeat: 2\n");
    CHECK(cli.dsc({"sweep", "expand", "a.yaml", "-o", "out"}).code == 6);
    CHECK(cli.dsc({"sweep", "expand", "nowhere.yaml", "-o", "out"}).code == 6);
    cli.write("a.yaml",
              "sweep: 1\nbase: cube.yaml\naxes: [{grid: {initial_mesh.cells: [6, 8]}}]\n");
    cli.write("full/mine.txt", "precious");
    CHECK(cli.dsc({"sweep", "expand", "a.yaml", "-o", "full"}).code == 2);
    CHECK(cli.dsc({"sweep", "collect", "full"}).code == 2);
}

TEST_CASE("a refinement that a point's velocity cannot serve is told at expansion") {
    const Cli cli;
    cli.write("cube.yaml", base);
    cli.write("a.yaml",
              "sweep: 1\nbase: cube.yaml\nset: {schedule: [{steps: 1}, {refine: {type: "
              "centroid_speed}}]}\n"
              "axes: [{grid: {velocity: [{type: average}, {type: rotate, degrees: 10}]}}]\n");
    const Result expand = cli.dsc({"sweep", "expand", "a.yaml", "-o", "out"});
    CHECK(expand.code == 3);
    CHECK(expand.err.find("refinement 'centroid_speed' reads the velocity between the vertices") !=
          std::string::npos);
    CHECK(expand.err.find("note: in the point {velocity: {type: average}}") != std::string::npos);
    CHECK(expand.err.find("1 error; nothing was written") != std::string::npos);
    CHECK_FALSE(cli.exists("out"));
}

TEST_CASE(
    "repeats on a cloud file: varied by the seed, compared with the truth, in groups and pairs") {
    const Cli cli;
    REQUIRE(
        cli.dsc({"sample", "torus", "-n", "500", "-o", "ring.xyz", "--mesh", "ring.obj"}).code ==
        0);
    const std::string input = "input: {cloud: {file: ring.xyz}, normalize: {scale: 0.9}}\n";
    cli.write("ring.yaml",
              "dsc: 1\n" + input +
                  "initial_mesh: {type: grid, cells: 10, shape: cube, half_width: 1.0}\nvelocity: "
                  "{type: point_cloud}\nimprovement: {type: dsc}\nschedule: [{steps: 6}]\noutput: "
                  "{surface: [obj], volume: [dsc]}\n");
    const std::string sweep =
        "sweep: 1\nbase: ring.yaml\ntruth: ring.obj\naxes: [{grid: {velocity.alpha: [0.1, "
        "0.3]}}]\nrepeat: 3\n";
    cli.write("a.yaml", sweep);
    const Result same = cli.dsc({"sweep", "expand", "a.yaml", "-o", "out"});
    CHECK(same.code == 3);
    CHECK(same.err.find("a.yaml:5:9: error: runs that differ only in their seeds would all be the "
                        "same") != std::string::npos);
    CHECK(same.err.find("set input.cloud.vary: {subsample: 0.9, rotate: true}") !=
          std::string::npos);
    cli.write("a.yaml", sweep + "set: {input.cloud.vary: {subsample: 0.9}}\n");
    REQUIRE(cli.dsc({"sweep", "expand", "a.yaml", "-o", "out"}).code == 0);
    const std::vector<std::string> rows = lines(cli.read("out/jobs.tsv"));
    REQUIRE(rows.size() == 7);
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const std::string point = "out/" + folder_of(rows[i]);
        REQUIRE(cli.dsc({"run", point + "/experiment.yaml", "-o", point + "/run", "-q"}).code == 0);
    }
    const std::string first = "out/" + folder_of(rows[1]), second = "out/" + folder_of(rows[2]);
    const std::string surface = cli.read(first + "/run/result/surface.obj");
    CHECK(surface != cli.read(second + "/run/result/surface.obj"));
    // The same bytes again, with more threads.
    REQUIRE(
        cli.dsc({"run", first + "/experiment.yaml", "-o", "again", "-q", "--threads", "3"}).code ==
        0);
    CHECK(cli.read("again/result/surface.obj") == surface);
    CHECK(cli.read("again/provenance.json").find("\"variation\"") != std::string::npos);
    CHECK(cli.read("again/summary.json").find("\"rotation\"") != std::string::npos);

    const Result collect =
        cli.dsc({"sweep", "collect", "out", "-o", "results.csv", "--groups", "groups.csv"});
    CHECK(collect.code == 0);
    CHECK(collect.out == "results.csv\ngroups.csv\n");
    CHECK(lines(cli.read("results.csv"))[0].find(",truth.chamfer_percent,") != std::string::npos);
    const std::vector<std::string> groups = lines(cli.read("groups.csv"));
    REQUIRE(groups.size() == 3);
    CHECK(groups[1].find("0,0,3,0.1,") == 0);
    CHECK(groups[2].find("1,1,3,0.3,") == 0);
    const Result compare = cli.dsc({"sweep", "compare", "out", "0", "1"});
    CHECK(compare.code == 0);
    CHECK(compare.out.find("first   {velocity.alpha: 0.1}\nsecond  {velocity.alpha: 0.3}\n3 pairs "
                           "with the same seed and cloud\n") == 0);
    CHECK(compare.out.find("\ntruth.chamfer_percent ") != std::string::npos);
    CHECK(cli.dsc({"sweep", "compare", "out", "0", "2"}).code == 2);
    std::filesystem::remove(cli.folder() / "ring.obj");
    CHECK(cli.dsc({"sweep", "collect", "out"}).code == 6);
}
