// Every format through the real command: what is written is read again, and says the same.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "process.hpp"

using dsc::test::Cli;
using dsc::test::Result;
using nlohmann::json;

namespace {

/// A coloured cloud in text: the corners of a box and points on its sides, red below, blue above.
std::string coloured_csv() {
    std::string text = "id;east;north;up;red;green;blue\n";
    int id = 0;
    for (int x = -6; x <= 6; ++x)
        for (int y = -6; y <= 6; ++y)
            for (int z = -6; z <= 6; ++z) {
                if (std::max({std::abs(x), std::abs(y), std::abs(z)}) < 6) continue;
                text += std::to_string(id++) + ";" + std::to_string(x) + ".1;" + std::to_string(y) +
                        ".2;" + std::to_string(z) + ".3;" + (z < 0 ? "255;0;0\n" : "0;0;255\n");
            }
    return text;
}

const std::string experiment = "dsc: 1\ninput: {cloud: {file: cloud.csv, columns: [east, north, 4, "
                               "red, green, blue]}, normalize: {}}\n"
                               "initial_mesh: {type: grid, cells: 12}\nvelocity: {type: "
                               "point_cloud}\nimprovement: {type: dsc}\n"
                               "schedule: [{steps: 8}]\noutput: {surface: [obj, ply, off, stl], "
                               "volume: [vtu, dsc, msh, mesh], normals: true}\n";

}  // namespace

TEST_CASE("a cloud goes through every format and comes back, colours and all") {
    const Cli cli;
    cli.write("cloud.csv", coloured_csv());
    const Result first =
        cli.dsc({"convert", "cloud.csv", "a.csv", "--columns", "east,north,up,red,green,blue"});
    CHECK(first.err == "");
    REQUIRE(first.code == 0);
    CHECK(cli.read("a.csv").substr(0, 21) == "x,y,z,red,green,blue\n");
    std::string from = "a.csv";
    for (const std::string to :
         {"b.ply", "c.pcd", "d.obj", "e.xyz", "f.txt", "g.asc", "h.pts", "z.csv"}) {
        CAPTURE(to);
        REQUIRE(cli.dsc({"convert", from, to}).code == 0);
        const json figures = json::parse(cli.dsc({"info", to, "--json"}).out);
        CHECK(figures["kind"] == "cloud");
        CHECK(figures["points"] == 13 * 13 * 13 - 11 * 11 * 11);
        CHECK(figures["coloured"] == true);
        from = to;
    }
    CHECK(cli.read("z.csv") == cli.read("a.csv"));

    CHECK(json::parse(
              cli.dsc({"info", "cloud.csv", "--columns", "2,3,4", "--json"}).out)["coloured"] ==
          false);
    CHECK(cli.dsc({"info", "cloud.csv", "--columns", "east,north,height"}).err ==
          "error: cloud.csv:1: no column has the name 'height'; choose of 'id', 'east', 'north', "
          "'up', 'red', 'green', 'blue' or a number from 1\n");
    CHECK(cli.dsc({"reconstruct", "cloud.csv", "--columns", "east,north"}).err ==
          "error: cloud.csv: 2 columns are chosen; choose 3 (x, y, z) or 6 (x, y, z, red, green, "
          "blue)\n");
}

