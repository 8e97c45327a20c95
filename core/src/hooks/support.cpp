// Measures the support of the vertices from the cloud.
#include "dsc/hooks/support.hpp"

#include <dsc/surface/support.hpp>

namespace dsc::hooks {

void measure_support(const surface::SurfaceView& view, const cloud::TargetCloud& cloud,
                     std::span<const surface::FacePoint> faces_of_points,
                     std::vector<double>& support, Workers* workers) {
    const std::vector<double>& widths = cloud.statistics(workers).point_width;
    std::vector<double> areas(faces_of_points.size());
    for (std::size_t i = 0; i < areas.size(); ++i) {
        const bool near = faces_of_points[i].distance <= support_reach * widths[i];
        areas[i] = near ? widths[i] * widths[i] : 0.0;
    }
    surface::vertex_support(view, faces_of_points, areas, support);
}

}  // namespace dsc::hooks
