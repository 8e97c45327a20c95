// dsc convert
#include <memory>

#include <fmt/core.h>

#include <dsc/base/error.hpp>
#include <dsc/base/log.hpp>
#include <dsc/cloud/read.hpp>
#include <dsc/cloud/write.hpp>
#include <dsc/io/formats.hpp>
#include <dsc/io/write.hpp>
#include <dsc/mesh/adopt.hpp>
#include <dsc/surface/measure.hpp>
#include <dsc/surface/surface_view.hpp>

#include "commands.hpp"
#include "files.hpp"
#include "standard_streams.hpp"

namespace dsc::app {
namespace {

struct ConvertArguments {
    std::string input;
    std::string output;
    std::vector<std::string> columns;
};

/// Returns the points of a surface or a volume as a cloud.
cloud::Cloud points_of(Content&& content) {
    if (content.cloud) return std::move(*content.cloud);
    cloud::Cloud cloud;
    if (content.surface) {
        cloud.points = std::move(content.surface->points);
        cloud.colours = std::move(content.surface->colours);
    } else {
        cloud.points = std::move(content.volume->points);
    }
    return cloud;
}

int execute(const ConvertArguments& arguments) {
    require_output(arguments.output, arguments.input);
    const io::Format* format = io::find_format(arguments.output);
    const bool is_cloud = cloud::is_cloud_file(arguments.output);
    if (format == nullptr && !is_cloud) {
        throw UsageError("usage.format", arguments.output,
                         "does not have the extension of a format that dsc writes",
                         fmt::format("use {} for a surface, {} for a volume, {} for a cloud",
                                     io::surface_extensions(), io::volume_extensions(),
                                     cloud::cloud_extensions()));
    }
    Content content = read_any(arguments.input, arguments.columns);
    if (format == nullptr) {
        cloud::write_cloud(arguments.output, points_of(std::move(content)));
    } else if (format->volume) {
        if (!content.volume) {
            throw UsageError("convert.no_volume", arguments.input,
                             "contains no tets, so no volume can be written",
                             "make a volume with dsc reconstruct");
        }
        if (const std::size_t turned = mesh::orient(*content.volume); turned > 0) {
            log(LogLevel::info, fmt::format("{} tets of {} had negative orientation; they are "
                                            "written with positive orientation",
                                            turned, arguments.input));
        }
        io::write_volume(arguments.output, *content.volume);
    } else if (content.cloud) {
        cloud::write_cloud(arguments.output, *content.cloud);
    } else {
        const surface::TriangleMesh surface = content.surface
                                                  ? std::move(*content.surface)
                                                  : surface::extract_interface(*content.volume);
        io::write_surface(arguments.output, surface, {}, surface::vertex_normals(surface));
    }
    data_out() << arguments.output << "\n";
    return 0;
}

}  // namespace

void add_convert(CLI::App& app, Context& context) {
    CLI::App* command = app.add_subcommand(
        "convert", "Convert a file to another format, or a volume to its surface or its points");
    const auto arguments = std::make_shared<ConvertArguments>();
    command->add_option("IN", arguments->input, "Surface, volume or cloud")->required();
    command->add_option("OUT", arguments->output, "Output; its extension selects the format")
        ->required();
    add_columns(*command, arguments->columns);
    set_action(*command, context, [arguments] { return execute(*arguments); });
}

}  // namespace dsc::app
