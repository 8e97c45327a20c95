// Checks and selections that all filters share.
#include "filtering.hpp"

#include <cstddef>
#include <stdexcept>
#include <string>

#include <fmt/core.h>

#include <dsc/base/error.hpp>
#include <dsc/text/words.hpp>

#include "checks.hpp"

namespace dsc::cloud {

Box3 checked_box(const Cloud& cloud, const std::string& filter) {
    if (cloud.points.empty())
        throw GeometryError("cloud.empty", named(cloud.source),
                            "filter " + filter + ": the cloud has no points", "read another file");
    return require_finite(cloud.points, cloud.source);
}

void require_option(bool valid, const Cloud& cloud, const std::string& filter,
                    const std::string& cause, std::string_view remedy) {
    if (!valid)
        throw GeometryError("cloud.option", named(cloud.source), "filter " + filter + ": " + cause,
                            remedy);
}

namespace {

template <class T>
std::vector<T> picked(const std::vector<T>& values, std::size_t points,
                      std::span<const std::size_t> indices) {
    std::vector<T> result;
    if (values.size() != points) return result;
    result.reserve(indices.size());
    for (const std::size_t i : indices) result.push_back(values[i]);
    return result;
}

bool identity(std::span<const std::size_t> indices, std::size_t points) {
    for (std::size_t n = 0; n < indices.size(); ++n)
        if (indices[n] != n) return false;
    return indices.size() == points;
}

}  // namespace

Cloud pick(const Cloud& cloud, std::span<const std::size_t> indices) {
    const std::size_t points = cloud.points.size();
    for (const std::size_t i : indices)
        if (i >= points)
            throw std::out_of_range(
                fmt::format("point {} of a cloud of {}", i, text::counted(points, "point")));
    Cloud result;
    result.points = picked(cloud.points, points, indices);
    result.colours = picked(cloud.colours, points, indices);
    result.normals = picked(cloud.normals, points, indices);
    result.areas = picked(cloud.areas, points, indices);
    result.confidence = picked(cloud.confidence, points, indices);
    if (identity(indices, points)) result.orientation = cloud.orientation;
    result.source = cloud.source;
    result.sensor = cloud.sensor;
    return result;
}

Filtered take(const Cloud& cloud, const std::string& filter, const std::vector<std::size_t>& kept) {
    if (kept.empty())
        throw GeometryError(
            "cloud.filtered_out", named(cloud.source),
            "filter " + filter + " removes all " + text::counted(cloud.points.size(), "point"),
            "relax its options or leave it out");
    Filtered result;
    result.cloud = pick(cloud, kept);
    result.report = {filter, kept.size(), cloud.points.size() - kept.size()};
    return result;
}

Filtered take(const Cloud& cloud, const std::string& filter, const std::vector<bool>& keep) {
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < keep.size(); ++i)
        if (keep[i]) kept.push_back(i);
    return take(cloud, filter, kept);
}

}  // namespace dsc::cloud
