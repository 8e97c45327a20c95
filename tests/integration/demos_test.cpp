// Every demo by its config: the figures that issue and page name, on the files that the command
// writes. Where a full run takes long, a shorter one: share/doc/motions.md has the figures of the
// full ones.
#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include <doctest/doctest.h>

#include <dsc/io/read.hpp>

#include "results.hpp"

using dsc::Vec3;
using dsc::test::Cli;
using nlohmann::json;

namespace {

/// Runs configs/demos/NAME.yaml and returns the summary of a result without intersections and
/// inverted tets.
json run_config(const Cli& cli, const std::string& name, const std::vector<std::string>& overrides,
                const std::string& folder) {
    std::vector<std::string> arguments = {"run", dsc::test::config("demos/" + name + ".yaml"), "-o",
                                          folder, "-q"};
    arguments.insert(arguments.end(), overrides.begin(), overrides.end());
    REQUIRE(cli.dsc(arguments).code == 0);
    const json summary = dsc::test::summary_of(cli, folder);
    CHECK(summary["self_intersections"] == 0);
    CHECK(summary["inverted_tets"] == 0);
    return summary;
}

/// The same where the result has a surface that must be a solid, or none.
json run_demo(const Cli& cli, const std::string& name,
              const std::vector<std::string>& overrides = {}, const std::string& folder = "out") {
    json summary = run_config(cli, name, overrides, folder);
    if (!summary["interface_faces"].get<std::size_t>()) return summary;
    dsc::test::check_result(cli.folder() / folder);
    return summary;
}

double figure(const json& summary, const char* name) {
    return summary["observers"]["analytic"][name].get<double>();
}

bool eventless(const json& summary) {
    const json& events = summary["events"];
    return std::all_of(events.begin(), events.end(), [](const json& count) { return count == 0; });
}

/// The least and the greatest of a column of metrics.csv from the first step on.
std::pair<double, double> range_of(const Cli& cli, const std::string& column) {
    std::istringstream lines(cli.read("out/metrics.csv"));
    std::string line;
    std::string cell;
    std::getline(lines, line);
    std::size_t index = 0;
    std::istringstream header(line);
    while (std::getline(header, cell, ',') && cell != column) ++index;
    std::getline(lines, line);
    std::pair<double, double> range = {1e300, -1e300};
    while (std::getline(lines, line)) {
        std::istringstream cells(line);
        for (std::size_t i = 0; i <= index; ++i) std::getline(cells, cell, ',');
        range.first = std::min(range.first, std::stod(cell));
        range.second = std::max(range.second, std::stod(cell));
    }
    return range;
}

std::vector<Vec3> free_points(const Cli& cli, const std::string& folder) {
    const auto mesh = dsc::io::read_volume(cli.folder() / folder / "result" / "volume.dsc");
    std::vector<Vec3> points;
    for (const Vec3& p : mesh.points) {
        if (p.cwiseAbs().maxCoeff() < 1.5 - 1e-9) points.push_back(p);
    }
    return points;
}

/// How many of the points of `now` within `radius` are, to a hundredth of an edge, where one of
/// `before` was.
double part_in_place(const std::vector<Vec3>& before, const std::vector<Vec3>& now, double radius) {
    std::size_t inside = 0;
    std::size_t in_place = 0;
    for (const Vec3& p : now) {
        if (p.norm() > radius) continue;
        ++inside;
        in_place += std::any_of(before.begin(), before.end(),
                                [&](const Vec3& q) { return (p - q).norm() < 1e-3; });
    }
    return static_cast<double>(in_place) / static_cast<double>(inside);
}

}  // namespace

