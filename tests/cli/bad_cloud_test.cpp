// Every bad cloud ends in one clear message, the right exit code and no result.
#include <algorithm>
#include <cstring>

#include <doctest/doctest.h>

#include "process.hpp"

using dsc::test::Cli;
using dsc::test::Result;

namespace {

struct BadCloud {
    const char* name;
    std::string content;
    int code;
    std::string message;
};

std::string pcd(const std::string& points, int count) {
    return "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " +
           std::to_string(count) + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " +
           std::to_string(count) + "\nDATA ascii\n" + points;
}

std::string ply(const std::string& points, int count) {
    return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(count) +
           "\nproperty double x\nproperty double y\nproperty double z\nend_header\n" + points;
}

const std::string four_needed =
    "; a surface needs at least 4 points that do not lie on one plane\n";

const std::vector<BadCloud> bad_clouds = {
    {"truncated.obj", "v 0 0 0\nv 1 0 0\nv 0 1", 6,
     "truncated.obj:3: the vertex has 2 numbers; a 'v' line is 'v x y z' or 'v x y z r g b'; the "
     "file may be cut off, write it again\n"},
    {"truncated.ply", ply("0 0 0\n1 0 0\n", 5), 6,
     "truncated.ply: the header announces 5 points, the file contains 2; the file is cut off, "
     "write it again\n"},
    {"truncated.pcd", pcd("0 0 0\n1 0 0\n", 5), 6,
     "truncated.pcd: the header announces 5 points, the file contains 2; the file is cut off, "
     "write it again\n"},
    {"nan.obj", "v 0 0 0\nv nan 0 0\n", 6,
     "nan.obj:2: 'nan' is not a finite number; remove the point or write its true coordinates\n"},
    {"infinite.xyz", "0 0 0\n1 inf 0\n", 6,
     "infinite.xyz:2: 'inf' is not a finite number; remove the point or write its true "
     "coordinates\n"},
    {"empty.xyz", "", 6, "empty.xyz: the file is empty; write the cloud again\n"},
    {"none.xyz", "# nothing\n", 6,
     "none.xyz: the file has no points; a text cloud has one line 'x y z' per point\n"},
    {"one.xyz", "1 2 3\n", 5, "one.xyz: the cloud has 1 point" + four_needed},
    {"three.xyz", "0 0 0\n1 0 0\n0 1 0\n", 5, "three.xyz: the cloud has 3 points" + four_needed},
    {"flat.xyz", "0 0 0\n1 0 0\n0 1 0\n1 1 0\n", 5,
     "flat.xyz: all 4 points lie on one plane (extent 1 x 1 x 0)" + four_needed},
    {"line.xyz", "0 0 0\n1 1 1\n2 2 2\n3 3 3\n", 5, ""},
    {"equal.xyz", "1 1 1\n1 1 1\n1 1 1\n1 1 1\n", 5,
     "equal.xyz: all 4 points are equal (extent 0 x 0 x 0)" + four_needed},
    {"all_nan.ply", ply("nan 0 0\n0 inf 0\n", 2), 6, ""},
    {"all_nan.pcd", pcd("nan nan nan\nnan 0 0\n", 2), 6, ""},
    {"scan.las", "LASF", 6,
     "scan.las: las files are not supported; convert it first: pdal translate scan.las scan.ply\n"},
    {"scan.laz", "LASF", 6,
     "scan.laz: laz files are not supported; convert it first: pdal translate scan.laz scan.ply\n"},
    {"scan.e57", "ASTM", 6,
     "scan.e57: e57 files are not supported; convert it first: pdal translate scan.e57 scan.ply, "
     "or save it as PLY with CloudCompare\n"},
};

const std::string experiment =
    "dsc: 1\ninitial_mesh: {type: grid, cells: 12}\nvelocity: {type: point_cloud}\nimprovement: "
    "{type: dsc}\n"
    "schedule: [{steps: 1}]\ninput: {normalize: {}, cloud: {file: CLOUD}}\n";

void run_on(const Cli& cli, const std::string& cloud) {
    std::string text = experiment;
    text.replace(text.find("CLOUD"), 5, cloud);
    cli.write("experiment.yaml", text);
}

}  // namespace

