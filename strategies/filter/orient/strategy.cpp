#include "strategy.hpp"

#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <dsc/base/error.hpp>
#include <dsc/cloud/given_normals.hpp>

namespace dsc::strategies {

namespace {

double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

cloud::Filtered with_attributes(const cloud::Cloud& cloud, cloud::OrientedPoints found, bool estimated) {
    cloud::Filtered result;
    result.report.kept = cloud.points.size();
    result.report.figures = {{"estimated", estimated ? 1.0 : 0.0},
                             {"residual", found.orientation.residual},
                             {"noise", found.orientation.noise},
                             {"samples", static_cast<double>(found.orientation.samples.size())},
                             {"dropped", static_cast<double>(found.dropped)},
                             {"one_sided", found.orientation.one_sided() ? 1.0 : 0.0},
                             {"mean_confidence", mean(found.confidence)}};
    result.cloud.points = cloud.points;
    result.cloud.colours = cloud.colours;
    result.cloud.source = cloud.source;
    result.cloud.sensor = cloud.sensor;
    result.cloud.normals = std::move(found.normals);
    result.cloud.areas = std::move(found.areas);
    result.cloud.confidence = std::move(found.confidence);
    result.cloud.orientation = std::move(found.orientation);
    return result;
}

}  // namespace

void Orient::declare(config::ParamSchema<Params>& schema) {
    schema
        .choice("from", &Params::from,
                {{"auto", NormalSource::automatic}, {"file", NormalSource::file}, {"estimate", NormalSource::estimate}})
        .doc("Source of the normals: 'file', 'estimate' (from the points alone), or 'auto', which uses the file if its "
             "normals or its viewpoint are consistent.");
    schema.boolean("all_points", &Params::all_points)
        .doc("Use every point (or every cell of a large cloud) from the beginning of the estimate; slower, but better for "
             "parts thinner than a few points.");
    schema.integer("iterations", &Params::iterations)
        .range(1, 1000)
        .unit("1")
        .doc("Number of iterations of the coarse stage of the estimate.");
    schema.choice("one_sided", &Params::one_sided, {{"auto", OneSided::automatic}, {"never", OneSided::never}})
        .doc("Whether a cloud that was recorded from one side, such as a depth image or terrain, is closed. 'auto' recognises "
             "it by its single layer of points and closes it with a copy of the layer farther away; the surface of the copy "
             "can be removed later.");
}

Orient::Orient(const Params& params, const plugin::Setup&) : params_(params) {}

cloud::OrientOptions Orient::options() const {
    cloud::OrientOptions options;
    options.all_points = params_.all_points;
    options.coarse_iterations = params_.iterations;
    if (params_.one_sided == OneSided::never) options.backing = Vec3(Vec3::Zero());
    return options;
}

cloud::OrientedPoints Orient::estimated(const cloud::Cloud& cloud, const hooks::FilterContext& context) const {
    return cloud::orient_points(cloud.points, options(), context.workers, context.cancel, cloud.source);
}

cloud::OrientedPoints Orient::from_file(const cloud::Cloud& cloud, const hooks::FilterContext& context) const {
    return cloud::orient_by_normals(cloud.points, cloud.normals, context.workers, context.cancel, cloud.source);
}

cloud::Filtered Orient::apply(const cloud::Cloud& cloud, const hooks::FilterContext& context) {
    const bool has_normals = !cloud.normals.empty();
    if (params_.from == NormalSource::file) {
        if (!has_normals)
            throw ConfigError("filter.normals", (cloud.source.empty() ? "cloud" : cloud.source) +
                                                    ": filter orient: from: file needs normals, but the cloud has none; write " +
                                                    "from: estimate, or use a file with normals");
        return with_attributes(cloud, from_file(cloud, context), false);
    }
    if (params_.from == NormalSource::estimate) return with_attributes(cloud, estimated(cloud, context), true);
    return automatic(cloud, context);
}

cloud::Filtered Orient::automatic(const cloud::Cloud& cloud, const hooks::FilterContext& context) const {
    std::vector<std::pair<std::string, double>> figures;
    std::vector<std::string> notes;
    std::optional<cloud::OrientedPoints> oriented;
    for (const auto& by_file : {cloud::orient_by_file_normals, cloud::orient_by_sensor}) {
        if (oriented) break;
        cloud::GivenOrientation given = by_file(cloud, options(), context.workers, context.cancel);
        figures.insert(figures.end(), given.figures.begin(), given.figures.end());
        if (!given.note.empty()) notes.push_back(std::move(given.note));
        oriented = std::move(given.oriented);
    }
    const bool by_points = !oriented;
    cloud::Filtered result = with_attributes(cloud, by_points ? estimated(cloud, context) : std::move(*oriented), by_points);
    result.report.figures.insert(result.report.figures.end(), figures.begin(), figures.end());
    result.report.notes = std::move(notes);
    return result;
}

}  // namespace dsc::strategies
