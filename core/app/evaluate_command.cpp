// dsc evaluate
#include <fstream>
#include <memory>
#include <thread>

#include <dsc/base/error.hpp>
#include <dsc/base/workers.hpp>
#include <dsc/cloud/read.hpp>
#include <dsc/cloud/statistics.hpp>
#include <dsc/run/coverage.hpp>
#include <dsc/surface/distance.hpp>
#include <dsc/surface/truth_figures.hpp>

#include "commands.hpp"
#include "figures_output.hpp"
#include "files.hpp"

namespace dsc::app {
namespace {

using nlohmann::ordered_json;

struct EvaluateArguments {
    std::string result;
    std::string truth;
    std::string cloud;
    std::vector<std::string> columns;
    std::size_t samples = 100000;
    bool json = false;
};

ordered_json against_truth(const surface::TriangleMesh& result, const EvaluateArguments& arguments,
                           Workers& workers) {
    surface::EvaluateOptions options;
    options.samples = arguments.samples;
    options.workers = &workers;
    const surface::Evaluation evaluation =
        surface::evaluate(result, read_any_surface(arguments.truth), options);
    ordered_json figures = {{"file", arguments.truth}, {"samples", arguments.samples}};
    for (const auto& [name, value] : surface::truth_figures(evaluation)) figures[name] = value;
    return figures;
}

ordered_json truth_formulas() {
    return {
        {"diagonal", "diagonal of the bounding box of the truth"},
        {"accuracy_percent",
         "100 * mean over samples r of the result of dist(r, truth) / diagonal"},
        {"completeness_percent",
         "100 * mean over samples t of the truth of dist(t, result) / diagonal"},
        {"chamfer_percent", "(accuracy_percent + completeness_percent) / 2"},
        {"hausdorff_percent", "100 * largest of all these distances / diagonal"},
        {"hausdorff99_percent",
         "100 * larger of the 99 % quantiles of the two directions / diagonal"},
        {"f_score_x_percent", "2 P R / (P + R); P = share of the result's samples, R = share of "
                              "the truth's samples, closer than x % of the diagonal"},
        {"normal_consistency",
         "mean over both directions of |n . n'|, for the face of a sample and the nearest face"},
        {"dist", "distance to the nearest point of the triangles; samples are uniform by area"}};
}

/// Scale from input units to normalised units, for a run folder; empty for anything else.
std::optional<double> scale_of(const std::filesystem::path& folder) {
    std::ifstream file(folder / "summary.json");
    const ordered_json summary = ordered_json::parse(file, nullptr, false);
    if (!summary.is_object()) return std::nullopt;
    const auto transform = summary.find("to_normalised");
    if (transform == summary.end() || !transform->is_object()) return std::nullopt;
    const auto scale = transform->find("scale");
    return scale != transform->end() && scale->is_number() ? std::optional(scale->get<double>())
                                                           : std::nullopt;
}

ordered_json distances(const surface::DistanceFigures& f, double factor) {
    return {{"mean", f.mean * factor}, {"min", f.min * factor}, {"max", f.max * factor}};
}

ordered_json against_cloud(const surface::TriangleMesh& result, const EvaluateArguments& arguments,
                           Workers& workers) {
    const cloud::Cloud cloud = cloud::read_cloud(arguments.cloud, nullptr, {arguments.columns});
    const surface::CloudDistances between =
        surface::cloud_distances(result, cloud.points, &workers);
    const surface::CloudEvaluation e = surface::evaluate_cloud(between);
    const double diagonal = bounding_box(cloud.points).diagonal();
    ordered_json figures = {{"file", arguments.cloud},
                            {"diagonal", diagonal},
                            {"vertex_to_cloud", distances(e.vertex_to_cloud, 1.0)},
                            {"cloud_to_surface", distances(e.cloud_to_surface, 1.0)}};
    if (diagonal > 0.0) {
        figures["vertex_to_cloud_percent"] = distances(e.vertex_to_cloud, 100.0 / diagonal);
        figures["cloud_to_surface_percent"] = distances(e.cloud_to_surface, 100.0 / diagonal);
    }
    if (const auto scale = scale_of(arguments.result)) {
        figures["vertex_to_cloud_normalised"] = distances(e.vertex_to_cloud, *scale);
    }
    const cloud::Statistics statistics = cloud::measure_cloud(cloud.points, &workers);
    const run::Coverage c =
        run::measure_coverage(result, cloud.points, between, statistics, {}, &workers);
    figures["coverage"] = {{"spacing", c.width},
                           {"noise", c.noise},
                           {"far_points", c.far_points},
                           {"far_points_percent", 100.0 * c.far_share()},
                           {"groups_of_far_points", c.groups.size()},
                           {"unsupported_percent", 100.0 * c.unsupported_share},
                           {"edge_to_spacing", c.resolution()}};
    return figures;
}

ordered_json cloud_formulas() {
    return {{"vertex_to_cloud", "over the result's vertices v: distance to the nearest cloud point "
                                "(table 6.2 of the thesis)"},
            {"cloud_to_surface",
             "over the cloud's points p: distance to the nearest point of the result's triangles"},
            {"coverage.far_points", "points farther from the surface than 3 noise scales plus 1 "
                                    "spacing; a spacing is the root of the area per point"},
            {"coverage.unsupported_percent",
             "100 * area of the surface without a point within 3 spacings / its area"},
            {"_percent", "100 * distance / diagonal of the cloud's bounding box"},
            {"_normalised", "distance * scale of the run's normalisation (the units of table 6.2); "
                            "for run folders only"}};
}

int execute(const EvaluateArguments& arguments) {
    if (arguments.truth.empty() && arguments.cloud.empty()) {
        throw UsageError("usage.evaluate", arguments.result, "there is nothing to compare it with",
                         "add --truth MESH or --cloud CLOUD");
    }
    Workers workers(std::max(1U, std::thread::hardware_concurrency()));
    const surface::TriangleMesh result = read_any_surface(arguments.result);
    ordered_json figures = {{"result", arguments.result}};
    ordered_json formulas = ordered_json::object();
    if (!arguments.truth.empty()) {
        figures["truth"] = against_truth(result, arguments, workers);
        formulas["truth"] = truth_formulas();
    }
    if (!arguments.cloud.empty()) {
        figures["cloud"] = against_cloud(result, arguments, workers);
        formulas["cloud"] = cloud_formulas();
    }
    figures["formulas"] = formulas;
    print_figures(figures, arguments.json);
    return 0;
}

}  // namespace

void add_evaluate(CLI::App& app, Context& context) {
    CLI::App* command = app.add_subcommand(
        "evaluate", "Measure how near a result is to the true surface or to its cloud");
    const auto arguments = std::make_shared<EvaluateArguments>();
    command->add_option("RESULT", arguments->result, "Surface, volume or run folder")->required();
    command->add_option("--truth", arguments->truth, "True surface");
    command->add_option("--cloud", arguments->cloud, "Point cloud");
    add_columns(*command, arguments->columns);
    command->add_option("--samples", arguments->samples, "Number of samples on each surface")
        ->check(CLI::Range(1000, 100000000))
        ->capture_default_str();
    command->add_flag("--json", arguments->json, "Print JSON instead of text");
    set_action(*command, context, [arguments] { return execute(*arguments); });
}

}  // namespace dsc::app