TEST_CASE("dsc reconstruct and dsc run refuse a bad cloud with one message") {
    for (const BadCloud& bad : bad_clouds) {
        CAPTURE(bad.name);
        const Cli cli;
        cli.write(bad.name, bad.content);
        const Result reconstruct =
            cli.dsc({"reconstruct", bad.name, "-o", "out.obj", "-o", "out.vtu"});
        CHECK(reconstruct.code == bad.code);
        CHECK(reconstruct.out.empty());
        if (!bad.message.empty()) CHECK(reconstruct.err == "error: " + bad.message);
        CHECK(reconstruct.err.substr(0, 7 + std::strlen(bad.name)) ==
              "error: " + std::string(bad.name));
        CHECK(std::count(reconstruct.err.begin(), reconstruct.err.end(), '\n') == 1);
        CHECK_FALSE(cli.exists("out.obj"));
        CHECK_FALSE(cli.exists("out.vtu"));

        run_on(cli, bad.name);
        const Result run = cli.dsc({"run", "experiment.yaml", "-o", "out", "-q"});
        CHECK(run.code == bad.code);
        CHECK(run.out.empty());
        if (!bad.message.empty()) CHECK(run.err.find(bad.message) != std::string::npos);
        CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
        CHECK_FALSE(dsc::test::looks_finished(cli.folder() / "out"));
    }
}

TEST_CASE("a cloud that does not exist, or is a folder") {
    const Cli cli;
    const Result missing = cli.dsc({"reconstruct", "none.ply"});
    CHECK(missing.code == 6);
    CHECK(missing.err == "error: none.ply: does not exist; check the name of the cloud\n");
    run_on(cli, "none.ply");
    const Result run = cli.dsc({"run", "experiment.yaml", "-o", "out"});
    CHECK(run.code == 6);
    CHECK(run.err.find(
              "experiment.yaml:6:38: error: 'input.cloud.file': DIR/none.ply does not exist\n") ==
          0);
    CHECK_FALSE(cli.exists("out"));
    std::filesystem::create_directory(cli.folder() / "folder.xyz");
    CHECK(cli.dsc({"reconstruct", "folder.xyz"}).code == 6);
}

TEST_CASE("points with NaN in PLY and PCD are dropped, counted and reported") {
    const Cli cli;
    const std::string points = "0 0 0\nnan 0 0\n1 0 0\n0 1 0\n0 0 1\ninf 0 0\n";
    for (const std::string name : {"some.ply", "some.pcd"}) {
        CAPTURE(name);
        cli.write(name, name == "some.ply" ? ply(points, 6) : pcd(points, 6));
        run_on(cli, name);
        const Result run = cli.dsc({"run", "experiment.yaml", "-o", "out", "--progress", "never"});
        CHECK(run.code == 0);
        CHECK(run.err.find("warning: DIR/" + name +
                           ": 6 points, 2 with NaN or infinity dropped\n") != std::string::npos);
        CHECK(cli.read("out/summary.json").find("\"dropped\": 2") != std::string::npos);
    }
}

TEST_CASE("a cloud outside the box is refused before anything moves") {
    const Cli cli;
    cli.write("far.xyz", "0 0 0\n1 0 0\n0 1 0\n0 0 7\n");
    std::string text = experiment;
    text.replace(text.find("normalize: {}, "), 15, "");
    text.replace(text.find("CLOUD"), 5, "far.xyz");
    cli.write("experiment.yaml", text);
    const Result result = cli.dsc({"run", "experiment.yaml", "-o", "out", "-q"});
    CHECK(result.code == 5);
    CHECK(result.err.find("DIR/far.xyz") != std::string::npos);
    CHECK(result.err.find("normalize") != std::string::npos);
    CHECK_FALSE(dsc::test::looks_finished(cli.folder() / "out"));
    CHECK(cli.read("out/status.json").find("\"error_code\": \"cloud.outside_box\"") !=
          std::string::npos);
}

TEST_CASE("bad meshes: dsc info names file and place") {
    const Cli cli;
    const auto info = [&](const std::string& name, const std::string& content) {
        cli.write(name, content);
        const Result result = cli.dsc({"info", name});
        CHECK(result.out.empty());
        CHECK(result.code == 6);
        return result.err;
    };
    CHECK(info("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n") ==
          "error: index.obj:4: vertex index 4 of 3; correct the line or export the file again\n");
    CHECK(info("truncated.dsc", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nt 0 1 2 3") ==
          "error: truncated.dsc:5: the file ends where an integer should be; the file is "
          "incomplete: copy or export it again\n");
    CHECK(info("nan.dsc", "v 0 0 0\nv nan 0 0\n").find("nan.dsc:2") != std::string::npos);
    CHECK(info("index.dsc", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nt 0 1 2 9 0\n")
              .find("index.dsc:5") != std::string::npos);
}
