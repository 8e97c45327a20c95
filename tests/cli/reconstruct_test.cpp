// dsc reconstruct: its options and what it says of its result.
#include <cmath>
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "process.hpp"

using dsc::test::Cli;
using dsc::test::Result;
using nlohmann::json;

namespace {

/// Points on a ball, evenly apart, along a spiral.
std::string ball(int n, double radius, double x, bool upper_half = false) {
    std::string text;
    for (int i = 0; i < n; ++i) {
        const double z = 1.0 - 2.0 * (i + 0.5) / n, r = std::sqrt(1.0 - z * z),
                     angle = 2.399963229728653 * i;
        if (upper_half && z < 0.0) continue;
        text += std::to_string(x + radius * r * std::cos(angle)) + " " +
                std::to_string(radius * r * std::sin(angle)) + " " + std::to_string(radius * z) +
                "\n";
    }
    return text;
}

json info(const Cli& cli, const std::string& file) {
    return json::parse(cli.dsc({"info", file, "--json"}).out);
}

}  // namespace

TEST_CASE("reconstruct: a body without a surface is named, and --strict makes it an error") {
    const Cli cli;
    cli.write("c.xyz", ball(2000, 1.0, 0.0) + ball(150, 0.08, 1.8));
    const Result run =
        cli.dsc({"reconstruct", "c.xyz", "--detail", "low", "-o", "s.obj", "--keep-run", "run"});
    CHECK(run.code == 0);
    const json figures = info(cli, "s.obj");
    const json summary = json::parse(cli.read("run/summary.json"));
    if (figures["components"] == 2) {
        CHECK(summary["coverage"]["far_share"] < 0.01);
        CHECK(run.err.find("warning: 1 group of points") == std::string::npos);
    } else {
        CHECK(run.err.find("150 points around (1.8") != std::string::npos);
        CHECK(cli.dsc({"reconstruct", "c.xyz", "--detail", "low", "-o", "strict.obj", "--strict",
                       "-q"})
                  .code == 5);
        CHECK(cli.read("strict.obj") == cli.read("s.obj"));
    }
    CHECK(run.err.find("of the points are farther from the surface") != std::string::npos);
}

TEST_CASE("reconstruct: half a ball is trimmed to its points, and the volume stays closed") {
    const Cli cli;
    cli.write("c.xyz", ball(4000, 1.0, 0.0, true));
    const Result closed =
        cli.dsc({"reconstruct", "c.xyz", "--detail", "low", "-o", "closed.ply", "--strict"});
    CHECK(closed.code == 5);
    CHECK(closed.err.find("--trim") != std::string::npos);
    CHECK(info(cli, "closed.ply")["solid"] == true);
    const Result open = cli.dsc({"reconstruct", "c.xyz", "--detail", "low", "-o", "open.ply", "-o",
                                 "v.dsc", "--trim", "--keep-run", "run"});
    CHECK(open.code == 0);
    CHECK(open.err.find("open by request") != std::string::npos);
    const json sheet = info(cli, "open.ply");
    CHECK(sheet["boundary_edges"] > 20);
    CHECK(sheet["shells"] == 1);
    CHECK(sheet["nonmanifold_vertices"] == 0);
    CHECK(sheet["self_intersections"] == 0);
    CHECK(sheet["area"].get<double>() == doctest::Approx(2.0 * 3.14159265).epsilon(0.05));
    CHECK(info(cli, "v.dsc")["interface"]["solid"] == true);
    CHECK(json::parse(cli.read("run/summary.json"))["trimmed"]["area_share"] > 0.2);
    CHECK(cli.read("run/report.html").find("open by request") != std::string::npos);
}

TEST_CASE("reconstruct: one knob for the size, one for the noise") {
    const Cli cli;
    cli.write("c.xyz", ball(1500, 1.0, 0.0));
    const auto made = [&](std::vector<std::string> options) {
        options.insert(options.begin(), {"reconstruct", "c.xyz", "-o", "s.ply", "-q"});
        REQUIRE(cli.dsc(options).code == 0);
        return info(cli, "s.ply");
    };
    const double edge = made({"--edge-length", "0.15"})["edge"]["mean"];
    CHECK(edge > 0.12);
    CHECK(edge < 0.18);
    const double vertices = made({"--vertices", "900"})["vertices"];
    CHECK(vertices > 600);
    CHECK(vertices <= 900);
    CHECK(made({"--detail", "low", "--smooth", "2"})["area"] != made({"--detail", "low"})["area"]);
    CHECK(cli.dsc({"reconstruct", "c.xyz", "--smooth", "much"}).code == 2);
    CHECK(cli.dsc({"reconstruct", "c.xyz", "--vertices", "900", "--detail", "low"}).code == 2);
    CHECK(cli.dsc({"reconstruct", "c.xyz", "--vertices", "900", "--edge-length", "1"}).code == 2);
    CHECK(cli.dsc({"reconstruct", "c.xyz", "--edge-length", "0"}).code == 2);
}
