// dsc render
#include <charconv>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <dsc/base/error.hpp>
#include <dsc/base/log.hpp>
#include <dsc/base/workers.hpp>
#include <dsc/io/picture.hpp>
#include <dsc/io/read.hpp>
#include <dsc/report/report.hpp>
#include <dsc/text/words.hpp>

#include "commands.hpp"
#include "files.hpp"
#include "standard_streams.hpp"

namespace dsc::app {
namespace {

struct RenderArguments {
    std::string input;
    std::string output;
    std::string view = "iso";
    std::string up = "auto";
    std::string size = "1024x768";
    std::string colour;
    bool edges = false;
};

void parse_size(const std::string& text, io::RenderOptions& options) {
    const char* const end = text.data() + text.size();
    const auto [x, error] = std::from_chars(text.data(), end, options.width);
    if (error == std::errc() && x != end && *x == 'x') {
        const auto [rest, second] = std::from_chars(x + 1, end, options.height);
        if (second == std::errc() && rest == end) return;
    }
    throw UsageError("usage.size", "--size",
                     fmt::format("'{}' is not of the form WIDTHxHEIGHT", text),
                     "write 1024x768, for example");
}

struct Coloured {
    surface::TriangleMesh mesh;
    std::vector<double> values;  ///< one per point
};

/// A surface and the values of the property that colours it.
Coloured read_coloured(const RenderArguments& arguments) {
    std::filesystem::path file = arguments.input;
    if (std::filesystem::is_directory(file)) file = file / "result" / "surface.ply";
    if (text::lower_case_extension(file) != ".ply") {
        throw UsageError("usage.colour", file.string(),
                         "--colour needs numbers per vertex, which only a .ply contains",
                         "give a .ply file");
    }
    std::vector<io::DataArray> arrays;
    surface::TriangleMesh mesh = io::read_surface(file, &arrays);
    std::string names;
    for (io::DataArray& array : arrays) {
        if (array.name == arguments.colour) return {std::move(mesh), std::move(array.values)};
        names += (names.empty() ? "" : ", ") + array.name;
    }
    throw UsageError(
        "usage.colour", file.string(),
        fmt::format("the vertices have no property '{}' of type float", arguments.colour),
        names.empty() ? std::string("leave --colour out; no vertex property is of type float")
                      : fmt::format("choose one of these: {}", names));
}

/// The axis that the picture and the report of a run use: z for the built-in shapes, y for models
/// from files. A file does not state its axis, so the log reports the axis that was chosen.
io::UpAxis up_axis(const RenderArguments& arguments) {
    if (arguments.up != "auto") return arguments.up == "z" ? io::UpAxis::z : io::UpAxis::y;
    const bool z =
        std::filesystem::is_directory(arguments.input) && report::stands_along_z(arguments.input);
    log(LogLevel::info, z ? "z points up, as in the report of the run; --up y lets y point up"
                          : "y points up; use --up z for a model whose height is along z");
    return z ? io::UpAxis::z : io::UpAxis::y;
}

/// Writes the picture, and prints the meaning of its colours.
int paint(const RenderArguments& arguments, io::RenderOptions& options) {
    if (arguments.colour.empty()) {
        io::write_png(arguments.output, io::render(read_any_surface(arguments.input), options));
        data_out() << arguments.output << "\n";
        return 0;
    }
    const Coloured surface = read_coloured(arguments);
    options.values = surface.values;
    io::write_png(arguments.output, io::render(surface.mesh, options));
    const io::ColourBounds bounds = io::colour_bounds(surface.values);
    data_out() << arguments.output << "\n"
               << arguments.colour << ": " << bounds.low << " and less is blue, " << bounds.high
               << " and more is red\n";
    return 0;
}

int execute(const RenderArguments& arguments) {
    if (text::lower_case_extension(arguments.output) != ".png") {
        throw UsageError("usage.format", arguments.output,
                         "is not a .png file, but pictures are written as .png",
                         "give a .png file with -o");
    }
    require_output(arguments.output, arguments.input);
    io::RenderOptions options;
    parse_size(arguments.size, options);
    options.view = io::view_from_name(arguments.view).value();
    options.up = up_axis(arguments);
    options.edges = arguments.edges;
    Workers workers(std::max(1U, std::thread::hardware_concurrency()));
    options.workers = &workers;
    return paint(arguments, options);
}

}  // namespace

void add_render(CLI::App& app, Context& context) {
    CLI::App* command =
        app.add_subcommand("render", "Draw a shaded picture of a surface, a volume or a run");
    const auto arguments = std::make_shared<RenderArguments>();
    command->add_option("FILE", arguments->input, "Surface, volume or run folder")->required();
    command->add_option("-o,--output", arguments->output, "Picture, .png")->required();
    command->add_option("--view", arguments->view, "Side from which the object is seen")
        ->check(CLI::IsMember({"front", "back", "left", "right", "top", "bottom", "iso"}))
        ->capture_default_str();
    command
        ->add_option("--up", arguments->up,
                     "Axis that points up: y, z, or auto, which prints the axis that it chose")
        ->check(CLI::IsMember({"auto", "y", "z"}))
        ->capture_default_str();
    command->add_option("--size", arguments->size, "Width and height in pixels")
        ->capture_default_str();
    command->add_flag("--edges", arguments->edges, "Draw the edges of the triangles");
    command->add_option(
        "--colour", arguments->colour,
        "Property of the vertices of a .ply that colours the surface, such as an attribute");
    set_action(*command, context, [arguments] { return execute(*arguments); });
}

}  // namespace dsc::app
