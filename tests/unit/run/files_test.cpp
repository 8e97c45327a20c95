// Inputs, run folders, measures and tables: everything of a run that needs no kernel.
#include <algorithm>
#include <cmath>

#include <unistd.h>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/base/read_file.hpp>
#include <dsc/run/figures.hpp>
#include <dsc/run/input.hpp>
#include <dsc/run/measure.hpp>
#include <dsc/run/metrics.hpp>
#include <dsc/run/run_folder.hpp>
#include <dsc/text/numbers.hpp>

#include "fakes.hpp"

using namespace dsc;
using dsc::test::Folder;
namespace fs = std::filesystem;

namespace {

run::Input sampled(std::uint64_t n) {
    run::Input input;
    input.cloud.sample = run::SampleInput{"sphere", n, 0.0, 0.0};
    return input;
}

config::StrategyConfig filter(const std::string& type) { return {type, config::ConfigNode::map()}; }

const test::Strategies& catalogue() {
    static const test::Strategies strategies;
    return strategies;
}

run::LoadedInput load(const run::Input& input, std::uint64_t seed) {
    run::InputFiles files;
    return run::load_input(input, seed, catalogue(), files);
}

mesh::TetMesh box_mesh(int cells) {
    const dsc::test::Strategies strategies;
    const plugin::Setup setup(strategies, "initial_mesh");
    dsc::test::BoxMesh box({cells, 0.5, std::nullopt}, setup);
    return box.build({});
}

}  // namespace

TEST_CASE("input: the same sample for the same seed, filters in order, normalised") {
    run::Input input = sampled(500);
    const run::LoadedInput plain = load(input, 3);
    CHECK(plain.report.points == 500);
    CHECK(plain.report.used == 500);
    CHECK(plain.target.transform().identity());
    CHECK(load(input, 3).cloud.points == plain.cloud.points);
    CHECK(load(input, 4).cloud.points != plain.cloud.points);

    input.normalize = run::NormalizeInput{0.5};
    input.cloud.filters = {filter("distinct"), filter("every_nth")};
    const run::LoadedInput small = load(input, 3);
    REQUIRE(small.report.filters.size() == 2);
    CHECK(small.report.filters[0].filter == "distinct");
    CHECK(small.report.filters[0].removed == 0);
    CHECK(small.report.used == small.report.filters[1].kept);
    CHECK(small.report.used == 250);
    CHECK(small.cloud.points[1] == plain.cloud.points[2]);
    REQUIRE(small.report.filters[1].reasons.size() == 1);
    CHECK(small.report.filters[1].reasons[0].count == 250);
    CHECK(small.report.filters[1].figures ==
          std::vector<std::pair<std::string, double>>{{"part_kept", 0.5}});
    CHECK(small.target.box().high.maxCoeff() == doctest::Approx(0.5));
    const Vec3 back = small.target.transform().inverse(small.target[0]);
    CHECK((back - small.cloud.points[0]).norm() < 1e-14);
}

TEST_CASE("input: a variation comes before the filters, and the file's coordinates come back") {
    const Folder folder;
    const run::LoadedInput plain = load(sampled(400), 3);
    std::string text;
    for (const Vec3& p : plain.cloud.points) {
        for (int k = 0; k < 3; ++k) text += text::exact(p[k] + 10.0 * k) + (k < 2 ? " " : "\n");
    }
    run::Input input;
    input.cloud.file = folder.write("cloud.xyz", text);
    input.normalize = run::NormalizeInput{0.5};
    const run::LoadedInput whole = load(input, 1);
    CHECK(load(input, 2).cloud.points == whole.cloud.points);
    CHECK_FALSE(whole.report.variation.has_value());

    input.cloud.vary = cloud::Variation{0.75, 0.0, true};
    input.cloud.filters = {filter("every_nth")};
    const run::LoadedInput varied = load(input, 2);
    REQUIRE(varied.report.variation.has_value());
    CHECK(varied.report.points == 400);
    CHECK(varied.report.variation->left_out == 100);
    CHECK(varied.report.used == 150);
    CHECK(load(input, 2).target[7] == varied.target[7]);
    CHECK(load(input, 1).target[7] != varied.target[7]);
    // Points of the file, where they are in the file.
    REQUIRE(varied.cloud.points.size() == 150);
    std::size_t found = 0;
    for (const Vec3& p : varied.cloud.points)
        for (const Vec3& q : whole.cloud.points) found += (p - q).norm() < 1e-12 ? 1U : 0U;
    CHECK(found == 150);
    const cloud::Transform& transform = varied.target.transform();
    REQUIRE(transform.rotation.has_value());
    for (std::size_t i = 0; i < 150; ++i) {
        CHECK((transform.inverse(varied.target[i]) - varied.cloud.points[i]).norm() < 1e-12);
        CHECK((transform.apply(varied.cloud.points[i]) - varied.target[i]).norm() < 1e-12);
    }
    // The rotated cloud is what is normalised.
    CHECK(varied.target.box().high.maxCoeff() == doctest::Approx(0.5));
    CHECK(varied.target.box().centre().norm() < 1e-12);
    // What a filter left out is known in normalised units.
    REQUIRE(varied.removed.size() == 150);
    for (const Vec3& p : varied.removed) {
        const Vec3 in_file = transform.inverse(p);
        CHECK(std::any_of(whole.cloud.points.begin(), whole.cloud.points.end(),
                          [&](const Vec3& q) { return (q - in_file).norm() < 1e-12; }));
    }
}

