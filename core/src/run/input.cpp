#include <dsc/base/error.hpp>
#include <dsc/base/random.hpp>
#include <dsc/cloud/read.hpp>
#include <dsc/cloud/shapes.hpp>
#include <dsc/run/input.hpp>
#include <map>

namespace dsc::run {
namespace {

/// A filter: what it is for, its schema, and what it does with resolved parameters.
struct Filter {
    std::string summary;
    std::shared_ptr<const config::Schema> schema;
    std::function<cloud::Filtered(const cloud::Cloud&, const config::ConfigNode&)> apply;
};

template <class Options, class Declare, class Apply>
Filter make_filter(std::string summary, Declare declare, Apply apply) {
    const auto schema = std::make_shared<config::ParamSchema<Options>>();
    declare(*schema);
    return {std::move(summary), schema->shared_schema(),
            [schema, apply](const cloud::Cloud& cloud, const config::ConfigNode& params) {
                return apply(cloud, schema->read(params));
            }};
}

const std::map<std::string, Filter>& filters() {
    using cloud::ClustersOptions;
    using cloud::DuplicatesOptions;
    using cloud::HiddenOptions;
    using cloud::RadiusOutliersOptions;
    using cloud::StatisticalOutliersOptions;
    using cloud::VoxelGridOptions;
    static const std::map<std::string, Filter> all = {
        {"duplicates", make_filter<DuplicatesOptions>(
                           "removes points that repeat an earlier one",
                           [](config::ParamSchema<DuplicatesOptions>& s) {
                               s.real("tolerance", &DuplicatesOptions::tolerance)
                                   .range(0, 1)
                                   .unit("diagonals")
                                   .doc(
                                       "A point this close to an earlier one is removed; 0 removes exact "
                                       "repetitions only.");
                           },
                           cloud::remove_duplicates)},
        {"clusters",
         make_filter<ClustersOptions>(
             "thins places where points crowd together",
             [](config::ParamSchema<ClustersOptions>& s) {
                 s.real("closer", &ClustersOptions::closer)
                     .range(0, 1)
                     .open_low()
                     .open_high()
                     .unit("point distances")
                     .doc(
                         "A point this close to an earlier one is removed; 1 is how far apart the 24 "
                         "nearest points would lie if they were spread evenly.");
             },
             cloud::remove_clusters)},
        {"hidden", make_filter<HiddenOptions>(
                       "removes points that no view from outside can see",
                       [](config::ParamSchema<HiddenOptions>& s) {
                           s.integer("views", &HiddenOptions::views)
                               .range(1, 10000)
                               .unit("directions")
                               .doc("From so many directions all round the cloud is looked at.");
                           s.real("radius", &HiddenOptions::radius)
                               .range(0, 10)
                               .open_low()
                               .unit("point spacings")
                               .doc("Radius of the disc that stands for the surface round a point.");
                           s.real("depth", &HiddenOptions::depth)
                               .range(0, 10)
                               .open_low()
                               .unit("point spacings")
                               .doc("A point this far behind a disc is hidden by it.");
                           s.real("share", &HiddenOptions::share)
                               .range(0, 1)
                               .open_high()
                               .unit("1")
                               .doc("A point that this part of the views or fewer see is removed.");
                       },
                       cloud::remove_hidden)},
        {"voxel_grid", make_filter<VoxelGridOptions>(
                           "keeps one point of each cell of a grid",
                           [](config::ParamSchema<VoxelGridOptions>& s) {
                               s.real("size", &VoxelGridOptions::size)
                                   .range(0, 1)
                                   .open_low()
                                   .unit("diagonals")
                                   .doc("Edge of a cell; one point of each occupied cell stays.");
                           },
                           cloud::voxel_grid)},
        {"statistical_outliers",
         make_filter<StatisticalOutliersOptions>(
             "removes points whose neighbours are unusually far away",
             [](config::ParamSchema<StatisticalOutliersOptions>& s) {
                 s.integer("neighbours", &StatisticalOutliersOptions::neighbours)
                     .range(1, 1000)
                     .unit("points")
                     .doc("Nearest points whose mean distance is taken.");
                 s.real("deviations", &StatisticalOutliersOptions::deviations)
                     .range(0, 1000)
                     .unit("1")
                     .doc("Standard deviations above the mean of all points that a point may lie.");
             },
             cloud::remove_statistical_outliers)},
        {"radius_outliers", make_filter<RadiusOutliersOptions>(
                                "removes points with few neighbours",
                                [](config::ParamSchema<RadiusOutliersOptions>& s) {
                                    s.real("radius", &RadiusOutliersOptions::radius)
                                        .range(0, 1)
                                        .open_low()
                                        .unit("diagonals")
                                        .doc("Radius in which neighbours are counted.");
                                    s.integer("neighbours", &RadiusOutliersOptions::neighbours)
                                        .range(1, 1000000)
                                        .unit("points")
                                        .doc("A point with fewer neighbours is removed.");
                                },
                                cloud::remove_radius_outliers)},
    };
    return all;
}

cloud::Cloud read_points(const CloudInput& input, std::uint64_t seed, InputReport& report) {
    if (input.sample) {
        report.source = input.sample->shape;
        report.format = "sample";
        cloud::Cloud cloud =
            cloud::sample_shape(input.sample->shape, input.sample->n,
                                RandomStream(RandomKey{seed, stream_id("input.cloud.sample"), 0, 0})(),
                                input.sample->noise, input.sample->outliers);
        report.points = cloud.points.size();
        return cloud;
    }
    report.source = input.file.value();
    cloud::ReadReport read;
    cloud::Cloud cloud = cloud::read_cloud(*input.file, &read, {input.columns});
    report.format = read.format;
    report.points = read.points;
    report.dropped = read.dropped_non_finite;
    return cloud;
}

}  // namespace

const config::Schema* filter_schema(const std::string& id) {
    const auto found = filters().find(id);
    return found == filters().end() ? nullptr : found->second.schema.get();
}

std::string filter_summary(const std::string& id) {
    const auto found = filters().find(id);
    return found == filters().end() ? "" : found->second.summary;
}

std::vector<std::string> filter_ids() {
    std::vector<std::string> ids;
    for (const auto& [id, filter] : filters()) ids.push_back(id);
    return ids;
}

cloud::Filtered apply_filter(const cloud::Cloud& cloud, const config::StrategyConfig& filter) {
    const auto found = filters().find(filter.type);
    if (found == filters().end()) {
        throw ConfigError("config.unknown_strategy",
                          "there is no cloud filter '" + filter.type + "'; accepted: " +
                              "clusters, duplicates, hidden, radius_outliers, statistical_outliers, voxel_grid");
    }
    return found->second.apply(cloud, filter.params);
}

LoadedInput load_input(const Input& input, std::uint64_t seed) {
    InputReport report;
    cloud::Cloud cloud = read_points(input.cloud, seed, report);
    for (const config::StrategyConfig& filter : input.cloud.filters) {
        cloud::Filtered filtered = apply_filter(cloud, filter);
        report.filters.push_back(filtered.report);
        cloud = std::move(filtered.cloud);
    }
    report.used = cloud.points.size();
    report.diagonal = bounding_box(cloud.points).diagonal();
    const cloud::Normalized normalized =
        input.normalize ? cloud::normalize(cloud, input.normalize->scale) : cloud::keep_coordinates(cloud);
    return {std::move(cloud), cloud::TargetCloud(normalized), std::move(report)};
}

}  // namespace dsc::run
