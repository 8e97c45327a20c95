#include "results.hpp"

#include <span>

#include <doctest/doctest.h>

#include <dsc/io/read.hpp>
#include <dsc/run/measure.hpp>
#include <dsc/surface/surface_view.hpp>

#include "../unit/surface/cgal_judge.hpp"

namespace dsc::test {

namespace {

/// Valid tets that fill the box, the same in both files; their measure.
run::VolumeMeasure check_volume(const std::filesystem::path& folder, const mesh::TetMesh& volume) {
    const run::VolumeMeasure measure = run::measure(volume);
    CHECK(measure.inverted_tets == 0);
    CHECK(measure.adjacency_valid());
    CHECK(measure.fills_box());
    const auto zipped = io::read_volume(folder / "result" / "volume.vtu");
    CHECK(zipped.points == volume.points);
    CHECK(zipped.tets == volume.tets);
    CHECK(zipped.labels == volume.labels);
    return measure;
}

}  // namespace

void check_result(const std::filesystem::path& folder) {
    const auto surface = io::read_surface(folder / "result" / "surface.obj");
    const auto volume = io::read_volume(folder / "result" / "volume.dsc");
    CHECK(run::identical(surface, dsc::surface::extract_interface(volume)));
    CHECK(run::identical(surface, io::read_surface(folder / "result" / "surface.ply")));
    const run::VolumeMeasure measure = check_volume(folder, volume);
    CHECK(measure.interface_measure.solid());
    CHECK(measure.interface_measure.report.duplicate_points == 0);
    CHECK(dsc::surface::test::cgal_mesh_intersections(surface).empty());
}

void check_phases(const std::filesystem::path& folder, const std::vector<mesh::Label>& labels) {
    const auto result = folder / "result";
    const auto volume = io::read_volume(result / "volume.dsc");
    check_volume(folder, volume);
    const auto whole = io::read_surface(result / "surface.obj");
    CHECK(run::identical(whole, dsc::surface::extract_interface(volume)));
    CHECK(run::measure(whole).intersections.count == 0);
    for (const mesh::Label label : labels) {
        CAPTURE(label);
        const std::string stem = "surface_" + std::to_string(label);
        const auto surface = io::read_surface(result / (stem + ".obj"));
        CHECK(run::identical(surface, dsc::surface::extract_phase(volume, label)));
        CHECK(run::identical(surface, io::read_surface(result / (stem + ".ply"))));
        CHECK(run::measure(surface).solid());
        CHECK(dsc::surface::test::cgal_mesh_intersections(surface).empty());
    }
}

nlohmann::json summary_of(const Cli& cli, const std::string& folder) {
    return nlohmann::json::parse(cli.read(folder + "/summary.json"));
}

void load_strategies(host::Host& host) {
    const host::SearchEntry folder{std::filesystem::path(DSC_TEST_IMPROVEMENT).parent_path(),
                                   "--plugin", true};
    host.load_all(std::span(&folder, 1));
}

std::string config(const std::string& name) {
    return (std::filesystem::path(DSC_SOURCE_DIR) / "configs" / name).string();
}

}  // namespace dsc::test