TEST_CASE("input: a variation that changes nothing is refused") {
    const std::string text =
        test::minimal + "input: {cloud: {sample: {n: 100}, vary: {subsample: 1, rotate: false}}}\n";
    try {
        test::load_text(text);
        FAIL("no error");
    } catch (const ConfigError& error) {
        CHECK(std::string(error.what()).find("'vary' changes nothing") != std::string::npos);
    }
    const auto loaded =
        test::load_text(test::minimal + "input: {cloud: {sample: {n: 100}, vary: {}}}\n");
    REQUIRE(loaded.experiment.input->cloud.vary.has_value());
    CHECK(loaded.experiment.input->cloud.vary->subsample == 0.9);
    CHECK(loaded.experiment.input->cloud.vary->rotate);
}

TEST_CASE("input: a filter that cannot be created is reported before the cloud is read") {
    run::Input input;
    input.cloud.file = "/nonexistent/cloud.xyz";
    input.cloud.filters = {filter("distinct"), filter("voxels")};
    try {
        load(input, 1);
        FAIL("no error");
    } catch (const PluginError& error) {
        CHECK(error.code() == "plugin.unknown_strategy");
        CHECK(
            std::string(error.what()).find("input.cloud.filters.1: there is no filter 'voxels'") ==
            0);
    }
}

TEST_CASE("input: without normalize a cloud outside the box is refused") {
    const Folder folder;
    run::Input input;
    input.cloud.file = folder.write("far.xyz", "0 0 0\n1 0 0\n0 1 0\n0 0 9\n");
    try {
        load(input, 1);
        FAIL("no error");
    } catch (const GeometryError& error) {
        CHECK(error.code() == "cloud.outside_box");
    }
    input.normalize = run::NormalizeInput{};
    CHECK(load(input, 1).target.size() == 4);
}

TEST_CASE("input: the columns of a text cloud, and its colours all the way to the target") {
    const Folder folder;
    run::Input input;
    input.cloud.file = folder.write(
        "a.csv", "id,north,east,up,r,g,b\n1,0,0,0,255,0,0\n2,0,1,0,0,255,0\n3,1,0,0,0,0,255\n"
                 "4,0,0,1,9,8,7\n5,0,0,1,1,2,3\n");
    input.cloud.columns = {"east", "north", "4", "r", "g", "b"};
    input.cloud.filters = {filter("distinct")};
    input.normalize = run::NormalizeInput{};
    const run::LoadedInput loaded = load(input, 1);
    CHECK(loaded.report.format == "CSV");
    CHECK(loaded.cloud.points[1] == Vec3(1, 0, 0));
    REQUIRE(loaded.target.colours().size() == 4);
    CHECK(loaded.target.colours()[1] == cloud::Colour{0, 255, 0});
    CHECK(loaded.target.colours()[3] == cloud::Colour{9, 8, 7});
    input.cloud.columns = {"2", "3", "4"};
    CHECK(load(input, 1).target.colours().empty());
}

