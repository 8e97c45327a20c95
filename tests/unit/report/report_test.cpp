// A run's states on the way, its report and comparisons, made from the folder alone.
#include <cmath>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <dsc/base/error.hpp>
#include <dsc/hooks/curvature_estimator.hpp>
#include <dsc/io/read.hpp>
#include <dsc/io/series.hpp>
#include <dsc/report/report.hpp>
#include <dsc/run/measure.hpp>
#include <dsc/run/run_experiment.hpp>
#include <dsc/run/run_folder.hpp>
#include <dsc/surface/measure.hpp>
#include <dsc/surface/surface_view.hpp>

#include "report/record.hpp"
#include "report/warnings.hpp"
#include "run/state_series.hpp"
#include "runs.hpp"

using namespace dsc;
using dsc::test::abscissas;
using dsc::test::cloud_of_a_cube;
using dsc::test::count;
using dsc::test::Folder;
using dsc::test::minimal;
using dsc::test::with_cloud;
using dsc::test::work;
namespace fs = std::filesystem;

namespace {

const std::vector<double>& array(const std::vector<io::DataArray>& arrays,
                                 const std::string& name) {
    for (const io::DataArray& a : arrays) {
        if (a.name == name) return a.values;
    }
    FAIL("no array " << name);
    return arrays.front().values;
}

}  // namespace

TEST_CASE(
    "series: every few steps a surface and a volume, arrays and values as the mesh has them") {
    const Folder folder;
    work(folder, "run", with_cloud(folder, "output: {series: {every: 2}}\n"),
         {"schedule.0.steps=5", "velocity.factor=-0.02", "velocity.curvature={type: abscissa}"});
    const fs::path series = folder.path() / "run/series";
    std::vector<std::string> files;
    for (const auto& entry : fs::directory_iterator(series))
        files.push_back(entry.path().filename().string());
    std::sort(files.begin(), files.end());
    CHECK(files == std::vector<std::string>{"surface.pvd", "surface_000000.vtp",
                                            "surface_000002.vtp", "surface_000004.vtp",
                                            "volume.pvd", "volume_000000.vtu", "volume_000002.vtu",
                                            "volume_000004.vtu"});
    const std::string index = folder.read("run/series/surface.pvd");
    CHECK(index.find("timestep=\"4\" part=\"0\" file=\"surface_000004.vtp\"") != std::string::npos);
    CHECK(count(index, "<DataSet") == 3);
    CHECK(count(folder.read("run/series/volume.pvd"), "<DataSet") == 3);

    io::SurfaceData data;
    const surface::TriangleMesh mesh = io::read_vtp(series / "surface_000004.vtp", &data);
    const mesh::TetMesh volume = io::read_volume(series / "volume_000004.vtu");
    CHECK(mesh.points.size() == 98);
    CHECK(mesh.faces.size() == 192);
    CHECK(run::measure(volume).solid());
    // The surface is the volume's interface, in the input's coordinates.
    const surface::TriangleMesh interface = surface::extract_interface(volume);
    CHECK(interface.faces.size() == mesh.faces.size());
    CHECK(surface::volume(mesh) == doctest::Approx(surface::volume(interface)));
    CHECK(surface::volume(mesh) ==
          doctest::Approx(std::pow(10 * std::pow(0.98, 4) * 0.5, 3)).epsilon(1e-9));
    const Vec3 centre(12, 22, 32);
    CHECK((surface::used_box(mesh).centre() - centre).norm() < 1e-9);

    std::vector<Vec3> cloud;
    std::istringstream points(cloud_of_a_cube());
    for (Vec3 p; points >> p.x() >> p.y() >> p.z();) cloud.push_back(p);
    const std::vector<double>&distance = array(data.points, "distance"),
          &curvature = array(data.points, "curvature");
    REQUIRE(data.vectors.size() == 1);
    REQUIRE(distance.size() == 98);
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        double nearest = 1e9;
        for (const Vec3& p : cloud) nearest = std::min(nearest, (p - mesh.points[i]).norm());
        CHECK(distance[i] == doctest::Approx(nearest));
        // As the velocity sees it: normalised.
        CHECK(curvature[i] == doctest::Approx((mesh.points[i].x() - 12) * 0.2));
        CHECK(data.vectors[0].values[i].norm() == doctest::Approx(1.0));
        CHECK(data.vectors[0].values[i].dot(mesh.points[i] - centre) > 0);
    }
    for (const double label : array(data.cells, "label")) CHECK(label == 1);
    for (const double quality : array(data.cells, "quality")) {
        CHECK(quality > 0.5);
        CHECK(quality <= 1.0 + 1e-12);
    }
    const std::string vtu = folder.read("run/series/volume_000004.vtu");
    for (const char* name : {"Name=\"label\"", "Name=\"quality\"", "Name=\"distance\""})
        CHECK(vtu.find(name) != std::string::npos);
}