TEST_CASE(
    "a run carries the colours to the surface and writes every format; all kinds are converted") {
    const Cli cli;
    cli.write("cloud.csv", coloured_csv());
    cli.write("a.yaml", experiment);
    const Result run = cli.dsc({"run", "a.yaml", "-o", "out", "-q"});
    CHECK(run.err == "");
    REQUIRE(run.code == 0);
    const json solid = json::parse(cli.dsc({"info", "out/result/surface.ply", "--json"}).out);
    CHECK(solid["solid"] == true);
    for (const std::string extension : {"obj", "ply", "off", "stl"}) {
        CAPTURE(extension);
        const json figures =
            json::parse(cli.dsc({"info", "out/result/surface." + extension, "--json"}).out);
        CHECK(figures["faces"] == solid["faces"]);
        CHECK(figures["coloured"] == (extension == "obj" || extension == "ply"));
    }
    // Vertices below are red and those above blue, as the points that are nearest to them.
    std::istringstream lines(cli.read("out/result/surface.obj"));
    int red = 0, blue = 0;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string tag;
        double x = 0, y = 0, z = 0;
        if (!(words >> tag >> x >> y >> z) || tag != "v") continue;
        std::string colour;
        std::getline(words, colour);
        CHECK((colour == " 1 0 0" || colour == " 0 0 1"));
        if (z < -1.0) CHECK(colour == " 1 0 0");
        if (z > 1.0) CHECK(colour == " 0 0 1");
        ++(colour == " 1 0 0" ? red : blue);
    }
    CHECK(red > 50);
    CHECK(blue > 50);
    // Surface to surface, surface to cloud.
    CHECK(cli.dsc({"convert", "out/result/surface.obj", "s.ply"}).code == 0);
    CHECK(cli.read("s.ply") == cli.read("out/result/surface.ply"));
    CHECK(cli.dsc({"convert", "s.ply", "s.csv"}).code == 0);
    CHECK(json::parse(cli.dsc({"info", "s.csv", "--json"}).out)["coloured"] == true);
    // Volume to volume.
    CHECK(cli.dsc({"convert", "out/result/volume.vtu", "v.dsc"}).code == 0);
    CHECK(cli.read("v.dsc") == cli.read("out/result/volume.dsc"));
    for (const std::string extension : {"msh", "mesh"}) {
        CAPTURE(extension);
        CHECK(cli.dsc({"convert", "v.dsc", "v." + extension}).code == 0);
        CHECK(cli.read("v." + extension) == cli.read("out/result/volume." + extension));
        const Result read = cli.dsc({"info", "v." + extension});
        CHECK(read.code == 6);
        CHECK(read.err.find("files can be written but not read; convert it with meshio") !=
              std::string::npos);
    }
}

TEST_CASE("info lists every property of a cloud with its use, and judges normals and viewpoint") {
    const Cli cli;
    cli.write("u16.ply",
              "ply\nformat ascii 1.0\nelement vertex 5\nproperty double x\nproperty double "
              "y\nproperty double z\nproperty uint16 red\nproperty uint16 green\nproperty uint16 "
              "blue\nproperty float quality\nend_header\n"
              "0 0 0 65535 0 0 1\n1 0 0 0 9 0 1\n0 1 0 0 0 9 1\n0 0 1 0 0 0 1\n1 1 1 0 0 0 1\n");
    const json coloured = json::parse(cli.dsc({"info", "u16.ply", "--json"}).out);
    CHECK(coloured["coloured"] == true);
    CHECK(coloured["properties"] == json({{"x", "position"},
                                          {"y", "position"},
                                          {"z", "position"},
                                          {"red", "colour"},
                                          {"green", "colour"},
                                          {"blue", "colour"},
                                          {"quality", "not used"}}));
    CHECK(cli.dsc({"info", "u16.ply"}).out.find("properties.quality ") != std::string::npos);
    // A sphere whose normals all point to one side.
    std::string sphere = "x,y,z,nx,ny,nz\n";
    for (int i = 0; i < 500; ++i) {
        const double z = (2.0 * i + 1.0) / 500.0 - 1.0, r = std::sqrt(1.0 - z * z), angle = 2.4 * i;
        sphere += std::to_string(r * std::cos(angle)) + "," + std::to_string(r * std::sin(angle)) +
                  "," + std::to_string(z) + ",0,0,1\n";
    }
    cli.write("sphere.csv", sphere);
    const json judged = json::parse(cli.dsc({"info", "sphere.csv", "--json"}).out);
    CHECK(judged["properties"]["nx"] == "normal");
    CHECK(judged["normals"].get<std::string>().find(
              "The normals of the file are not used, because at ") == 0);
    CHECK_FALSE(judged.contains("viewpoint"));
    // A run says the same in the terminal and in summary.json.
    cli.write("a.yaml", "dsc: 1\ninput: {cloud: {file: sphere.csv, filters: [{type: orient}]}, "
                        "normalize: {}}\ninitial_mesh: {type: grid, cells: 8}\nvelocity: {type: "
                        "point_cloud}\nimprovement: {type: dsc}\nschedule: [{steps: 1}]\n");
    const Result run = cli.dsc({"run", "a.yaml", "-o", "out"});
    REQUIRE(run.code == 0);
    CHECK(run.err.find("info: " + judged["normals"].get<std::string>() + "\n") !=
          std::string::npos);
    CHECK(json::parse(cli.read("out/summary.json"))["input"]["filters"][0]["notes"] ==
          json::array({judged["normals"]}));
    REQUIRE(cli.dsc({"convert", "sphere.csv", "sphere.pcd"}).code == 0);
    CHECK(json::parse(cli.dsc({"info", "sphere.pcd", "--json"}).out)["viewpoint"] ==
          json({0.0, 0.0, 0.0}));
}

