#include <dsc/base/error.hpp>
#include <dsc/base/random.hpp>
#include <dsc/cloud/read.hpp>
#include <dsc/cloud/shapes.hpp>
#include <dsc/hooks/cloud_filter.hpp>
#include <dsc/run/input.hpp>

#include "stopwatch.hpp"

namespace dsc::run {
namespace {

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

using Filters = std::vector<std::unique_ptr<hooks::CloudFilter>>;

/// Made before anything is read: a filter that cannot be made costs no time.
Filters make_filters(const CloudInput& input, const plugin::Catalogue& catalogue) {
    Filters filters;
    for (std::size_t i = 0; i < input.filters.size(); ++i) {
        filters.push_back(catalogue.create<hooks::CloudFilter>(input.filters[i], "input.cloud.filters." + std::to_string(i)));
    }
    return filters;
}

}  // namespace

LoadedInput load_input(const Input& input, std::uint64_t seed, const plugin::Catalogue& catalogue, Workers* workers,
                       const CancelToken* cancel) {
    const Filters filters = make_filters(input.cloud, catalogue);
    InputReport report;
    cloud::Cloud cloud = read_points(input.cloud, seed, report);
    hooks::FilterContext context;
    context.seed = seed;
    context.cancel = cancel;
    context.workers = workers;
    {
        const CpuTimed timed(report.filter_seconds);
        const Timed wall_timed(report.filter_wall_seconds);
        for (const auto& filter : filters) {
            cloud::Filtered filtered = filter->apply(cloud, context);
            report.filters.push_back(std::move(filtered.report));
            cloud = std::move(filtered.cloud);
        }
    }
    report.used = cloud.points.size();
    report.diagonal = bounding_box(cloud.points).diagonal();
    const cloud::Normalized normalized =
        input.normalize ? cloud::normalize(cloud, input.normalize->scale) : cloud::keep_coordinates(cloud);
    return {std::move(cloud), cloud::TargetCloud(normalized), std::move(report)};
}

}  // namespace dsc::run
