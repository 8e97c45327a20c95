// Bodies of three labels and more, from .dsc files that the tests write, through the real command.
#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <sstream>

#include <doctest/doctest.h>

#include <dsc/generate/lattice.hpp>
#include <dsc/io/read.hpp>
#include <dsc/io/write.hpp>
#include <dsc/surface/measure.hpp>

#include "results.hpp"

using dsc::Vec3;
using dsc::mesh::Label;
using dsc::mesh::TetMesh;
using dsc::test::Cli;
using nlohmann::json;

namespace {

/// A box [-1.5, 1.5]^3 of equal cells, labelled by the barycentres of its tets.
template <class LabelAt>
TetMesh labelled(int cells, const LabelAt& label_at) {
    dsc::generate::LatticeOptions options;
    options.cells = cells;
    options.growth = 1;
    TetMesh mesh = dsc::generate::make_lattice(
        options, [](const Vec3&, double) { return false; }, "test");
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        Vec3 sum = Vec3::Zero();
        for (const std::uint32_t v : mesh.tets[t]) sum += mesh.points[v];
        mesh.labels[t] = label_at(Vec3(sum / 4));
    }
    return mesh;
}

/// Points in tets of three labels or more, by their coordinates.
std::set<std::array<double, 3>> junctions(const TetMesh& mesh) {
    std::vector<std::set<Label>> labels(mesh.points.size());
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        for (const std::uint32_t v : mesh.tets[t]) labels[v].insert(mesh.labels[t]);
    }
    std::set<std::array<double, 3>> places;
    for (std::size_t v = 0; v < labels.size(); ++v) {
        const Vec3& p = mesh.points[v];
        if (labels[v].size() > 2) places.insert({p.x(), p.y(), p.z()});
    }
    return places;
}

std::set<std::string> column(const Cli& cli, const std::string& name) {
    std::istringstream lines(cli.read("out/metrics.csv"));
    std::string line, cell;
    std::getline(lines, line);
    std::size_t index = 0;
    std::istringstream header(line);
    while (std::getline(header, cell, ',') && cell != name) ++index;
    std::set<std::string> values;
    while (std::getline(lines, line)) {
        std::istringstream cells(line);
        for (std::size_t i = 0; i <= index; ++i) std::getline(cells, cell, ',');
        values.insert(cell);
    }
    return values;
}

std::string experiment(const std::string& velocity, int steps) {
    return "dsc: 1\nname: labels\ninitial_mesh: {type: dsc_file, file: start.dsc}\nvelocity: " +
           velocity + "\nimprovement: {type: dsc}\nschedule: [{steps: " + std::to_string(steps) +
           "}]\n";
}

/// Runs it, checks all files, and that no vertex where three labels meet has moved or gone.
json run(const Cli& cli, const TetMesh& start, const std::vector<Label>& labels,
         const std::string& velocity, int steps) {
    dsc::io::write_volume(cli.folder() / "start.dsc", start);
    cli.write("labels.yaml", experiment(velocity, steps));
    const auto result = cli.dsc({"run", "labels.yaml", "-o", "out", "-q"});
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    dsc::test::check_phases(cli.folder() / "out", labels);
    const auto before = junctions(start),
               after = junctions(dsc::io::read_volume(cli.folder() / "out/result/volume.dsc"));
    CHECK_FALSE(before.empty());
    CHECK(std::includes(after.begin(), after.end(), before.begin(), before.end()));
    const json summary = dsc::test::summary_of(cli, "out");
    CHECK(summary["junction_vertices"] == after.size());
    CHECK(summary["inverted_tets"] == 0);
    CHECK(summary["self_intersections"] == 0);
    CHECK(summary["surface_is_interface_of_volume"] == true);
    double volume = 0;
    for (const Label label : labels) {
        const json& row = summary["labels"][std::to_string(label)];
        CHECK(row["surface"]["closed_manifold"] == true);
        CHECK(row["surface"]["volume"].get<double>() ==
              doctest::Approx(row["volume"].get<double>()).epsilon(1e-9));
        volume += row["volume"].get<double>();
    }
    CHECK(summary["volume"].get<double>() == doctest::Approx(volume).epsilon(1e-9));
    return summary;
}

}  // namespace

TEST_CASE("a cube of three slabs, worn round: the two rims stay, to the last bit") {
    const Cli cli;
    const TetMesh start = labelled(18, [](const Vec3& p) {
        if (p.cwiseAbs().maxCoeff() > 1) return 0;
        return p.z() < -1.0 / 3 ? 1 : p.z() < 1.0 / 3 ? 2 : 3;
    });
    // Two squares of twelve cells a side.
    CHECK(junctions(start).size() == 96);
    const json summary = run(cli, start, {1, 2, 3}, "{type: average, part: 0.3}", 25);
    CHECK(summary["junction_vertices"] == 96);
    CHECK(column(cli, "junction_vertices") == std::set<std::string>{"96"});
    for (const char* label : {"1", "2", "3"}) {
        const json& surface = summary["labels"][label]["surface"];
        CHECK(surface["components"] == 1);
        CHECK(surface["genus"] == 0);
    }
    // It has moved: corners and edges away from the rims are worn, alike at both ends.
    const double low = summary["labels"]["1"]["volume"], high = summary["labels"]["3"]["volume"];
    CHECK(low < 0.95 * 8.0 / 3);
    CHECK(low == doctest::Approx(high).epsilon(0.01));
    CHECK(summary["volume_initial"].get<double>() == doctest::Approx(8.0));
}

