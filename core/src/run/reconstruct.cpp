// The experiment of `dsc reconstruct`: a file of configs/reconstruct, which is compiled into the
// library, and a cloud.
#include "dsc/run/reconstruct.hpp"

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>

#include <dsc/base/error.hpp>
#include <dsc/config/yaml.hpp>

#include "run/reconstruct_files.hpp"

namespace dsc::run {
namespace {

using config::ConfigNode;

constexpr double no_noise = 1e-6;  // spacings; 0 would mean that it is measured

ConfigNode embedded(std::string_view name) {
    for (const EmbeddedFile& file : reconstruct_files()) {
        if (file.path == name)
            return config::parse_yaml(file.text, "configs/reconstruct/" + std::string(name));
    }
    throw Error(ExitCode::internal, "reconstruct.file", fmt::format("configs/reconstruct/{}", name),
                "it is not part of the program", "please report it with the command");
}

/// Sets a parameter of every refinement in the schedule.
ConfigNode with_refinement(const ConfigNode& root, const std::string& key,
                           const ConfigNode& value) {
    std::vector<ConfigNode> items;
    for (const ConfigNode& item : root.at("schedule").items())
        items.push_back(item.with("refine", item.at("refine").with(key, value)));
    return root.with("schedule", ConfigNode::list(std::move(items)));
}

ConfigNode with_size(ConfigNode root, const ReconstructOptions& options) {
    if (options.edge_length)
        root = with_refinement(root, "edge_length", ConfigNode(*options.edge_length));
    if (options.vertices) {
        const ConfigNode number(static_cast<std::int64_t>(*options.vertices));
        root = with_refinement(root, "vertices", number);
        root = root.with("initial_mesh", root.at("initial_mesh").with("vertices", number));
    }
    return root;
}

}  // namespace

std::optional<Detail> detail_from_name(std::string_view name) {
    if (name == "low") return Detail::low;
    if (name == "medium") return Detail::medium;
    if (name == "high") return Detail::high;
    return std::nullopt;
}

std::string_view detail_name(Detail detail) {
    switch (detail) {
        case Detail::low: return "low";
        case Detail::medium: return "medium";
        case Detail::high: return "high";
    }
    return {};
}

ConfigNode reconstruction_of(const std::string& file, const ReconstructOptions& options) {
    ConfigNode root =
        with_size(embedded(std::string(detail_name(options.detail)) + ".yaml"), options);
    if (options.noise)
        root = root.with(
            "velocity",
            root.at("velocity").with("noise", ConfigNode(std::max(*options.noise, no_noise))));
    if (options.trim) root = root.with("output", ConfigNode::map({{"trim", ConfigNode::map()}}));
    const ConfigNode& input = root.at("input");
    ConfigNode cloud = input.at("cloud").without("sample").with("file", ConfigNode(file));
    if (!options.columns.empty()) {
        cloud = cloud.with("columns", ConfigNode::list(std::vector<ConfigNode>(
                                          options.columns.begin(), options.columns.end())));
    }
    return root.with("input", input.with("cloud", cloud));
}

ConfigNode with_output(const ConfigNode& reconstruction, const ReconstructOutput& output) {
    const auto list = [](const std::vector<std::string>& formats) {
        return ConfigNode::list(std::vector<ConfigNode>(formats.begin(), formats.end()));
    };
    const ConfigNode* const given = reconstruction.find("output");
    return reconstruction.with("output", (given != nullptr ? *given : ConfigNode::map())
                                             .with("report", output.report)
                                             .with("normals", true)
                                             .with("surface", list(output.surface))
                                             .with("volume", list(output.volume)));
}

}  // namespace dsc::run
