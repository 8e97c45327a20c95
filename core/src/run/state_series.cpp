// Writes intermediate states of a run.
#include "state_series.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include <fmt/core.h>

#include <dsc/base/error.hpp>
#include <dsc/base/parallel_table.hpp>
#include <dsc/run/simulation.hpp>

namespace dsc::run {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t written_block = 256;

std::string extension_of(const std::string& kind) { return kind == "surface" ? ".vtp" : ".vtu"; }

std::string file_name(const std::string& kind, std::uint64_t step) {
    return fmt::format("{}_{:06}{}", kind, step, extension_of(kind));
}

/// The step in a file's name; empty for any other file.
std::optional<std::uint64_t> step_of(const std::string& name, const std::string& kind) {
    const std::size_t begin = kind.size() + 1;
    std::uint64_t step = 0;
    if (name.size() <= begin) return std::nullopt;
    const char* const end = name.data() + name.size();
    const auto [rest, error] = std::from_chars(name.data() + begin, end, step);
    if (error != std::errc() || name != file_name(kind, step)) return std::nullopt;
    return step;
}

/// A second instance of the estimator that the velocity uses; both give the same answers.
std::unique_ptr<hooks::CurvatureEstimator> make_curvature(const Experiment& experiment,
                                                          const plugin::Catalogue& catalogue) {
    const config::Schema* schema = catalogue.find_schema("velocity", experiment.velocity.type);
    if (schema == nullptr) return nullptr;
    for (const config::Field& field : schema->fields()) {
        if (field.type != config::FieldType::strategy || field.kind != "curvature") continue;
        const config::ConfigNode* node = experiment.velocity.params.find(field.name);
        if (node == nullptr || node->is_null()) return nullptr;
        return catalogue.create<hooks::CurvatureEstimator>(config::strategy_from(*node),
                                                           "velocity." + field.name);
    }
    return nullptr;
}

/// 1 for an equilateral triangle, 0 for a flat one.
double triangle_quality(double area, const Vec3& a, const Vec3& b, const Vec3& c) {
    const double squares = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
    return squares > 0.0 ? 6.928203230275509 * area / squares : 0.0;  // 4 sqrt(3)
}

void to_input(std::vector<Vec3>& points, const cloud::Transform& to_normalised) {
    if (to_normalised.identity()) return;
    for (Vec3& p : points) p = to_normalised.inverse(p);
}

/// The attributes as arrays of the points with the given ids; NaN off the interface.
void add_attributes(const hooks::StepContext& context, const std::vector<mesh::VertexId>& ids,
                    io::VolumeData& data) {
    if (context.attributes.empty()) return;
    const std::vector<mesh::VertexId>& on_surface = context.surface.vertex_ids;
    std::vector<std::uint32_t> view_of(*std::max_element(ids.begin(), ids.end()) + std::size_t{1},
                                       mesh::none);
    for (std::uint32_t i = 0; i < on_surface.size(); ++i) view_of[on_surface[i]] = i;
    for (const hooks::Attribute& a : context.attributes) {
        std::vector<double> values(ids.size(), std::numeric_limits<double>::quiet_NaN());
        for (std::size_t i = 0; i < ids.size(); ++i) {
            if (view_of[ids[i]] != mesh::none) values[i] = a.values[view_of[ids[i]]];
        }
        data.points.push_back({a.name, std::move(values)});
    }
}

/// Adds the entry, or replaces an entry of the same step: a resumed run computes the same state
/// again.
void note(std::vector<io::SeriesEntry>& entries, io::SeriesEntry entry) {
    const auto before = [](const io::SeriesEntry& a, const io::SeriesEntry& b) {
        return a.step < b.step;
    };
    const auto at = std::lower_bound(entries.begin(), entries.end(), entry, before);
    if (at != entries.end() && at->step == entry.step) return;
    entries.insert(at, std::move(entry));
}

}  // namespace

std::set<std::uint64_t> report_steps(std::uint64_t planned) {
    std::set<std::uint64_t> steps;
    for (std::size_t i = 0; i + 1 < report_frames; ++i) {
        const double part = static_cast<double>(i) / static_cast<double>(report_frames - 1);
        steps.insert(static_cast<std::uint64_t>(
            std::llround(std::pow(part, 1.5) * static_cast<double>(planned))));
    }
    return steps;
}

std::vector<io::SeriesEntry> kept_states(const fs::path& run_folder, const std::string& kind) {
    std::vector<io::SeriesEntry> entries;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(run_folder / "series", error)) {
        const std::string name = entry.path().filename().string();
        if (const auto step = step_of(name, kind)) note(entries, {*step, name});
    }
    return entries;
}

