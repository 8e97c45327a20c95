// dsc info
#include <algorithm>
#include <filesystem>
#include <memory>
#include <thread>

#include <dsc/base/error.hpp>
#include <dsc/base/workers.hpp>
#include <dsc/cloud/given_normals.hpp>
#include <dsc/cloud/read.hpp>
#include <dsc/cloud/search.hpp>
#include <dsc/cloud/statistics.hpp>
#include <dsc/io/read.hpp>
#include <dsc/run/measure.hpp>
#include <dsc/text/words.hpp>

#include "commands.hpp"
#include "figures_output.hpp"
#include "files.hpp"
#include "run_figures.hpp"

namespace dsc::app {
namespace {

using nlohmann::ordered_json;

struct InfoArguments {
    std::string file;
    std::vector<std::string> columns;
    bool json = false;
    bool require_solid = false;
};

ordered_json surface_figures(const run::SurfaceMeasure& measure) {
    const surface::SurfaceReport& r = measure.report;
    return {{"vertices", r.vertices},
            {"faces", r.faces},
            {"edges", r.edges},
            {"unused_points", r.unused_points},
            {"duplicate_points", r.duplicate_points},
            {"shells", r.shells},
            {"components", r.components},
            {"cavities", r.cavities},
            {"genus", r.genus},
            {"euler", r.euler},
            {"boundary_edges", r.boundary_edges},
            {"nonmanifold_edges", r.nonmanifold_edges},
            {"nonmanifold_vertices", r.nonmanifold_vertices},
            {"misoriented_edges", r.misoriented_edges},
            {"duplicate_faces", r.duplicate_faces},
            {"degenerate_faces", r.degenerate_faces},
            {"self_intersections", measure.intersections.count},
            {"volume", r.volume},
            {"area", r.area},
            {"edge", {{"min", r.edge_min}, {"mean", r.edge_mean}, {"max", r.edge_max}}},
            {"box", box_figures(r.box)},
            {"solid", measure.solid()}};
}

/// Compares the surface that was written beside a volume, if there is one, with the volume's
/// interface.
ordered_json conformity(const std::filesystem::path& volume,
                        const surface::TriangleMesh& interface) {
    ordered_json all = ordered_json::object();
    for (const char* name : {"surface.obj", "surface.ply", "surface.off"}) {
        const std::filesystem::path file = volume.parent_path() / name;
        if (volume.stem() == "volume" && std::filesystem::exists(file)) {
            all[name] = run::identical(io::read_surface(file), interface);
        }
    }
    return all;
}

ordered_json volume_figures(const std::filesystem::path& file, const run::VolumeMeasure& m) {
    ordered_json labels = ordered_json::object();
    for (const auto& [label, count] : m.label_tets) {
        labels[std::to_string(label)] = {{"tets", count}, {"volume", m.label_volumes.at(label)}};
    }
    ordered_json figures = {{"points", m.points},
                            {"unused_points", m.unused_points},
                            {"tets", m.tets},
                            {"invalid_tets", m.invalid_tets},
                            {"inverted_tets", m.inverted_tets},
                            {"adjacency",
                             {{"valid", m.adjacency_valid()},
                              {"overused_faces", m.overused_faces},
                              {"folded_faces", m.folded_faces},
                              {"boundary_faces", m.boundary_faces}}},
                            {"quality", {{"min", m.min_quality}, {"mean", m.mean_quality}}},
                            {"volume", m.volume},
                            {"box", box_figures(m.box)},
                            {"fills_box", m.fills_box()},
                            {"labels", labels},
                            {"junction_vertices", m.junction_vertices},
                            {"interface", surface_figures(m.interface_measure)}};
    if (ordered_json same = conformity(file, m.interface); !same.empty())
        figures["interface_is_surface"] = same;
    figures["solid"] = m.solid();
    return figures;
}

/// Spacing, noise and outliers of the points; lengths in the units of the file.
ordered_json statistics_figures(const cloud::Statistics& s) {
    const double farthest = *std::max_element(s.outlier_score.begin(), s.outlier_score.end());
    return {{"point_width", s.width},
            {"label_width", s.median_label_width},
            {"width_spread", s.spread},
            {"regularity", s.regularity},
            {"noise", s.noise},
            {"noise_to_width", s.noise_ratio},
            {"area", s.area},
            {"duplicates", s.duplicates},
            {"largest_outlier_score", farthest}};
}

/// Every property of the file of points, and its use.
ordered_json properties(const std::vector<cloud::FoundProperty>& found) {
    ordered_json all = ordered_json::object();
    for (const cloud::FoundProperty& property : found)
        all[property.name] = property.use.empty() ? "not used" : property.use;
    return all;
}

/// Adds whether a reconstruction would use the normals and the viewpoint, and why.
void add_orientation(const cloud::Cloud& cloud, Workers& workers, ordered_json& figures) {
    if (cloud.sensor) {
        const Vec3& at = cloud.sensor->position;
        figures["viewpoint"] = {at.x(), at.y(), at.z()};
    }
    try {
        const cloud::GivenOrientation by_normals =
            cloud::orient_by_file_normals(cloud, {}, &workers);
        if (!by_normals.note.empty()) figures["normals"] = by_normals.note;
        if (by_normals.oriented) return;
        const cloud::GivenOrientation by_sensor = cloud::orient_by_sensor(cloud, {}, &workers);
        if (!by_sensor.note.empty()) figures["viewpoint_use"] = by_sensor.note;
    } catch (const GeometryError&) {
        return;  // a flat cloud has no inside, but its figures can be shown
    }
}

/// Properties of the points of a surface file that can also be read as a cloud; empty for other
/// files.
ordered_json surface_properties(const std::string& file) {
    const std::string extension = text::lower_case_extension(file);
    if (extension != ".ply" && extension != ".obj") return nullptr;
    try {
        cloud::ReadReport report;
        cloud::read_cloud(file, &report);
        return properties(report.properties);
    } catch (const Error&) {
        return nullptr;
    }
}

ordered_json cloud_figures(const Content& content, Workers& workers) {
    const std::vector<Vec3>& points = content.cloud->points;
    const cloud::NearestSearch search(points);
    double spacing = 0.0;
    std::size_t repeated = 0;
    for (const double distance : cloud::distances_to_nearest(search, &workers)) {
        spacing += distance;
        if (points.size() > 1 && distance == 0.0) ++repeated;
    }
    ordered_json figures = {
        {"points", points.size()},
        {"coloured", !content.cloud->colours.empty()},
        {"dropped_not_finite", content.dropped},
        {"points_with_a_twin", repeated},
        {"mean_spacing", spacing / static_cast<double>(points.size())},
        {"statistics", statistics_figures(cloud::measure_cloud(search, &workers))},
        {"box", box_figures(bounding_box(points))},
        {"solid", false}};
    if (!content.properties.empty()) figures["properties"] = properties(content.properties);
    add_orientation(*content.cloud, workers, figures);
    return figures;
}

int execute(const InfoArguments& arguments) {
    Workers workers(std::max(1U, std::thread::hardware_concurrency()));
    ordered_json figures = {{"file", arguments.file}};
    const bool is_run = std::filesystem::is_directory(arguments.file);
    const Content content = is_run ? Content{} : read_any(arguments.file, arguments.columns);
    if (is_run) {
        figures["kind"] = "run";
        figures.update(run_figures(arguments.file));
        figures["solid"] = figures.contains("result") &&
                           run::measure(read_any_surface(arguments.file), &workers).solid();
    } else if (content.surface) {
        figures["kind"] = "surface";
        figures.update(surface_figures(run::measure(*content.surface, &workers)));
        figures["coloured"] = !content.surface->colours.empty();
        if (const ordered_json found = surface_properties(arguments.file); !found.is_null())
            figures["properties"] = found;
    } else if (content.volume) {
        figures["kind"] = "volume";
        figures.update(volume_figures(arguments.file, run::measure(*content.volume, &workers)));
    } else {
        figures["kind"] = "cloud";
        figures.update(cloud_figures(content, workers));
    }
    print_figures(figures, arguments.json);
    if (arguments.require_solid && !figures["solid"].get<bool>()) {
        throw GeometryError("info.not_solid", arguments.file,
                            "is not a valid solid, which is closed, manifold, oriented outwards "
                            "and without self-intersections",
                            "the figures on stdout show what is wrong");
    }
    return 0;
}

}  // namespace

void add_info(CLI::App& app, Context& context) {
    CLI::App* command =
        app.add_subcommand("info", "Show figures of a surface, a volume, a cloud or a run folder");
    const auto arguments = std::make_shared<InfoArguments>();
    command->add_option("FILE", arguments->file, "Surface, volume, cloud or run folder")
        ->required();
    add_columns(*command, arguments->columns);
    command->add_flag("--json", arguments->json, "Print JSON instead of text");
    command->add_flag("--require-solid", arguments->require_solid,
                      "Exit with code 5 if the file does not bound a valid solid");
    set_action(*command, context, [arguments] { return execute(*arguments); });
}

}  // namespace dsc::app
