#include "filtering.hpp"

#include <dsc/base/error.hpp>

#include "checks.hpp"
#include "text.hpp"

namespace dsc::cloud {

Box3 checked_box(const Cloud& cloud, const std::string& filter) {
    if (cloud.points.empty())
        throw GeometryError("cloud.empty", named(cloud.source) + ": filter " + filter +
                                               ": the cloud has no points; read another file");
    return require_finite(cloud.points, cloud.source);
}

void require_option(bool valid, const Cloud& cloud, const std::string& filter, const std::string& cause) {
    if (!valid)
        throw GeometryError("cloud.option", named(cloud.source) + ": filter " + filter + ": " + cause);
}

Filtered take(const Cloud& cloud, const std::string& filter, const std::vector<bool>& keep) {
    Filtered result;
    const bool coloured = cloud.colours.size() == cloud.points.size();
    for (std::size_t i = 0; i < keep.size(); ++i) {
        if (!keep[i]) continue;
        result.cloud.points.push_back(cloud.points[i]);
        if (coloured) result.cloud.colours.push_back(cloud.colours[i]);
    }
    result.cloud.source = cloud.source;
    result.report = {filter, result.cloud.points.size(), cloud.points.size() - result.cloud.points.size()};
    if (result.cloud.points.empty())
        throw GeometryError("cloud.filtered_out", named(cloud.source) + ": filter " + filter +
                                                      " removes all " +
                                                      counted(cloud.points.size(), "point") +
                                                      "; relax its options or leave it out");
    return result;
}

Filtered take(const Cloud& cloud, const std::string& filter, const std::vector<std::size_t>& kept) {
    std::vector<bool> keep(cloud.points.size(), false);
    for (const std::size_t i : kept) keep[i] = true;
    return take(cloud, filter, keep);
}

}  // namespace dsc::cloud