StateSeries::StateSeries(const Experiment& experiment, const plugin::Catalogue& catalogue,
                         const fs::path& run_folder)
    : folder_(run_folder / "series"), compressed_(experiment.output.compress.value_or(false)) {
    if (experiment.output.series) {
        every_ = experiment.output.series->every;
    } else if (experiment.output.report.value_or(false)) {
        steps_ = report_steps(planned_steps(experiment));
    }
    if (!active()) return;
    curvature_ = make_curvature(experiment, catalogue);
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error) {
        throw IoError("run.folder", folder_.string(), "",
                      fmt::format("cannot be created: {}", error.message()),
                      "choose another folder with -o or make this one writable");
    }
    surfaces_ = kept_states(run_folder, "surface");
    volumes_ = kept_states(run_folder, "volume");
}

bool StateSeries::due(std::uint64_t step) const {
    return every_ != 0 ? step % every_ == 0 : steps_.count(step) != 0;
}

void StateSeries::add(const hooks::StepContext& context, const mesh::Complex& complex) {
    if (!due(context.step)) return;
    write_surface(context, complex);
    if (every_ != 0) write_volume(context, complex);
}

std::vector<double> StateSeries::curvatures(const hooks::StepContext& context) {
    std::vector<double> scalar(context.surface.vertex_count());
    std::vector<Vec3> vectors(scalar.size());
    curvature_->prepare(context);
    for_blocks(context.workers, scalar.size(), written_block,
               [&](std::size_t begin, std::size_t end) {
                   curvature_->evaluate({begin, end}, std::span(scalar).subspan(begin, end - begin),
                                        std::span(vectors).subspan(begin, end - begin));
               });
    return scalar;
}

void StateSeries::write_surface(const hooks::StepContext& context, const mesh::Complex& complex) {
    const surface::SurfaceView& view = context.surface;
    io::SurfaceData data;
    data.compressed = compressed_;
    data.cells.push_back(
        {"label", parallel_table(context.workers, view.face_count(), [&](std::size_t f) {
             return static_cast<double>(complex.label(view.face_tets[f]));
         })});
    data.cells.push_back(
        {"quality", parallel_table(context.workers, view.face_count(), [&](std::size_t f) {
             const auto& [a, b, c] = view.faces[f];
             return triangle_quality(view.face_areas[f], view.positions[a], view.positions[b],
                                     view.positions[c]);
         })});
    const double scale = context.to_normalised.scale;
    if (context.cloud != nullptr) {
        data.points.push_back(
            {"distance", parallel_table(context.workers, view.vertex_count(), [&](std::size_t i) {
                 return context.nearest[i].distance / scale;
             })});
    }
    if (curvature_ != nullptr) data.points.push_back({"curvature", curvatures(context)});
    for (const hooks::Attribute& a : context.attributes) data.points.push_back({a.name, a.values});
    data.vectors.push_back({"normal", view.normals});
    if (context.to_normalised.rotation) {
        for (Vec3& normal : data.vectors.back().values)
            normal = context.to_normalised.direction_to_input(normal);
    }
    surface::TriangleMesh mesh{view.positions, view.faces};
    to_input(mesh.points, context.to_normalised);
    if (context.cloud != nullptr && !context.cloud->colours().empty()) {
        for (const auto& nearest : context.nearest)
            mesh.colours.push_back(context.cloud->colours()[nearest.index]);
    }
    const std::string name = file_name("surface", context.step);
    io::write_vtp(folder_ / name, mesh, data);
    note(surfaces_, {context.step, name});
    io::write_pvd(folder_ / "surface.pvd", surfaces_);
}

void StateSeries::write_volume(const hooks::StepContext& context, const mesh::Complex& complex) {
    std::vector<mesh::VertexId> ids;
    mesh::TetMesh mesh = complex.to_mesh(&ids);
    io::VolumeData data;
    data.compressed = compressed_;
    const double scale = context.to_normalised.scale;
    if (context.cloud != nullptr) {
        data.points.push_back(
            {"distance", parallel_table(context.workers, mesh.points.size(), [&](std::size_t i) {
                 return context.cloud->search().nearest(mesh.points[i]).distance / scale;
             })});
    }
    add_attributes(context, ids, data);
    to_input(mesh.points, context.to_normalised);
    const std::string name = file_name("volume", context.step);
    io::write_volume(folder_ / name, mesh, data);
    note(volumes_, {context.step, name});
    io::write_pvd(folder_ / "volume.pvd", volumes_);
}

}  // namespace dsc::run
