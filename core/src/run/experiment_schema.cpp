// Declares format 1: every key of an experiment with its range and its meaning.
#include <algorithm>

#include <dsc/cloud/shapes.hpp>
#include <dsc/run/experiment.hpp>

namespace dsc::run {
namespace {

bool plain_name(const std::string& name) {
    if (name.empty() || name.size() > 100 || name.front() == '.' || name.front() == '-')
        return false;
    return std::all_of(name.begin(), name.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '.' || c == '_' || c == '-';
    });
}

/// The built-in shapes as values of a choice.
std::vector<std::pair<std::string, std::string>> shapes() {
    std::vector<std::pair<std::string, std::string>> all;
    for (const std::string_view name : cloud::shape_names()) all.emplace_back(name, name);
    return all;
}

void declare_sample(config::ParamSchema<SampleInput>& s) {
    s.choice("shape", &SampleInput::shape, shapes()).doc("Built-in shape.");
    s.integer("n", &SampleInput::n).range(1, 10000000, "points").doc("Number of points.");
    s.real("noise", &SampleInput::noise)
        .range(0, 1, "diagonals")
        .doc("Standard deviation of the noise of each coordinate, as a fraction of the shape's "
             "diagonal.");
    s.real("outliers", &SampleInput::outliers)
        .range(0, 1, "dimensionless")
        .open_high()
        .doc("Fraction of the points that get random places in the shape's box, enlarged 1.2 "
             "times.");
}

void declare_vary(config::ParamSchema<cloud::Variation>& s) {
    s.real("subsample", &cloud::Variation::subsample)
        .range(0, 1)
        .open_low()
        .unit("dimensionless")
        .doc("Fraction of the points that is kept.");
    s.real("jitter", &cloud::Variation::jitter)
        .range(0, 10)
        .unit("spacings")
        .doc("Standard deviation by which each coordinate is moved. A spacing is the square root "
             "of the area per point, its median over the points.");
    s.boolean("rotate", &cloud::Variation::rotate)
        .doc("Whether the cloud is rotated, uniformly over all rotations. Results are rotated "
             "back: they have the coordinates of the file.");
    s.check([](const cloud::Variation& p) { return !p.nothing(); },
            "'vary' changes nothing; give a 'subsample' below 1, a 'jitter' above 0 or 'rotate: "
            "true', or leave 'vary' out");
}

void declare_cloud(config::ParamSchema<CloudInput>& s) {
    s.file("file", &CloudInput::file)
        .doc("Point cloud: .obj, .ply, .pcd, .xyz, .txt, .asc, .pts or .csv. Positions are read, "
             "and colours, which the surface gets.");
    s.strings("columns", &CloudInput::columns)
        .or_integers()
        .size(0, 6)
        .doc("Columns of a text cloud: x, y, z, or x, y, z, red, green, blue, by their names in "
             "the header or by numbers from 1. Empty: the columns with these names, else the first "
             "three.");
    s.object("sample", &CloudInput::sample, declare_sample)
        .doc("A cloud sampled from a built-in shape.");
    s.object("vary", &CloudInput::vary, declare_vary)
        .doc("A variation of the points, drawn by the seed: runs with different seeds see "
             "different points of the same cloud. Left out: the points do not change.");
    s.strategies("filters", &CloudInput::filters, "filter")
        .doc("Filters of the cloud, in the order in which they are applied.");
    s.check([](const CloudInput& p) { return p.file.has_value() != p.sample.has_value(); },
            "exactly one of 'file' and 'sample' must be given");
    s.check(
        [](const CloudInput& p) {
            return p.columns.empty() || (p.file && p.columns.size() % 3 == 0);
        },
        "'columns' requires 'file' and must name 3 or 6 columns");
}

void declare_normalize(config::ParamSchema<NormalizeInput>& s) {
    s.real("scale", &NormalizeInput::scale)
        .range(0, 1.5, "length")
        .open_low()
        .doc("Longest half-extent of the cloud after it is centred in the box [-1.5, 1.5]^3.");
}

void declare_input(config::ParamSchema<Input>& s) {
    s.object("cloud", &Input::cloud, declare_cloud)
        .doc("The points to which the surface is fitted.");
    s.object("normalize", &Input::normalize, declare_normalize)
        .doc("Centre and scale the cloud into the box; results are written in the input's "
             "coordinates. Left out: the coordinates do not change and must lie inside the box.");
}

void declare_series(config::ParamSchema<Series>& s) {
    s.integer("steps", &Series::steps).range(1, 1000000, "steps").doc("Number of steps.");
    s.integer("every", &Series::every)
        .range(1, 1000000, "steps")
        .doc("Number of steps between refinements.");
    s.strategy("refine", &Series::refine, "refinement")
        .optional()
        .doc("Refinement of the interface.");
    s.choice("until", &Series::until, {{"finished", Until::finished}})
        .doc("finished: the series ends as soon as the velocity reports that its motion is "
             "finished.");
    s.check([](const Series& p) { return p.steps || !p.until; },
            "'until' is allowed only in an item with 'steps'");
    s.check([](const Series& p) { return p.steps || !p.refine.empty(); },
            "an item of the schedule needs 'steps' or 'refine', or both together with 'every'");
    s.check([](const Series& p) { return p.every.has_value() == (p.steps && !p.refine.empty()); },
            "'every' must be given if an item has both 'steps' and 'refine', and only then");
}

void declare_stop(config::ParamSchema<Stop>& s) {
    s.real("speed", &Stop::speed)
        .range(0, 1000, "current mean edges")
        .open_low()
        .doc("A series of steps ends when the largest speed per step stays below this.");
    s.integer("patience", &Stop::patience)
        .range(1, 1000000, "steps")
        .doc("Number of steps in a row with a lower speed.");
}

void declare_checkpoint(config::ParamSchema<CheckpointOutput>& s) {
    s.integer("every", &CheckpointOutput::every)
        .range(1, 1000000, "steps")
        .doc("Steps between checkpoints.");
    s.integer("keep", &CheckpointOutput::keep)
        .range(1, 1000, "dimensionless")
        .doc("Number of checkpoints that are kept.");
}

void declare_states(config::ParamSchema<SeriesOutput>& s) {
    s.integer("every", &SeriesOutput::every)
        .range(1, 1000000, "steps")
        .doc("Steps between states.");
}

void declare_trim(config::ParamSchema<TrimOutput>& s) {
    s.real("distance", &TrimOutput::distance)
        .greater(0, "spacings")
        .doc("Faces with a vertex farther than this from the nearest point are removed. A spacing "
             "is the square root of the area per point there.");
    s.real("support", &TrimOutput::support)
        .range(0, 1, "dimensionless")
        .doc("Faces with a vertex of less support are also removed, if the velocity publishes the "
             "support of vertices, as surface_fit does. 0: none.");
}

void declare_output(config::ParamSchema<Output>& s) {
    s.strings("surface", &Output::surface)
        .choices({"obj", "ply", "off", "stl", "glb"})
        .size(1, 5)
        .doc("Formats of the surface; at least one of them must not be glb. glb is binary glTF, "
             "for browsers and slides.");
    s.strings("volume", &Output::volume)
        .choices({"vtu", "dsc", "msh", "mesh"})
        .size(1, 4)
        .doc("Formats of the volume; vtu or dsc must be included. msh is the format of Gmsh, mesh "
             "the format of MEDIT.");
    s.check(
        [](const Output& p) {
            return std::any_of(p.surface.begin(), p.surface.end(),
                               [](const std::string& format) { return format != "glb"; });
        },
        "'surface' needs obj, ply, off or stl: the result is checked on the file as read back, and "
        "glb can only be written");
    s.check(
        [](const Output& p) {
            return std::any_of(p.volume.begin(), p.volume.end(), [](const std::string& format) {
                return format == "vtu" || format == "dsc";
            });
        },
        "'volume' needs vtu or dsc: the result is checked on the file as read back, and msh and "
        "mesh can only be written");
    s.object("checkpoint", &Output::checkpoint, declare_checkpoint)
        .doc("States of the run, in checkpoint/, from which dsc run --resume continues.");
    s.object("series", &Output::series, declare_states)
        .doc("States of the run for ParaView, in series/: surfaces as .vtp, volumes as .vtu, and a "
             ".pvd index for each.");
    s.object("trim", &Output::trim, declare_trim)
        .doc("Write the surface without the parts that no points support, as a surface with a "
             "border. The volume stays closed. Needs a cloud.");
    s.boolean("report", &Output::report)
        .doc("Write report.html, a page that shows the run: figures, plots, and a view of the "
             "surface that can be rotated and cut.");
    s.boolean("normals", &Output::normals)
        .doc("Write a unit normal with each vertex of a surface, in .obj and .ply. dsc reconstruct "
             "does this.");
    s.boolean("preview", &Output::preview)
        .doc("Draw preview.png, a picture of the surface; true if it is not given.");
    s.boolean("compress", &Output::compress)
        .doc("Compress .vtu and .vtp files: they become about three times smaller, and writing "
             "takes longer.");
}

}  // namespace