TEST_CASE("rotate_sphere: once round, and it is the same sphere") {
    const Cli cli;
    const json summary = run_demo(cli, "rotate_sphere");
    CHECK(figure(summary, "volume_drift") < 0.002);
    CHECK(figure(summary, "vertex_ratio") >= 0.9);
    CHECK(figure(summary, "vertex_ratio") <= 1.1);
    CHECK(figure(summary, "distance_ratio") <= 1.2);
    CHECK(figure(summary, "radius_error") < 1e-3);
    CHECK(range_of(cli, "observers.analytic.distance_ratio").second <= 1.2);
    CHECK(range_of(cli, "observers.analytic.volume_drift").second < 0.002);
    CHECK(summary["dropped_motion"].get<double>() < 1e-9);
    CHECK(eventless(summary));
}

TEST_CASE("rotate_sphere: at half a turn the whole mesh has turned, not only the sphere") {
    const Cli cli;
    const std::vector<std::string> coarse = {"initial_mesh.cells=16"};
    run_demo(cli, "rotate_sphere", {coarse[0], "velocity.degrees=0", "schedule=[{steps: 1}]"},
             "start");
    run_demo(cli, "rotate_sphere", {coarse[0], "schedule=[{steps: 180}]"}, "half");
    const auto start = dsc::io::read_surface(cli.folder() / "start/result/surface.obj");
    const auto half = dsc::io::read_surface(cli.folder() / "half/result/surface.obj");
    const Vec3 axis = Vec3(1, 2, 3).normalized();
    std::vector<Vec3> turned;
    for (const Vec3& p : start.points) turned.push_back(2 * p.dot(axis) * axis - p);
    // Most surface vertices are where half a turn takes those of the start, and hardly any where
    // they were.
    CHECK(part_in_place(turned, half.points, 2.0) > 0.8);
    CHECK(part_in_place(start.points, half.points, 2.0) < 0.1);
    // What is inside and just outside went along: nothing of it is where it was.
    CHECK(part_in_place(free_points(cli, "start"), free_points(cli, "half"), 1.0) < 0.1);
}

TEST_CASE("curvature_flow: sqrt(r^2 - 4 t) at three resolutions, the better the finer") {
    const Cli cli;
    const double coarse =
        figure(run_demo(cli, "curvature_flow", {"initial_mesh.cells=12"}), "radius_error");
    const double middle =
        figure(run_demo(cli, "curvature_flow", {"initial_mesh.cells=16"}), "radius_error");
    const double fine = figure(run_demo(cli, "curvature_flow"), "radius_error");
    const double finest =
        figure(run_demo(cli, "curvature_flow", {"initial_mesh.cells=32"}), "radius_error");
    CHECK(coarse < 0.02);
    CHECK(middle < coarse);
    CHECK(fine < middle);
    // Here the error of the steps in time is larger than that of the resolution.
    CHECK(finest < middle);
}

TEST_CASE("curvature_flow: run on, the sphere vanishes once, near the time at which it should") {
    const Cli cli;
    const json summary = run_demo(cli, "curvature_flow", {"schedule=[{steps: 900}]"});
    CHECK(summary["events"]["vanished"] == 1);
    CHECK(summary["interface_faces"] == 0);
    CHECK(summary["components"] == 0);
    CHECK(summary["steps"].get<int>() > 780);
    CHECK(summary["steps"].get<int>() < 830);
    CHECK(cli.exists("out/result/volume.dsc"));
    CHECK_FALSE(cli.exists("out/result/surface.obj"));
    CHECK(json::parse(cli.read("out/status.json"))["state"] == "done");
}

TEST_CASE("merge_spheres: one component without a handle") {
    const Cli cli;
    const json summary = run_demo(cli, "merge_spheres");
    CHECK(summary["components"] == 1);
    CHECK(summary["shells"] == 1);
    CHECK(summary["genus"] == 0);
    CHECK(summary["events"]["merge"] == 1);
}

TEST_CASE("split_dumbbell: two components, and the flow keeps the volume") {
    const Cli cli;
    const json summary = run_demo(cli, "split_dumbbell");
    CHECK(summary["components"] == 2);
    CHECK(summary["shells"] == 2);
    CHECK(summary["genus"] == 0);
    CHECK(summary["events"]["split"] == 1);
    CHECK(figure(summary, "volume_drift") < 0.02);
}