TEST_CASE("series: no cloud, no curvature: those arrays are left out; states that are there are "
          "taken up again") {
    const Folder folder;
    work(folder, "run", minimal + "output: {series: {every: 1}}\n");
    io::SurfaceData data;
    io::read_vtp(folder.path() / "run/series/surface_000002.vtp", &data);
    CHECK(data.points.empty());
    CHECK(data.cells.size() == 2);
    const auto kept = run::kept_states(folder.path() / "run", "surface");
    REQUIRE(kept.size() == 3);
    CHECK(kept[2].step == 2);
    folder.write("run/series/surface_x.vtp", "no state");
    folder.write("run/series/surface_7.vtp", "none either");
    CHECK(run::kept_states(folder.path() / "run", "surface").size() == 3);
    CHECK(run::kept_states(folder.path() / "nowhere", "surface").empty());
}

TEST_CASE("report: a run writes it, and dsc report the same bytes; nothing in it is fetched") {
    const Folder folder;
    const run::RunOutcome outcome =
        work(folder, "run", with_cloud(folder, "output: {report: true}\n"),
             {"observers=[{type: counter}]"});
    const std::string page = folder.read("run/report.html");
    CHECK(outcome.report == folder.path() / "run/report.html");
    CHECK(page == report::report_html(folder.path() / "run", abscissas()));
    Workers three(3);
    CHECK(page == report::report_html(folder.path() / "run", abscissas(), &three));
    CHECK(page.substr(0, 15) == "<!DOCTYPE html>");
    for (const char* part :
         {"In short", "Time and size (table 6.1)", "table 6.2", "Distance, normalised units",
          "Tets by quality", "Points of the cloud by distance", "Time by phase",
          "Changes of topology", "The cloud and the start", "noise to width", "Provenance",
          "cloud.xyz", "counter.count", "\"label\":\"step 0\"", "\"label\":\"step 1\"",
          "\"label\":\"result\"", "\"tets\":{", "three.js r111", "normalize:"}) {
        CAPTURE(part);
        CHECK(page.find(part) != std::string::npos);
    }
    CHECK(count(page, "\"label\":\"step ") == 2);
    CHECK(page.find("default-src 'none'") != std::string::npos);
    // What the command line held is text here.
    CHECK(page.find("<b>bold</b>") == std::string::npos);
    CHECK(page.find("&lt;b&gt;bold&lt;/b&gt;") != std::string::npos);
    CHECK_FALSE(fs::exists(folder.path() / "run/series/volume.pvd"));

    work(folder, "plain", minimal);
    CHECK_FALSE(fs::exists(folder.path() / "plain/report.html"));
    CHECK_FALSE(fs::exists(folder.path() / "plain/series"));
    const std::string later = report::report_html(folder.path() / "plain", abscissas());
    CHECK(later.find("table 6.1") != std::string::npos);
    CHECK(later.find("table 6.2") == std::string::npos);
}

TEST_CASE(
    "report: each refinement with what is left of it, and a warning for one after the last step") {
    const Folder folder;
    work(folder, "run", minimal + "output: {report: true}\n",
         {"velocity.factor=-0.01",
          "schedule=[{steps: 1}, {refine: {type: all}}, {steps: 6}, {refine: {type: all}}]"});
    const std::string page = folder.read("run/report.html");
    const nlohmann::json items =
        nlohmann::json::parse(folder.read("run/summary.json"))["refinements"]["items"];
    REQUIRE(items.size() == 2);
    CHECK(items[0]["vertices_made"].get<int>() > 50);
    CHECK(items[0]["vertices_present"] == items[0]["vertices_made"]);
    std::string row = "<td>schedule.1 all</td>";
    for (const char* key : {"calls", "skipped", "requested", "committed", "vertices_made",
                            "vertices_followed", "vertices_present"})
        row += "<td>" + std::to_string(items[0][key].get<int>()) + "</td>";
    CHECK(count(page, row) == 1);
    CHECK(count(page, "<td>schedule.3 all</td><td>0</td><td>1</td>") == 1);
    CHECK(count(page, "comes after the last step and was skipped") > 0);
    CHECK(folder.read("run/metrics.csv").find(",refine_present") != std::string::npos);
    work(folder, "plain", minimal);
    CHECK(folder.read("plain/metrics.csv").find("refine") == std::string::npos);
    CHECK(report::report_html(folder.path() / "plain", abscissas()).find("Refinements") ==
          std::string::npos);
}

