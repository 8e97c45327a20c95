// Writes the surfaces and volumes of a run and measures the written files.
#include "result_files.hpp"

#include <algorithm>

#include <fmt/format.h>

#include <dsc/base/error.hpp>
#include <dsc/io/read.hpp>
#include <dsc/io/write.hpp>
#include <dsc/surface/measure.hpp>
#include <dsc/surface/surface_view.hpp>

#include "colours.hpp"

namespace dsc::run {
namespace {

namespace fs = std::filesystem;

/// The attributes of a surface's points; `vertex_of` maps them to points of the volume.
std::vector<io::DataArray> arrays(const hooks::Attributes& attributes,
                                  const std::vector<std::uint32_t>& vertex_of) {
    std::vector<io::DataArray> all;
    for (const hooks::Attribute& a : attributes) {
        io::DataArray& array = all.emplace_back();
        array.name = a.name;
        for (const std::uint32_t v : vertex_of) array.values.push_back(a.values[v]);
    }
    return all;
}

/// The labels above 0 if there are two or more: each has its own surface, and the interface is not
/// a manifold where they meet.
std::vector<mesh::Label> several_phases(const mesh::TetMesh& mesh) {
    std::vector<mesh::Label> labels(mesh.labels);
    std::sort(labels.begin(), labels.end());
    labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
    labels.erase(labels.begin(), std::upper_bound(labels.begin(), labels.end(), 0));
    if (labels.size() < 2) labels.clear();
    return labels;
}

/// Normals of a surface's points if they are requested, else none.
std::vector<Vec3> normals(const Output& output, const surface::TriangleMesh& surface) {
    return output.normals.value_or(false) ? surface::vertex_normals(surface) : std::vector<Vec3>();
}

std::string label_stem(mesh::Label label) { return fmt::format("surface_{}.", label); }

std::string preferred(const std::vector<std::string>& given,
                      std::initializer_list<const char*> order) {
    for (const char* extension : order) {
        if (std::find(given.begin(), given.end(), extension) != given.end()) return extension;
    }
    return given.front();
}

}  // namespace

void ResultFiles::write(const mesh::TetMesh& mesh, const hooks::Attributes& attributes,
                        const cloud::TargetCloud* target, std::span<const double> gaps,
                        RunOutcome& outcome) {
    folder_.open_staging();
    surface_ = surface::extract_interface(mesh, &vertex_of_);
    if (surface_.faces.empty() && target != nullptr) {
        throw GeometryError(
            "run.vanished", "result",
            "the surface vanished: no tet with a label above 0 is left, so there is no result; "
            "parts of the object may be thinner than the mesh resolution",
            "use more cells or smaller steps, or stop earlier");
    }
    if (output_.trim && target != nullptr) trim_surface(attributes, gaps, vertex_of_, outcome);
    if (target != nullptr) paint(surface_, *target);
    for (const std::string& extension : output_.surface) {
        if (surface_.faces.empty()) break;
        io::write_surface(staged("surface.", extension), surface_, arrays(attributes, vertex_of_),
                          normals(output_, surface_));
        outcome.surfaces.push_back(folder_.file("result") / ("surface." + extension));
    }
    for (const mesh::Label label : several_phases(mesh)) {
        std::vector<std::uint32_t> vertex_of;
        surface::TriangleMesh phase = surface::extract_phase(mesh, label, &vertex_of);
        if (target != nullptr) paint(phase, *target);
        for (const std::string& extension : output_.surface) {
            io::write_surface(staged(label_stem(label), extension), phase,
                              arrays(attributes, vertex_of), normals(output_, phase));
            outcome.surfaces.push_back(folder_.file("result") / (label_stem(label) + extension));
        }
    }
    io::VolumeData data;
    data.compressed = output_.compress.value_or(false);
    for (const hooks::Attribute& a : attributes) data.points.push_back({a.name, a.values});
    for (const std::string& extension : output_.volume) {
        io::write_volume(staged("volume.", extension), mesh, data);
        outcome.volumes.push_back(folder_.file("result") / ("volume." + extension));
    }
}

void ResultFiles::trim_surface(const hooks::Attributes& attributes, std::span<const double> gaps,
                               std::vector<std::uint32_t>& vertex_of, RunOutcome& outcome) {
    gaps_.assign(gaps.begin(), gaps.end());
    support_.clear();
    for (const hooks::Attribute& a : attributes) {
        if (a.name != "support" || !(output_.trim->support > 0.0)) continue;
        for (const std::uint32_t v : vertex_of) support_.push_back(a.values[v]);
    }
    std::vector<std::uint32_t> points_of;
    surface_ =
        surface::trim(surface_, gaps_, support_, {output_.trim->distance, output_.trim->support},
                      &points_of, &outcome.trimmed.emplace());
    if (surface_.faces.empty()) {
        throw GeometryError(
            "run.trimmed", "result",
            fmt::format("trimming removed the whole surface: every face has a vertex farther than "
                        "{} spacings from the points or with too little support",
                        output_.trim->distance),
            "raise output.trim.distance, lower output.trim.support, or write the whole surface");
    }
    for (std::uint32_t& p : points_of) p = vertex_of[p];
    vertex_of = std::move(points_of);
}

void ResultFiles::measure_files(RunOutcome& outcome) const {
    const mesh::TetMesh volume =
        io::read_volume(staged("volume.", preferred(output_.volume, {"dsc", "vtu"})));
    outcome.volume = measure(volume, &workers_, false);
    outcome.volume.interface = surface::extract_interface(volume);
    outcome.conforms = true;
    if (outcome.surfaces.empty()) {
        outcome.conforms = outcome.volume.interface.faces.empty();
        return;
    }
    const surface::TriangleMesh& whole = outcome.volume.interface;
    outcome.surface =
        outcome.trimmed
            ? measure_surface("surface.",
                              surface::trim(whole, gaps_, support_,
                                            {output_.trim->distance, output_.trim->support}),
                              outcome.conforms)
            : measure_surface("surface.", whole, outcome.conforms);
    for (const mesh::Label label : several_phases(volume)) {
        outcome.label_surfaces[label] = measure_surface(
            label_stem(label), surface::extract_phase(volume, label), outcome.conforms);
    }
    outcome.volume.interface_measure =
        outcome.trimmed ? measure(whole, &workers_) : outcome.surface;
}

/// `conforms` becomes false if one of the files differs from the expected surface.
SurfaceMeasure ResultFiles::measure_surface(const std::string& stem,
                                            const surface::TriangleMesh& expected,
                                            bool& conforms) const {
    const std::string measured = preferred(output_.surface, {"obj", "ply", "off", "stl"});
    surface::TriangleMesh mesh;
    for (const std::string& extension : output_.surface) {
        const bool floats = extension == "stl" || extension == "glb";
        if (floats && extension != measured) continue;
        surface::TriangleMesh read = io::read_surface(staged(stem, extension));
        conforms = conforms && (floats || identical(read, expected));
        if (extension == measured) mesh = std::move(read);
    }
    return measure(mesh, &workers_);
}

fs::path ResultFiles::staged(const std::string& stem, const std::string& extension) const {
    return folder_.staging() / (stem + extension);
}

}  // namespace dsc::run