TEST_CASE("enright: out for a part of the period and back, without an event") {
    // A shorter period: less deformation, the same way. The full run takes a minute and a half.
    const Cli cli;
    const json summary =
        run_demo(cli, "enright",
                 {"initial_mesh.cells=48", "velocity.period=1.5", "schedule=[{steps: 150}]"});
    CHECK(eventless(summary));
    CHECK(figure(summary, "volume_drift") <= 0.02);
    CHECK(figure(summary, "surface_error") <= 0.5);
    // It has really gone out: in between the surface was larger than at the end.
    CHECK(range_of(cli, "interface_vertices").second >
          1.2 * summary["interface_vertices"].get<double>());
}

TEST_CASE("zalesak: once round, and the notch is still there") {
    const Cli cli;
    const json summary = run_demo(
        cli, "zalesak", {"initial_mesh.cells=64", "velocity.degrees=3", "schedule=[{steps: 120}]"});
    CHECK(eventless(summary));
    CHECK(figure(summary, "volume_drift") <= 0.02);
    CHECK(figure(summary, "surface_error") <= 0.5);
}

TEST_CASE(
    "from_surface: a torus from a file, its tube grown to radius 0.5, one handle all the time") {
    const Cli cli;
    const json summary = run_demo(cli, "from_surface", {"initial_mesh.cells=32"});
    CHECK(summary["genus"] == 1);
    CHECK(summary["shells"] == 1);
    CHECK(eventless(summary));
    const json& start = summary["initial_mesh"];
    CHECK(start["interface_genus"] == 1);
    CHECK(start["interface_to_surface"].get<double>() <= 0.25);
    CHECK(start["surface_to_interface"].get<double>() <= 0.25);
    const auto surface = dsc::io::read_surface(cli.folder() / "out/result/surface.obj");
    const double edge = summary["target_length"].get<double>();
    double sum = 0;
    for (const Vec3& p : surface.points) {
        const double away = std::abs(std::hypot(std::hypot(p.x(), p.y()) - 0.75, p.z()) - 0.5);
        CHECK(away < 0.3 * edge);
        sum += away;
    }
    CHECK(sum / static_cast<double>(surface.points.size()) < 0.05 * edge);
    CHECK(summary["volume"].get<double>() ==
          doctest::Approx(2 * 9.8696044 * 0.75 * 0.25).epsilon(0.04));
}

TEST_CASE("three_labels: worn round but for the rims, a surface for each label") {
    const Cli cli;
    const json summary = run_config(cli, "three_labels", {}, "out");
    dsc::test::check_phases(cli.folder() / "out", {1, 2, 3});
    CHECK(summary["junction_vertices"] == 48);
    for (const char* label : {"1", "2", "3"})
        CHECK(summary["labels"][label]["surface"]["genus"] == 0);
    CHECK(summary["volume"].get<double>() < 0.9 * summary["volume_initial"].get<double>());
}

TEST_CASE("average: a cube becomes round") {
    const Cli cli;
    const json summary = run_demo(cli, "average");
    CHECK(summary["components"] == 1);
    CHECK(eventless(summary));
    const auto surface = dsc::io::read_surface(cli.folder() / "out/result/surface.obj");
    double least = 10;
    double most = 0;
    for (const Vec3& p : surface.points) {
        least = std::min(least, p.norm());
        most = std::max(most, p.norm());
    }
    // The cube's corners are 1.73 times as far from its middle as its faces.
    CHECK(most / least < 1.25);
}

TEST_CASE("normal: the radius grows by the speed in every step") {
    const Cli cli;
    const json summary = run_demo(cli, "normal");
    CHECK(figure(summary, "radius_error") < 0.01);
    CHECK(figure(summary, "volume_drift") < 0.01);
    CHECK(eventless(summary));
}
