// PCL's Poisson reconstruction.
#include <pcl/features/normal_3d.h>
#include <pcl/pcl_config.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/poisson.h>

#include "peers.hpp"

namespace dsc::bench {
namespace {

constexpr unsigned neighbours = 16;

std::vector<Vec3> normals_of(const pcl::PointCloud<pcl::PointXYZ>::Ptr& cloud) {
    pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
    estimation.setInputCloud(cloud);
    estimation.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
    estimation.setKSearch(neighbours);
    pcl::PointCloud<pcl::Normal> found;
    estimation.compute(found);
    std::vector<Vec3> normals;
    for (const pcl::Normal& n : found) normals.push_back(n.getNormalVector3fMap().cast<double>());
    return normals;
}

surface::TriangleMesh poisson(const std::vector<Vec3>& points, const std::vector<Vec3>& normals) {
    const auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointNormal>>();
    for (std::size_t i = 0; i < points.size(); ++i) {
        pcl::PointNormal p;
        p.getVector3fMap() = points[i].cast<float>();
        p.getNormalVector3fMap() = normals[i].cast<float>();
        cloud->push_back(p);
    }
    pcl::Poisson<pcl::PointNormal> method;
    method.setInputCloud(cloud);
    method.setThreads(1);
    pcl::PointCloud<pcl::PointNormal> vertices;
    std::vector<pcl::Vertices> polygons;
    method.reconstruct(vertices, polygons);
    surface::TriangleMesh surface;
    for (const pcl::PointNormal& p : vertices)
        surface.points.push_back(p.getVector3fMap().cast<double>());
    for (const pcl::Vertices& polygon : polygons) {
        const auto corner = [&](std::size_t i) {
            return static_cast<std::uint32_t>(polygon.vertices.at(i));
        };
        surface.faces.push_back({corner(0), corner(1), corner(2)});
    }
    return surface;
}

}  // namespace

std::string pcl_version() { return PCL_VERSION_PRETTY; }

Reconstructed poisson_with_pcl(std::span<const Vec3> points) {
    const auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
    for (const Vec3& p : points) {
        const Eigen::Vector3f q = p.cast<float>();
        cloud->push_back({q.x(), q.y(), q.z()});
    }
    std::vector<Vec3> places(points.begin(), points.end());
    Reconstructed result;
    result.cost = cost_of([&] {
        std::vector<Vec3> normals = normals_of(cloud);
        orient_with_cgal(places, normals, neighbours);
        result.surface = poisson(places, normals);
    });
    return result;
}

}  // namespace dsc::bench
