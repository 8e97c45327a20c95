// The report page of a run.
#include "dsc/report/report.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include <dsc/base/error.hpp>
#include <dsc/config/yaml.hpp>

#include "files.hpp"
#include "html.hpp"
#include "page.hpp"
#include "sections.hpp"

namespace dsc::report {
namespace {

std::string file(std::string_view name) {
    for (const EmbeddedFile& known : report_files()) {
        if (known.path == name) return std::string(known.text);
    }
    throw Error(ExitCode::internal, "report.template", name,
                "the program does not contain this file for reports",
                "please report it with the command");
}

std::string subtitle(const RunRecord& record) {
    const auto word = [&](const char* path) {
        const nlohmann::ordered_json* value = find(record.provenance, path);
        return value != nullptr && value->is_string() ? value->get<std::string>()
                                                      : std::string("-");
    };
    return html::text("dsc " + word("versions.dsc") + ", seed " +
                      std::to_string(record.resolved.at("seed").as_integer()) + ", finished " +
                      word("finished"));
}

}  // namespace

std::string report_page(PageKind kind, const std::string& title, const std::string& subtitle,
                        const std::string& body) {
    const bool comparison = kind == PageKind::comparison;
    return html::fill(file("page.html"), {{"title", html::text(title)},
                                          {"subtitle", subtitle},
                                          {"licence", file("three_licence.txt")},
                                          {"style", file("style.css")},
                                          {"kind", comparison ? "comparison" : "run"},
                                          {"compare", comparison ? file("compare.js") : ""},
                                          {"body", body},
                                          {"three", file("three.min.js")},
                                          {"orbit", file("OrbitControls.js")},
                                          {"cut", file("cut.js")},
                                          {"viewer", file("viewer.js")}});
}

std::string guarded_report(const std::function<std::string()>& make) {
    try {
        return make();
    } catch (const nlohmann::json::exception& error) {
        throw IoError("report.damaged", "run folder", "",
                      fmt::format("a JSON file of the run does not contain what a run writes: {}",
                                  error.what()),
                      "run the experiment again");
    }
}

std::string report_html(const std::filesystem::path& run_folder, const plugin::Catalogue& catalogue,
                        Workers* workers, const run::LoadedInput* input) {
    return guarded_report([&] {
        const RunRecord record = read_record(run_folder);
        const Scene scene = make_scene(record, {}, {catalogue, input}, workers);
        const std::string body =
            headline_section(record) + warnings_section(record) + coverage_section(record) +
            notes_section(record) + viewer_section(record, scene) + thesis_section(record) +
            plots_section(record, scene) + time_section(record) + topology_section(record) +
            refinement_section(record) + cloud_section(record) + config_section(record) +
            provenance_section(record);
        return report_page(PageKind::run, record.name(), subtitle(record), body);
    });
}

bool stands_along_z(const std::filesystem::path& run_folder) {
    try {
        config::YamlOptions options;  // its values are final
        options.environment = [](const std::string&) { return std::optional<std::string>(); };
        const config::ConfigNode resolved =
            config::load_yaml((run_folder / "config.resolved.yaml").string(), options);
        const config::ConfigNode* input = resolved.find("input");
        const config::ConfigNode* cloud = input != nullptr ? input->find("cloud") : nullptr;
        const config::ConfigNode* sample = cloud != nullptr ? cloud->find("sample") : nullptr;
        return sample != nullptr && !sample->is_null();
    } catch (const Error&) {
        return false;
    }
}

std::vector<std::string> plugins_of_runs(std::span<const std::filesystem::path> run_folders) {
    std::vector<std::string> all;
    for (const std::filesystem::path& folder : run_folders) {
        try {
            const config::ConfigNode resolved =
                config::load_yaml((folder / "config.resolved.yaml").string());
            const config::ConfigNode* list = resolved.is_map() ? resolved.find("plugins") : nullptr;
            if (list == nullptr || !list->is_list()) continue;
            for (const config::ConfigNode& item : list->items()) {
                if (!item.is_string() ||
                    std::find(all.begin(), all.end(), item.as_string()) != all.end())
                    continue;
                all.push_back(item.as_string());
            }
        } catch (const Error&) {
            // report_html reports what is wrong with the folder
        }
    }
    return all;
}

}  // namespace dsc::report
