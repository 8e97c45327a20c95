// Filter `orient`: gives every point a normal that points out of the solid, an area and a
// confidence.
//
// The estimate makes the winding number of the area vectors mu_j at the points y_j
//
//     w(x) = 1/(4 pi) sum_j mu_j . (y_j - x) / |y_j - x|^3
//
// equal to 1/2 at the points (winding number normal consistency [Lin2024]). Normals of the file, or
// its viewpoint, decide the sides if they are consistent. README.md describes all steps; the
// algorithms are dsc::cloud::orient_points, orient_by_normals, orient_by_file_normals and
// orient_by_sensor.
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <dsc/base/version.hpp>
#include <dsc/cloud/given_normals.hpp>
#include <dsc/cloud/orientation.hpp>
#include <dsc/hooks/cloud_filter.hpp>
#include <dsc/plugin/plugin.hpp>

namespace {

using dsc::Vec3;

double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

dsc::cloud::Filtered with_attributes(const dsc::cloud::Cloud& cloud,
                                     dsc::cloud::OrientedPoints found, bool estimated) {
    dsc::cloud::Filtered result;
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

class Orient final : public dsc::hooks::CloudFilter {
public:
    /// Source of the normals.
    enum class From { automatic, file, estimate };
    /// Whether a cloud that was recorded from one side is closed with a copy of it.
    enum class OneSided { automatic, never };

    /// The parameters that an experiment may set; the values here are the defaults.
    struct Params {
        From from = From::automatic;
        bool all_points = false;
        std::size_t iterations = dsc::cloud::OrientOptions{}.coarse_iterations;
        OneSided one_sided = OneSided::automatic;
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema
            .choice("from", &Params::from,
                    {{"auto", From::automatic}, {"file", From::file}, {"estimate", From::estimate}})
            .doc("Source of the normals: 'file', 'estimate' (from the points alone), or 'auto', "
                 "which uses the file if its normals or its viewpoint are consistent.");
        schema.boolean("all_points", &Params::all_points)
            .doc("Use every point (or every cell of a large cloud) from the beginning of the "
                 "estimate; slower, but better for parts thinner than a few points.");
        schema.integer("iterations", &Params::iterations)
            .range(1, 1000, "dimensionless")
            .doc("Number of iterations of the coarse stage of the estimate.");
        schema
            .choice("one_sided", &Params::one_sided,
                    {{"auto", OneSided::automatic}, {"never", OneSided::never}})
            .doc("Whether a cloud that was recorded from one side, such as a depth image or "
                 "terrain, is closed. 'auto' recognises it by its single layer of points and "
                 "closes it with a copy of the layer farther away; the surface of the copy can be "
                 "removed later.");
    }

    Orient(const Params& params, const dsc::plugin::Setup&) : params_(params) {}

    /// The cloud with normals, areas, confidence and orientation. Throws ConfigError
    /// "filter.normals" if the file's normals are requested and there are none.
    dsc::cloud::Filtered apply(const dsc::cloud::Cloud& cloud,
                               const dsc::hooks::FilterContext& context) override {
        const bool has_normals = !cloud.normals.empty();
        if (params_.from == From::file) {
            if (!has_normals)
                throw dsc::ConfigError(
                    "filter.normals", cloud.source.empty() ? "cloud" : cloud.source,
                    "filter orient has `from: file`, but the cloud contains no normals",
                    "write `from: estimate`, or use a file with normals");
            return with_attributes(cloud, from_file(cloud, context), false);
        }
        if (params_.from == From::estimate)
            return with_attributes(cloud, estimated(cloud, context), true);
        return automatic(cloud, context);
    }

private:
    dsc::cloud::OrientOptions options() const {
        dsc::cloud::OrientOptions options;
        options.all_points = params_.all_points;
        options.coarse_iterations = params_.iterations;
        if (params_.one_sided == OneSided::never) options.backing = Vec3(Vec3::Zero());
        return options;
    }

    dsc::cloud::Filtered automatic(const dsc::cloud::Cloud& cloud,
                                   const dsc::hooks::FilterContext& context) const {
        std::vector<std::pair<std::string, double>> figures;
        std::vector<std::string> notes;
        std::optional<dsc::cloud::OrientedPoints> oriented;
        for (const auto& by_file :
             {dsc::cloud::orient_by_file_normals, dsc::cloud::orient_by_sensor}) {
            if (oriented) break;
            dsc::cloud::GivenOrientation given =
                by_file(cloud, options(), context.workers, context.cancel);
            figures.insert(figures.end(), given.figures.begin(), given.figures.end());
            if (!given.note.empty()) notes.push_back(std::move(given.note));
            oriented = std::move(given.oriented);
        }
        const bool by_points = !oriented;
        dsc::cloud::Filtered result = with_attributes(
            cloud, by_points ? estimated(cloud, context) : std::move(*oriented), by_points);
        result.report.figures.insert(result.report.figures.end(), figures.begin(), figures.end());
        result.report.notes = std::move(notes);
        return result;
    }

    dsc::cloud::OrientedPoints estimated(const dsc::cloud::Cloud& cloud,
                                         const dsc::hooks::FilterContext& context) const {
        return dsc::cloud::orient_points(cloud.points, options(), context.workers, context.cancel,
                                         cloud.source);
    }

    dsc::cloud::OrientedPoints from_file(const dsc::cloud::Cloud& cloud,
                                         const dsc::hooks::FilterContext& context) const {
        return dsc::cloud::orient_by_normals(cloud.points, cloud.normals, context.workers,
                                             context.cancel, cloud.source);
    }

    Params params_;
};

}  // namespace

DSC_PLUGIN("orient", DSC_VERSION, "BSD-3-Clause", "Filter that determines inside and outside") {
    registrar.add<Orient>("orient", "gives points normals that point out of the solid, and areas");
}
