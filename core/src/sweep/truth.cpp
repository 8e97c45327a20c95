// Evaluates the results of points and keeps the figures.
#include "truth.hpp"

#include <fstream>

#include <nlohmann/json.hpp>

#include <dsc/base/error.hpp>
#include <dsc/base/log.hpp>
#include <dsc/base/read_file.hpp>
#include <dsc/io/atomic_file.hpp>
#include <dsc/io/read.hpp>
#include <dsc/run/run_folder.hpp>
#include <dsc/run/sha256.hpp>
#include <dsc/surface/truth_figures.hpp>

namespace dsc::sweep {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char* file_name = "truth.json";
constexpr const char* file_format = "dsc-truth-1";

/// The content of truth.json; an empty object if there is none.
ordered_json read_truth(const fs::path& point) {
    std::ifstream stream(point / file_name);
    ordered_json json = stream ? ordered_json::parse(stream, nullptr, false) : ordered_json();
    if (!json.is_object() || json.value("format", "") != file_format) return ordered_json::object();
    return json;
}

void write_truth(const fs::path& point, const ordered_json& json) {
    io::write_file(point / file_name,
                   json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n");
}

std::string word(const ordered_json& json, const char* key) {
    const auto found = json.find(key);
    return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// The figures that are kept; empty if one of them is not a number.
std::vector<std::pair<std::string, double>> kept_figures(const ordered_json& json) {
    std::vector<std::pair<std::string, double>> figures;
    const auto found = json.find("figures");
    if (found == json.end() || !found->is_object()) return {};
    for (const auto& [name, value] : found->items()) {
        if (!value.is_number()) return {};
        figures.emplace_back(name, value.get<double>());
    }
    return figures;
}

}  // namespace

void name_truth(const fs::path& point, const config::ConfigNode& mesh) {
    if (mesh.is_null()) {
        std::error_code ignored;
        fs::remove(point / file_name, ignored);
        return;
    }
    if (word(read_truth(point), "mesh") == mesh.as_string()) return;
    write_truth(point, {{"format", file_format}, {"mesh", mesh.as_string()}});
}

Truths::Truth& Truths::truth(const std::string& file) {
    const auto [place, fresh] = truths_.try_emplace(file);
    if (fresh) place->second.sha256 = run::sha256(read_file(file));
    return place->second;
}

std::vector<std::pair<std::string, double>> Truths::figures(const fs::path& point) {
    ordered_json json = read_truth(point);
    const std::string mesh = word(json, "mesh");
    const fs::path result = run::result_surface(point / "run");
    if (mesh.empty() || result.empty()) return {};
    Truth& known = truth(mesh);
    const std::string hash = run::sha256(read_file(result));
    if (word(json, "mesh_sha256") == known.sha256 && word(json, "surface_sha256") == hash) {
        std::vector<std::pair<std::string, double>> kept = kept_figures(json);
        if (!kept.empty()) return kept;
    }
    if (!known.mesh) known.mesh = io::read_surface(mesh);
    surface::EvaluateOptions options;
    options.workers = workers_;
    const auto figures =
        surface::truth_figures(surface::evaluate(io::read_surface(result), *known.mesh, options));
    json = {{"format", file_format},       {"mesh", mesh},
            {"mesh_sha256", known.sha256}, {"surface_sha256", hash},
            {"samples", options.samples},  {"figures", ordered_json::object()}};
    for (const auto& [name, value] : figures) json["figures"][name] = value;
    try {
        write_truth(point, json);
    } catch (const IoError& error) {
        log(LogLevel::warning,
            std::string("the figures of the truth are not kept: ") + error.what());
    }
    return figures;
}

}  // namespace dsc::sweep
