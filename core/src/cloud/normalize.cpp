// Converts a cloud to normalised units, and refuses clouds that bound no volume.
#include "dsc/cloud/normalize.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/core.h>

#include <dsc/base/error.hpp>
#include <dsc/geometry/predicates.hpp>
#include <dsc/text/numbers.hpp>
#include <dsc/text/words.hpp>

#include "checks.hpp"

namespace dsc::cloud {

namespace {

/// Index of the point with the largest `measure`; of equal ones the first.
template <class Measure>
std::size_t largest(std::span<const Vec3> points, const Measure& measure) {
    std::size_t best = 0;
    double value = -1.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double m = measure(points[i]);
        if (m > value) {
            value = m;
            best = i;
        }
    }
    return best;
}

std::string interval(const Box3& box) {
    std::string text;
    for (int k = 0; k < 3; ++k)
        text += (k ? " x [" : "[") + text::rounded(box.low[k]) + ", " + text::rounded(box.high[k]) +
                "]";
    return text;
}

constexpr std::string_view volume_remedy =
    "a surface needs at least 4 points that do not lie on one plane";

}  // namespace

std::string named(std::string_view name) { return name.empty() ? "cloud" : std::string(name); }

Box3 require_finite(std::span<const Vec3> points, std::string_view name) {
    Box3 box;
    for (std::size_t i = 0; i < points.size(); ++i) {
        // Beyond this, squares and volumes of coordinates are outside the range of doubles.
        if (!(points[i].array().abs() <= 1e100).all())
            throw GeometryError(
                "cloud.non_finite", named(name),
                fmt::format("point {} has a coordinate that is not finite or above 1e100", i),
                "remove it");
        box.extend(points[i]);
    }
    return box;
}

void require_searchable(std::span<const Vec3> points, const std::string& where) {
    if (points.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        throw GeometryError("cloud.large", where,
                            fmt::format("{} points; the limit is 2147483647", points.size()),
                            "thin the cloud first");
    for (std::size_t i = 0; i < points.size(); ++i)
        if (!points[i].allFinite())
            throw GeometryError("cloud.non_finite", where, fmt::format("point {} is not finite", i),
                                "remove it first");
}

void require_volume(std::span<const Vec3> points, std::string_view name) {
    const std::string who = named(name);
    if (points.size() < 4)
        throw GeometryError("cloud.few", who,
                            "the cloud has " + text::counted(points.size(), "point"),
                            std::string(volume_remedy));
    const Box3 box = require_finite(points, name);
    const auto refuse = [&](const char* code, const char* what) {
        const Vec3 size = box.size();
        throw GeometryError(
            code, who,
            fmt::format("all {} points {} (extent {} x {} x {})", points.size(), what,
                        text::rounded(size.x()), text::rounded(size.y()), text::rounded(size.z())),
            volume_remedy);
    };
    // Below 1e-100 the squares of differences underflow. Flat means: below the tolerance, or below
    // the rounding of coordinates far from the origin.
    const double diagonal = box.diagonal();
    if (diagonal < 1e-100) refuse("cloud.equal", "are equal");
    const double magnitude =
        std::max(box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff());
    const double flat =
        std::max(1e-9 * diagonal, 8.0 * std::numeric_limits<double>::epsilon() * magnitude);

    const Vec3& a = points[0];
    const Vec3& b = points[largest(points, [&](const Vec3& p) { return (p - a).squaredNorm(); })];
    const Vec3 along = (b - a).normalized();
    const auto off_line = [&](const Vec3& p) { return along.cross(p - a).norm(); };
    const Vec3& c = points[largest(points, off_line)];
    if ((b - a).norm() <= flat) refuse("cloud.equal", "are equal");
    if (off_line(c) <= flat) refuse("cloud.collinear", "lie on one line");
    const Vec3 normal = along.cross(c - a).normalized();
    const auto off_plane = [&](const Vec3& p) { return std::abs(normal.dot(p - a)); };
    const Vec3& d = points[largest(points, off_plane)];
    if (off_plane(d) <= flat || geometry::orient3d(a, b, c, d) == 0)
        refuse("cloud.coplanar", "lie on one plane");
}

namespace {

// Directions do not change, because normalisation does not rotate; areas grow with the square of
// its scale.
void set_attributes(const Cloud& cloud, Normalized& result) {
    const Transform& transform = result.transform;
    const double area_scale = transform.scale * transform.scale;
    result.colours = cloud.colours;
    result.normals = cloud.normals;
    result.confidence = cloud.confidence;
    result.areas = cloud.areas;
    for (Vec3& area : result.areas) area *= area_scale;
    result.orientation = cloud.orientation;
    result.orientation.noise *= transform.scale;
    result.orientation.backing *= transform.scale;
    for (SurfaceSample& sample : result.orientation.samples) {
        sample.position = transform.apply(sample.position);
        sample.area *= area_scale;
        sample.width *= transform.scale;
    }
}

}  // namespace

Normalized normalize(const Cloud& cloud, double scale_target) {
    const double most = simulation_box().high.x();
    if (!(scale_target > 0.0 && scale_target <= most))
        throw GeometryError(
            "cloud.scale", named(cloud.source),
            "the normalisation scale is " + text::rounded(scale_target),
            "choose one above 0 and at most " + text::rounded(most) + ", 0.9 by default");
    require_volume(cloud.points, cloud.source);
    const Box3 box = bounding_box(cloud.points);
    Normalized result;
    result.transform.centre = box.centre();
    result.transform.scale = scale_target / (0.5 * box.size().maxCoeff());
    result.points.reserve(cloud.points.size());
    for (const Vec3& p : cloud.points) result.points.push_back(result.transform.apply(p));
    set_attributes(cloud, result);
    return result;
}

Normalized keep_coordinates(const Cloud& cloud, const Box3& box) {
    require_volume(cloud.points, cloud.source);
    const auto inside = [&](const Vec3& p) { return box.contains(p); };
    const auto first = std::find_if_not(cloud.points.begin(), cloud.points.end(), inside);
    if (first != cloud.points.end()) {
        const auto outside =
            cloud.points.size() -
            static_cast<std::size_t>(std::count_if(first, cloud.points.end(), inside)) -
            static_cast<std::size_t>(first - cloud.points.begin());
        throw GeometryError(
            "cloud.outside_box", named(cloud.source),
            fmt::format("cloud outside the box: {} of {}, the first is point {}; the cloud spans "
                        "{}, the box is {}",
                        outside, text::counted(cloud.points.size(), "point"),
                        first - cloud.points.begin(), interval(bounding_box(cloud.points)),
                        interval(box)),
            "normalise the cloud (normalize: {scale: 0.9}) or scale it into the box");
    }
    Normalized result{cloud.points, Transform{}};
    set_attributes(cloud, result);
    return result;
}

}  // namespace dsc::cloud