TEST_CASE("run folder: takes an empty folder or one of ours, refuses all others untouched") {
    const Folder folder;
    const fs::path ours = folder.path() / "a" / "b";
    {
        const run::RunFolder run(ours);
        run.write("status.json", "{\"format\": \"dsc-run-1\", \"state\": \"running\"}");
        run.write("summary.json", "{}");
        run.write("notes.txt", "mine");
        run.open_staging();
        folder.write("a/b/.result.part/surface.obj", "v");
        CHECK_FALSE(fs::exists(ours / "result"));
        run.publish_results();
        CHECK(fs::exists(ours / "result" / "surface.obj"));
        CHECK_FALSE(fs::exists(run.staging()));
    }
    CHECK(run::RunFolder::is_ours(ours));
    {
        const run::RunFolder again(ours);
        CHECK_FALSE(fs::exists(ours / "result"));
        CHECK_FALSE(fs::exists(ours / "summary.json"));
        CHECK(fs::exists(ours / "notes.txt"));
    }

    // A run that is killed at its very first moment leaves this and no status.json.
    folder.write("killed/.status.json.4711-0.tmp", "{\"for");
    folder.write("killed/checkpoint/.step_3.dscstate.4711-9.tmp", "dsc");
    // no run makes a checkpoint before its status
    CHECK_THROWS_AS(run::RunFolder(folder.path() / "killed"), UsageError);
    fs::remove_all(folder.path() / "killed/checkpoint");
    folder.write("killed/.lock", "4711 elsewhere\n");  // stale: no process holds it
    {
        const run::RunFolder begun(folder.path() / "killed");
        CHECK_FALSE(fs::exists(begun.file(".status.json.4711-0.tmp")));
        begun.write("status.json", "{\"format\": \"dsc-run-1\", \"state\": \"running\"}");
    }
    folder.write("killed/checkpoint/.step_3.dscstate.4711-9.tmp", "dsc");
    folder.write("killed/checkpoint/step_3.dscstate", "dsc");
    folder.write("killed/series/.step_3.vtp.4711-3.tmp", "<?xml");
    folder.write("killed/.metrics.csv.4711-12.tmp", "step");
    const run::RunFolder resumed = run::RunFolder::claimed(folder.path() / "killed");
    CHECK(fs::exists(resumed.file(".metrics.csv.4711-12.tmp")));
    resumed.clear(run::RunFolder::Keep::progress);
    CHECK_FALSE(fs::exists(resumed.file(".metrics.csv.4711-12.tmp")));
    CHECK(fs::exists(resumed.file("checkpoint/step_3.dscstate")));
    CHECK_FALSE(fs::exists(resumed.file("checkpoint/.step_3.dscstate.4711-9.tmp")));
    CHECK_FALSE(fs::exists(resumed.file("series/.step_3.vtp.4711-3.tmp")));
    for (const std::string name :
         {".notes.tmp", ".notes.1-2x.tmp", "notes.1-2.tmp", ".1-2.tmp", "a.tmp", ".tmp"}) {
        CAPTURE(name);
        folder.write("notes_" + name + "/" + name, "mine");
        CHECK_THROWS_AS(run::RunFolder(folder.path() / ("notes_" + name)), UsageError);
        CHECK(folder.read("notes_" + name + "/" + name) == "mine");
    }

    folder.write("other/thesis.tex", "text");
    CHECK_THROWS_AS(run::RunFolder(folder.path() / "other"), UsageError);
    folder.write("status/status.json", "{\"state\": \"done\"}");
    CHECK_THROWS_AS(run::RunFolder(folder.path() / "status"), UsageError);
    CHECK(folder.read("other/thesis.tex") == "text");
    CHECK_THROWS_AS(run::RunFolder(folder.path() / "other" / "thesis.tex"), UsageError);
    CHECK_THROWS_AS(run::RunFolder(folder.path() / "other" / "thesis.tex" / "x"), IoError);
}

TEST_CASE("run folder: one owner; the second learns its name and changes nothing") {
    const Folder folder;
    const fs::path ours = folder.path() / "run";
    CHECK(run::RunFolder::owner(ours).empty());
    {
        const run::RunFolder first(ours);
        first.write("status.json", "{\"format\": \"dsc-run-1\", \"state\": \"running\"}");
        first.write("metrics.csv", "step");
        const std::string process = "process " + std::to_string(::getpid());
        CHECK(run::RunFolder::owner(ours).rfind(process, 0) == 0);
        try {
            const run::RunFolder second(ours);
            FAIL("a second owner");
        } catch (const UsageError& error) {
            CHECK(error.code() == "run.busy");
            CHECK(std::string(error.what()).find(process) != std::string::npos);
        }
        CHECK(folder.read("run/metrics.csv") == "step");
    }
    CHECK(run::RunFolder::owner(ours).empty());
    CHECK_FALSE(fs::exists(ours / ".lock"));
    const run::RunFolder next(ours);
    CHECK_FALSE(fs::exists(ours / "metrics.csv"));
}

