// The warnings about the agreement of a surface with its points.
#include <algorithm>

#include <fmt/core.h>

#include <dsc/run/coverage.hpp>

namespace dsc::run {
namespace {

constexpr double most_far = 0.01;          // of the points
constexpr double most_unsupported = 0.05;  // of the area
constexpr double least_group = 0.001;      // of the points
constexpr std::size_t least_group_points = 12;
constexpr double widest_group = 2.0;  // median spacings
constexpr std::size_t named_groups = 3;

std::string place(const Vec3& p) {
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x(), p.y(), p.z());
}

std::string far_text(const Coverage& coverage, double scale,
                     const cloud::Transform& to_normalised) {
    return fmt::format(
        "{} of {} points ({:.1f} %) are farther from the surface than noise and spacing explain; "
        "the farthest is {:.3g} away at {}, which is {:.0f} spacings. There the surface does not "
        "show the scanned shape. More vertices (--detail high) can follow finer shapes; remove "
        "points that do not belong to the object from the cloud.",
        coverage.far_points, coverage.points, 100.0 * coverage.far_share(),
        coverage.largest_distance / scale, place(to_normalised.inverse(coverage.farthest_point)),
        coverage.largest_distance / coverage.width);
}

std::string missing_text(const std::vector<PointGroup>& groups, double scale,
                         const cloud::Transform& to_normalised) {
    std::string text =
        fmt::format("{} of points {} no surface:",
                    groups.size() == 1 ? "1 group" : fmt::format("{} groups", groups.size()),
                    groups.size() == 1 ? "has" : "have");
    for (std::size_t i = 0; i < std::min(named_groups, groups.size()); ++i) {
        const PointGroup& group = groups[i];
        text += fmt::format(
            "{} {} points around {}, with a diameter of {:.3g} and up to {:.3g} from the surface",
            i == 0 ? "" : ";", group.points, place(to_normalised.inverse(group.centre)),
            group.diameter / scale, group.farthest / scale);
    }
    if (groups.size() > named_groups)
        text += fmt::format("; and {} smaller ones", groups.size() - named_groups);
    return text + ". If they are an object, reconstruct them from a separate cloud, or scan them "
                  "more densely; if they are background or noise, remove them from the cloud.";
}

std::string unsupported_text(const Coverage& coverage) {
    return fmt::format("{:.0f} % of the surface has no point within 3 spacings: there its shape is "
                       "a guess that closes the volume. --trim (in an experiment output: {{trim: "
                       "{{}}}}) writes the surface without these parts.",
                       100.0 * coverage.unsupported_share);
}

}  // namespace

hooks::Warnings warnings_of(const Coverage& coverage, const cloud::Transform& to_normalised) {
    const double scale = to_normalised.scale;
    hooks::Warnings out;
    if (coverage.far_share() > most_far)
        out.push_back({"coverage.points", far_text(coverage, scale, to_normalised)});
    const double least = std::max(static_cast<double>(least_group_points),
                                  least_group * static_cast<double>(coverage.points));
    std::vector<PointGroup> missing;
    for (const PointGroup& group : coverage.groups) {
        if (static_cast<double>(group.points) >= least &&
            group.spacing <= widest_group * coverage.width)
            missing.push_back(group);
    }
    if (!missing.empty())
        out.push_back({"coverage.missing", missing_text(missing, scale, to_normalised)});
    if (coverage.unsupported_share > most_unsupported)
        out.push_back({"coverage.unsupported", unsupported_text(coverage)});
    return out;
}

}  // namespace dsc::run