TEST_CASE("a ball of two halves: the equator stays, the halves have closed surfaces that share the "
          "disc") {
    const Cli cli;
    const TetMesh start = labelled(20, [](const Vec3& p) {
        return p.norm() > 0.9 ? 0 : p.x() < 0 ? 1 : 2;
    });
    const json summary = run(cli, start, {1, 2}, "{type: average, part: 0.3}", 15);
    CHECK(summary["labels"]["1"]["volume"].get<double>() ==
          doctest::Approx(summary["labels"]["2"]["volume"].get<double>()).epsilon(0.02));
    // of the interface as a whole: the equator
    CHECK(summary["nonmanifold_edges"].get<int>() > 20);
    const auto info = json::parse(cli.dsc({"info", "out/result/volume.dsc", "--json"}).out);
    CHECK(info["junction_vertices"] == summary["junction_vertices"]);
    CHECK(info["labels"].size() == 3);
}

TEST_CASE("five labels, four of them round an axis: all that three of them share stays") {
    const Cli cli;
    // Quarters about the z axis, and the outside.
    const TetMesh start = labelled(16, [](const Vec3& p) {
        if (p.cwiseAbs().maxCoeff() > 0.75) return 0;
        return 1 + (p.x() > 0 ? 1 : 0) + (p.y() > 0 ? 2 : 0);
    });
    run(cli, start, {1, 2, 3, 4}, "{type: average, part: 0.2}", 10);
}

TEST_CASE("one label above 0 has no surface of its own beside that of all") {
    const Cli cli;
    const TetMesh start =
        labelled(12, [](const Vec3& p) { return p.cwiseAbs().maxCoeff() > 1 ? 0 : 5; });
    dsc::io::write_volume(cli.folder() / "start.dsc", start);
    cli.write("labels.yaml", experiment("{type: average, part: 0.3}", 2));
    REQUIRE(cli.dsc({"run", "labels.yaml", "-o", "out", "-q"}).code == 0);
    dsc::test::check_result(cli.folder() / "out");
    CHECK_FALSE(cli.exists("out/result/surface_5.obj"));
    CHECK(dsc::test::summary_of(cli, "out")["junction_vertices"] == 0);
}

TEST_CASE("convert: a .dsc with tets of both orientations, as the original's, becomes a .vtu of "
          "positive tets") {
    const Cli cli;
    TetMesh mixed = labelled(6, [](const Vec3& p) { return p.norm() > 1 ? 0 : p.x() < 0 ? 1 : 2; });
    dsc::io::write_volume(cli.folder() / "start.dsc", mixed);
    std::istringstream lines(cli.read("start.dsc"));
    std::string line, text;
    for (std::size_t n = 0; std::getline(lines, line); ++n) {
        std::array<std::string, 6> f;
        std::istringstream fields(line);
        for (std::string& field : f) fields >> field;
        if (f[0] == "t" && n % 2 == 0)
            line = "t " + f[2] + " " + f[1] + " " + f[3] + " " + f[4] + " " + f[5];
        text += line + "\n";
    }
    cli.write("mixed.dsc", text);
    CHECK(json::parse(cli.dsc({"info", "mixed.dsc", "--json"}).out)["inverted_tets"] ==
          mixed.tets.size() / 2);
    REQUIRE(cli.dsc({"convert", "mixed.dsc", "mixed.vtu"}).code == 0);
    const auto info = json::parse(cli.dsc({"info", "mixed.vtu", "--json"}).out);
    CHECK(info["inverted_tets"] == 0);
    CHECK(info["tets"] == mixed.tets.size());
    CHECK(info["fills_box"] == true);
    CHECK(info["junction_vertices"] == junctions(mixed).size());
}

TEST_CASE("a run goes on from the result of another: the same file, to the last bit") {
    const Cli cli;
    const TetMesh start = labelled(16, [](const Vec3& p) {
        return p.norm() > 0.9 ? 0 : p.x() < 0 ? 1 : 2;
    });
    run(cli, start, {1, 2}, "{type: average, part: 0.3}", 5);
    const std::string first = cli.read("out/result/volume.dsc");
    cli.write("start.dsc", first);
    // Nobody moves, and nothing is left to repair after the steps before.
    cli.write("labels.yaml", experiment("{type: rotate, degrees: 0}", 1));
    REQUIRE(cli.dsc({"run", "labels.yaml", "-o", "out", "-q", "improvement.min_tet_quality=0.01",
                     "improvement.degenerate_tet_quality=0.001", "improvement.smooth_below=0",
                     "improvement.min_edge_length=0", "improvement.min_tet_volume=0"})
                .code == 0);
    CHECK(cli.read("out/result/volume.dsc") == first);
}