TEST_CASE("reconstruct writes a volume for Gmsh and one for MEDIT") {
    const Cli cli;
    cli.write("cloud.csv", coloured_csv());
    const Result run = cli.dsc({"reconstruct", "cloud.csv", "--columns",
                                "east,north,up,red,green,blue", "--detail", "low", "-o", "v.msh",
                                "-o", "v.mesh", "-o", "s.ply", "-o", "v.dsc", "-q"});
    CHECK(run.err == "");
    CHECK(run.out == "v.msh\nv.mesh\ns.ply\nv.dsc\n");
    const json surface = json::parse(cli.dsc({"info", "s.ply", "--json"}).out);
    CHECK(surface["coloured"] == true);
    CHECK(surface["properties"]["nx"] == "normal");
    REQUIRE(cli.dsc({"convert", "cloud.csv", "xyz.csv", "--columns", "east,north,up"}).code == 0);
    const auto judged = [&](std::vector<std::string> cloud) {
        cloud.insert(cloud.begin(), {"evaluate", "s.ply", "--json", "--cloud"});
        return json::parse(cli.dsc(cloud).out)["cloud"]["vertex_to_cloud"]["mean"].get<double>();
    };
    CHECK(judged({"cloud.csv", "--columns", "east,north,up"}) == judged({"xyz.csv"}));
    CHECK(judged({"cloud.csv", "--columns", "id,north,up"}) != judged({"xyz.csv"}));
    for (const std::string extension : {"msh", "mesh"}) {
        CHECK(cli.dsc({"convert", "v.dsc", "again." + extension}).code == 0);
        CHECK(cli.read("again." + extension) == cli.read("v." + extension));
    }
}

TEST_CASE("a shuffled file gives the same bytes where duplicates sorts, and summary.json tells "
          "what it removed") {
    const Cli cli;
    std::vector<std::string> rows;
    std::istringstream lines(coloured_csv());
    std::string header;
    std::getline(lines, header);
    for (std::string line; std::getline(lines, line);) rows.push_back(line);
    const std::size_t distinct = rows.size();
    // Repeated points in other colours: which of them stays must not depend on the order either.
    for (std::size_t i = 0; i < distinct; i += 7)
        rows.push_back(rows[i].substr(0, rows[i].find(".3;")) + ".3;0;255;0");
    const auto written = [&] {
        std::string text = header + "\n";
        for (const std::string& row : rows) text += row + "\n";
        return text;
    };
    const auto surface = [&](const std::string& folder) {
        cli.write("cloud.csv", written());
        cli.write("a.yaml", experiment);
        const Result run =
            cli.dsc({"run", "a.yaml", "input.cloud.filters=[{type: duplicates, sort: true}]", "-o",
                     folder});
        CAPTURE(run.err);
        REQUIRE(run.code == 0);
        return cli.read(folder + "/result/surface.ply");
    };
    const std::string first = surface("first");
    std::reverse(rows.begin(), rows.end());
    std::rotate(rows.begin(), rows.begin() + 100, rows.end());
    CHECK(surface("second") == first);
    const json told = json::parse(cli.read("second/summary.json"))["input"]["filters"];
    CHECK(told == json::parse("[{\"type\": \"duplicates\", \"kept\": " + std::to_string(distinct) +
                              ", \"removed\": " + std::to_string(rows.size() - distinct) + "}]"));
}