void Experiment::declare(config::ParamSchema<Experiment>& s) {
    s.integer("dsc", &Experiment::format)
        .range(1, 1, "dimensionless")
        .required()
        .doc("Version of the format: 1.");
    s.string("name", &Experiment::name)
        .doc("Names the run's folder: letters, digits, '.', '_', '-'.");
    s.integer("seed", &Experiment::seed)
        .at_least(0, "dimensionless")
        .doc("Seed of all random streams.");
    s.strings("plugins", &Experiment::plugins)
        .or_keyed("python")
        .doc("Plugin libraries, folders that contain them, or Python files ('python: FILE.py'), "
             "relative to the experiment's file.");
    s.object("input", &Experiment::input, declare_input)
        .doc("The point cloud. Left out: there is no cloud, and results are in normalised units.");
    s.strategy("initial_mesh", &Experiment::initial_mesh, "initial_mesh")
        .doc("The labelled box that the run starts from.");
    s.strategy("velocity", &Experiment::velocity, "velocity")
        .doc("The displacement of the interface in a step.");
    s.strategy("improvement", &Experiment::improvement, "improvement")
        .doc("The repairs that a step tries.");
    s.list("schedule", &Experiment::schedule, declare_series)
        .size(1)
        .required()
        .doc("The items of the run, in order: {steps: N}, {refine: {...}} or {steps: N, every: K, "
             "refine: {...}}.");
    s.object("stop", &Experiment::stop, declare_stop)
        .doc("Ends a series of steps early. Left out: never.");
    s.strategies("observers", &Experiment::observers, "observer")
        .doc("Adds figures to metrics.csv and summary.json.");
    s.object("output", &Experiment::output, declare_output).doc("Files of the result.");
    s.check([](const Experiment& p) { return plain_name(p.name); },
            "name must be 1 to 100 letters, digits, '.', '_' or '-', not starting with '.' or '-'");
}

std::shared_ptr<const config::Schema> experiment_schema() {
    static const std::shared_ptr<const config::Schema> schema = [] {
        Experiment defaults;
        defaults.name = "experiment";
        config::ParamSchema<Experiment> s(std::move(defaults));
        Experiment::declare(s);
        return s.shared_schema();
    }();
    return schema;
}

std::optional<Input> input_of(const config::ConfigNode& resolved,
                              const config::StrategyLookup& lookup) {
    const config::ConfigNode* node = resolved.find("input");
    if (node == nullptr || node->is_null()) return std::nullopt;
    config::ParamSchema<Input> schema;
    declare_input(schema);
    config::Diagnostics diagnostics;
    const config::ConfigNode checked =
        config::validate(*node, schema.schema(), lookup, diagnostics, "input");
    diagnostics.throw_if_errors();
    return schema.read(checked);
}

}  // namespace dsc::run