TEST_CASE("metrics: empty cells without a cloud, columns of observers") {
    run::StepMetrics row;
    row.step = 3;
    row.mean_edge = 0.1;
    row.observers = {{"observers.a.error", 0.5}};
    const std::string header = run::csv_header(row);
    CHECK(header.substr(0, 24) == "step,interface_vertices,");
    CHECK(header.find(",observers.a.error\n") != std::string::npos);
    CHECK(run::csv_row(row) == "3,0,0,0,0,0.1,0,0,,,,0,0,0,0,0,0,0,0,0,0,0,0.5\n");
    row.observers.clear();
    CHECK(run::csv_row(row, 1) == "3,0,0,0,0,0.1,0,0,,,,0,0,0,0,0,0,0,0,0,0,0,\n");
    CHECK(header.find("refine") == std::string::npos);
    row.refinement = {.requested = 9, .committed = 8, .made = 7, .present = 6.0};
    CHECK(run::csv_header(row).find(
              ",events,refine_requested,refine_committed,refine_made,refine_present\n") !=
          std::string::npos);
    CHECK(run::csv_row(row, 1) == "3,0,0,0,0,0.1,0,0,,,,0,0,0,0,0,0,0,0,0,0,0,9,8,7,6,\n");
    row.refinement->present.reset();
    CHECK(run::csv_row(row) == "3,0,0,0,0,0.1,0,0,,,,0,0,0,0,0,0,0,0,0,0,0,9,8,7,\n");
    row.refinement.reset();
    const auto commas = [](const std::string& text) {
        return std::count(text.begin(), text.end(), ',');
    };
    CHECK(commas(header) == commas(run::csv_row(row, 1)));
}

TEST_CASE("metrics: a column has the cell of its figure, and a row of the documentation") {
    run::StepMetrics row;
    row.volume = 0.25;
    std::string cell;
    for (const run::MetricsColumn& column : run::metrics_columns)
        if (column.name == "volume") column.append(cell, row);
    CHECK(cell == "0.25");
    CHECK(run::column_name<&run::StepMetrics::volume> == "volume");
    const std::string page = read_file(std::string(DSC_SOURCE_DIR) + "/share/doc/experiment.md");
    std::string table;
    for (const run::MetricsColumn& column : run::metrics_columns) {
        table += "| `" + std::string(column.name) + "` | " + std::string(column.unit) + " | " +
                 std::string(column.meaning) + " |\n";
    }
    for (const run::MetricsColumn& column : run::refinement_columns) {
        table += "| `" + std::string(column.name) + "` | " + std::string(column.unit) + " | " +
                 std::string(column.meaning) + " |\n";
    }
    CHECK(page.find(table) != std::string::npos);
}

TEST_CASE("events are reported in the input's coordinates") {
    kernel::Event event;
    event.kind = kernel::Event::Kind::handle_opened;
    event.step = 12;
    event.place = Vec3(0.5, 0, -1);
    event.label = 1;
    event.tets = 4;
    event.volume = 1.0;
    event.thickness = 0.25;
    const cloud::Transform transform{Vec3(10, 20, 30), 2.0};
    CHECK(
        run::event_line(event, transform) ==
        "{\"kind\":\"handle_opened\",\"step\":12,\"place\":[10.25,20,29.5],\"label\":1,\"tets\":4,"
        "\"volume\":0.125,"
        "\"thickness\":0.25}\n");
}

TEST_CASE("measure: a sound box, and each of its possible defects") {
    const mesh::TetMesh good = box_mesh(12);
    const run::VolumeMeasure m = run::measure(good);
    CHECK(m.tets == 8640);
    CHECK(m.points == 2197);
    CHECK(m.adjacency_valid());
    CHECK(m.inverted_tets == 0);
    CHECK(m.fills_box());
    CHECK(m.boundary_faces == 6 * 144 * 2);
    CHECK(m.label_volumes.at(1) == doctest::Approx(1.0));
    CHECK(m.interface.points.size() == 98);
    CHECK(m.interface.faces.size() == 192);
    CHECK(m.solid());

    mesh::TetMesh bad = good;
    std::swap(bad.tets[5][0], bad.tets[5][1]);
    CHECK(run::measure(bad).inverted_tets == 1);
    CHECK_FALSE(run::measure(bad).solid());

    bad = good;
    bad.tets.push_back(bad.tets[0]);
    bad.labels.push_back(bad.labels[0]);
    CHECK_FALSE(run::measure(bad).adjacency_valid());
    CHECK(run::measure(bad).overused_faces + run::measure(bad).folded_faces == 4);

    bad = good;
    bad.tets[7][2] = 99999;
    CHECK(run::measure(bad).invalid_tets == 1);

    bad = good;
    bad.tets.pop_back();
    bad.labels.pop_back();
    CHECK(run::measure(bad).adjacency_valid());
    CHECK_FALSE(run::measure(bad).fills_box());
}

TEST_CASE("identical notices single bits and the order") {
    surface::TriangleMesh a{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {{0, 1, 2}}};
    surface::TriangleMesh b = a;
    CHECK(run::identical(a, b));
    b.points[1].x() = std::nextafter(1.0, 2.0);
    CHECK_FALSE(run::identical(a, b));
    b = a;
    b.faces[0] = {1, 2, 0};
    CHECK_FALSE(run::identical(a, b));
}
