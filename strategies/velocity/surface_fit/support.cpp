#include "support.hpp"

#include <cmath>

namespace dsc::strategies::fit {
namespace {

/// Sums over points.
struct PointSums {
    double weight = 0.0;
    double square = 0.0;
    double parts = 0.0;
};

}  // namespace

void measure_support(const surface::SurfaceView& view, std::span<const surface::FacePoint> places,
                     std::span<const PointFit> fits, Support& support) {
    const std::size_t count = view.vertex_count();
    std::vector<PointSums> sums(count);
    for (std::size_t i = 0; i < fits.size(); ++i) {
        if (!(fits[i].weight > 0.0)) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const double part = places[i].weights[k];
            PointSums& sum = sums[view.faces[places[i].face][k]];
            sum.weight += part * fits[i].weight;
            sum.square += part * fits[i].distance * fits[i].distance;
            sum.parts += part;
        }
    }
    support.share.assign(count, 0.0);
    support.residual.assign(count, 0.0);
    for (std::size_t v = 0; v < count; ++v) {
        const PointSums& sum = sums[v];
        double area = 0.0;
        for (const std::uint32_t f : view.faces_of(v)) area += view.face_areas[f] / 3.0;
        if (sum.parts > 0.0) support.residual[v] = std::sqrt(sum.square / sum.parts);
        if (sum.weight > 0.0) support.share[v] = sum.weight < area ? sum.weight / area : 1.0;
    }
}

}  // namespace dsc::strategies::fit