TEST_CASE("report: a missing or different cloud is reported and not shown") {
    const Folder folder;
    work(folder, "run", with_cloud(folder, "output: {report: true}\n"));
    const std::string before = folder.read("run/report.html");
    CHECK(before.find("\"cloud\":{") != std::string::npos);
    folder.write("cloud.xyz", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n");
    const std::string other = report::report_html(folder.path() / "run", abscissas());
    CHECK(other.find("\"cloud\":{") == std::string::npos);
    CHECK(other.find("the cloud is not shown: " + (folder.path() / "cloud.xyz").string() +
                     ": is not the file that the run read") != std::string::npos);
    fs::remove(folder.path() / "cloud.xyz");
    CHECK(
        report::report_html(folder.path() / "run", abscissas()).find("the cloud is not shown: ") !=
        std::string::npos);
}

TEST_CASE("report: folders that are no run's, runs without a result, damaged files") {
    const Folder folder;
    CHECK_THROWS_AS(report::report_html(folder.path() / "none", abscissas()), IoError);
    CHECK_THROWS_AS(report::report_html(folder.path(), abscissas()), IoError);
    work(folder, "run", minimal);
    const auto refused = [&](const std::string& file, const std::string& text) {
        const std::string good = folder.read("run/" + file);
        folder.write("run/" + file, text);
        std::string code = "accepted";
        try {
            report::report_html(folder.path() / "run", abscissas());
        } catch (const Error& error) {
            code = error.code();
        }
        folder.write("run/" + file, good);
        return code;
    };
    CHECK(refused("summary.json", "{") == "report.damaged");
    CHECK(refused("summary.json", "[]") == "report.damaged");
    CHECK(refused("summary.json", "{\"input\": {\"filters\": [{\"kept\": \"x\"}]}}") ==
          "report.damaged");
    CHECK(refused("metrics.csv", "a,b\n1\n") == "report.metrics");
    CHECK(refused("config.resolved.yaml", "a: [") != "accepted");
    CHECK(refused("provenance.json", "{}") == "accepted");
    CHECK(refused("summary.json", "{}") == "accepted");
    // A page without one of its parts is still a page.
    CHECK(refused("result/volume.dsc", "v 0 0") == "accepted");
    fs::remove(folder.path() / "run/summary.json");
    CHECK_THROWS_AS(report::report_html(folder.path() / "run", abscissas()), IoError);
}

TEST_CASE("report: hostile names in every file of the run stay text") {
    const Folder folder;
    work(folder, "run", minimal + "output: {report: true}\n", {"observers=[{type: counter}]"});
    const std::string evil = "</script><script>alert(1)</script><img src=x onerror=alert(1)>\"'";
    const auto spoil = [&](const std::string& file, const auto& change) {
        auto json = nlohmann::ordered_json::parse(folder.read("run/" + file));
        change(json);
        folder.write("run/" + file, json.dump());
    };
    spoil("summary.json", [&](auto& json) {
        json["name"] = evil;
        json["status"] = evil;
        json["events"][evil] = 1;
        json["operations"][evil] = {{"tried", 1}, {"committed", 1}};
        json["labels"][evil] = {{"surface", {{"closed_manifold", false}}}};
        json["input"] = {
            {"filters", {{{"type", evil}, {"kept", 1}, {"removed", 9}, {"notes", {evil}}}}}};
    });
    spoil("provenance.json", [&](auto& json) {
        json["command"] = {evil};
        json["machine"][evil] = evil;
        json["inputs"] = {{{"file", evil}, {"sha256", evil}}};
        json["plugins"][0]["name"] = evil;
        json["versions"]["dsc"] = evil;
        json["finished"] = evil;
    });
    std::string metrics = folder.read("run/metrics.csv");
    const std::string column = "observers.counter.count";
    metrics.replace(metrics.find(column), column.size(), "observers." + evil);
    folder.write("run/metrics.csv", metrics);
    folder.write("run/config.resolved.yaml",
                 folder.read("run/config.resolved.yaml") + "# " + evil + "\n");
    CHECK(report::report_html(folder.path() / "run", abscissas()).find("Notes on the cloud") !=
          std::string::npos);
    const report::ComparedRun folders[] = {{folder.path() / "run"}, {folder.path() / "run"}};
    for (const std::string& page : {report::report_html(folder.path() / "run", abscissas()),
                                    report::comparison_html(folders, abscissas())}) {
        CHECK(page.find("<script>alert") == std::string::npos);
        CHECK(page.find("<img src=x") == std::string::npos);
        CHECK(page.find("&lt;script&gt;alert(1)") != std::string::npos);
    }
}

TEST_CASE("warnings: what a reader must know") {
    const Folder folder;
    work(folder, "run", minimal);
    report::RunRecord record = report::read_record(folder.path() / "run");
    CHECK(report::warnings(record).empty());
    for (const report::Check& check : report::validity(record)) CHECK(check.holds);
    const auto with = [&](const char* key, const nlohmann::ordered_json& value) {
        const auto before = record.summary;
        record.summary[key] = value;
        const std::vector<std::string> said = report::warnings(record);
        record.summary = before;
        REQUIRE(said.size() == 1);
        return said.front();
    };
    CHECK(with("status", "stalled").find("stalled") != std::string::npos);
    CHECK(with("self_intersections", 3) == "Not valid: self-intersections: 3.");
    CHECK(with("surface_is_interface_of_volume", false).find("interface") != std::string::npos);
    CHECK(with("clamped", 1) == "1 destination was outside the box and was moved inside.");
    CHECK(with("min_tet_quality", 1e-5).find("nearly flat") != std::string::npos);
    CHECK(with("components", 2) == "The surface has 2 components.");
}
