// Reads or samples the cloud, filters and normalises it.
#include "dsc/run/input.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include <dsc/base/error.hpp>
#include <dsc/base/random.hpp>
#include <dsc/cloud/shapes.hpp>
#include <dsc/geometry/order.hpp>
#include <dsc/hooks/cloud_filter.hpp>

namespace dsc::run {
namespace {

cloud::Cloud read_points(const CloudInput& input, std::uint64_t seed, InputFiles& files,
                         InputReport& report) {
    if (input.sample) {
        report.source = input.sample->shape;
        report.format = "sample";
        cloud::Cloud cloud = cloud::sample_shape(
            input.sample->shape, input.sample->n,
            RandomStream(RandomKey{seed, stream_id("input.cloud.sample"), 0, 0})(),
            input.sample->noise, input.sample->outliers);
        report.points = cloud.points.size();
        return cloud;
    }
    report.source = input.file.value();
    ReadCloud read = files.take_cloud(*input.file, input.columns);
    report.format = read.report.format;
    report.points = read.report.points;
    report.dropped = read.report.dropped_non_finite;
    return std::move(read.cloud);
}

using Filters = std::vector<std::unique_ptr<hooks::CloudFilter>>;

/// Created before anything is read, so that a filter that cannot be created costs no time.
Filters make_filters(const CloudInput& input, const plugin::Catalogue& catalogue) {
    Filters filters;
    for (std::size_t i = 0; i < input.filters.size(); ++i) {
        filters.push_back(catalogue.create<hooks::CloudFilter>(
            input.filters[i], fmt::format("input.cloud.filters.{}", i)));
    }
    return filters;
}

/// Positions in `before` that no point in `after` has, each once.
std::vector<Vec3> places_lost(std::vector<Vec3> before, std::vector<Vec3> after) {
    const auto earlier = geometry::lexicographically_before;
    std::sort(before.begin(), before.end(), earlier);
    before.erase(std::unique(before.begin(), before.end()), before.end());
    std::sort(after.begin(), after.end(), earlier);
    std::vector<Vec3> lost;
    std::set_difference(before.begin(), before.end(), after.begin(), after.end(),
                        std::back_inserter(lost), earlier);
    return lost;
}

/// Varies the cloud as the input asks.
cloud::Varied varied_cloud(cloud::Cloud given, const CloudInput& input, std::uint64_t seed,
                           Workers* workers, InputReport& report) {
    if (!input.vary) return {.cloud = std::move(given)};
    cloud::Varied varied = cloud::vary(std::move(given), *input.vary, seed, workers);
    report.variation = VariationReport{varied.left_out, varied.jitter, std::nullopt};
    if (input.vary->rotate) report.variation->rotation = varied.rotation;
    return varied;
}

}  // namespace

LoadedInput load_input(const Input& input, std::uint64_t seed, const plugin::Catalogue& catalogue,
                       InputFiles& files, Workers* workers, const CancelToken* cancel) {
    const Filters filters = make_filters(input.cloud, catalogue);
    InputReport report;
    cloud::Varied varied = varied_cloud(read_points(input.cloud, seed, files, report), input.cloud,
                                        seed, workers, report);
    cloud::Cloud& cloud = varied.cloud;
    const std::vector<Vec3> given = filters.empty() ? std::vector<Vec3>() : cloud.points;
    hooks::FilterContext context;
    context.seed = seed;
    const CancelToken told(cancel);
    context.cancel = &told;
    context.workers = workers;
    {
        const Timed timed(report.filter_time);
        for (const auto& filter : filters) {
            cloud::Filtered filtered = filter->apply(cloud, context);
            if (told.told())
                throw CancelledError("the run was stopped while it filtered its input");
            report.filters.push_back(std::move(filtered.report));
            cloud = std::move(filtered.cloud);
        }
    }
    report.used = cloud.points.size();
    cloud::Normalized normalized = input.normalize ? cloud::normalize(cloud, input.normalize->scale)
                                                   : cloud::keep_coordinates(cloud);
    std::vector<Vec3> removed;
    if (given.size() > cloud.points.size()) removed = places_lost(given, cloud.points);
    for (Vec3& p : removed) p = normalized.transform.apply(p);
    normalized.transform = cloud::before_variation(normalized.transform, varied);
    if (normalized.transform.rotation)
        cloud::rotate(cloud, varied.rotation.transpose(), varied.centre);
    report.diagonal = bounding_box(cloud.points).diagonal();
    return {std::move(cloud), cloud::TargetCloud(normalized), std::move(report),
            std::move(removed)};
}

}  // namespace dsc::run
