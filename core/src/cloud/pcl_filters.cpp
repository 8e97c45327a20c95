// Calls PCL's filters.
#include "pcl_filters.hpp"

#include <algorithm>

#include <pcl/console/print.h>
#include <pcl/filters/radius_outlier_removal.h>
#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/point_types.h>

namespace dsc::cloud {

namespace {

using PclPoints = pcl::PointCloud<pcl::PointXYZ>;

PclPoints::Ptr to_float(const std::vector<Vec3>& points) {
    auto cloud = std::make_shared<PclPoints>();
    cloud->reserve(points.size());
    for (const Vec3& p : points) {
        const Eigen::Vector3f f = p.cast<float>();
        cloud->emplace_back(f.x(), f.y(), f.z());
    }
    return cloud;
}

std::vector<std::size_t> ascending(const pcl::Indices& indices) {
    std::vector<std::size_t> result(indices.begin(), indices.end());
    std::sort(result.begin(), result.end());
    return result;
}

}  // namespace

std::vector<std::size_t> statistical_inliers(const std::vector<Vec3>& points,
                                             std::size_t neighbours, double deviations) {
    pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
    pcl::StatisticalOutlierRemoval<pcl::PointXYZ> filter;
    filter.setInputCloud(to_float(points));
    filter.setMeanK(static_cast<int>(neighbours));
    filter.setStddevMulThresh(deviations);
    pcl::Indices kept;
    filter.filter(kept);
    return ascending(kept);
}

std::vector<std::size_t> radius_inliers(const std::vector<Vec3>& points, double radius,
                                        std::size_t neighbours) {
    pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
    pcl::RadiusOutlierRemoval<pcl::PointXYZ> filter;
    filter.setInputCloud(to_float(points));
    filter.setRadiusSearch(radius);
    filter.setMinNeighborsInRadius(static_cast<int>(neighbours));
    pcl::Indices kept;
    filter.filter(kept);
    return ascending(kept);
}

}  // namespace dsc::cloud
