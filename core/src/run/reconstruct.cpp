// The experiment of `dsc reconstruct`: a file under configs/reconstruct, which is part of the library, and a cloud.
#include <dsc/run/reconstruct.hpp>

#include <dsc/base/error.hpp>
#include <dsc/config/yaml.hpp>

#include "run/reconstruct_files.hpp"

namespace dsc::run {
namespace {

using config::ConfigNode;

ConfigNode embedded(std::string_view name) {
    for (const EmbeddedFile& file : reconstruct_files()) {
        if (file.path == name) return config::parse_yaml(file.text, "configs/reconstruct/" + std::string(name));
    }
    throw Error(ExitCode::internal, "reconstruct.file", "configs/reconstruct/" + std::string(name) + " is not part of the program");
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
        case Detail::low:
            return "low";
        case Detail::medium:
            return "medium";
        case Detail::high:
            return "high";
    }
    return {};
}

ConfigNode reconstruction_of(const std::string& file, const ReconstructOptions& options) {
    const ConfigNode root = embedded(std::string(detail_name(options.detail)) + ".yaml");
    const ConfigNode& input = root.at("input");
    ConfigNode cloud = input.at("cloud").without("sample").with("file", ConfigNode(file));
    if (!options.columns.empty()) {
        cloud = cloud.with("columns", ConfigNode::list(std::vector<ConfigNode>(options.columns.begin(), options.columns.end())));
    }
    return root.with("input", input.with("cloud", cloud));
}

}  // namespace dsc::run
