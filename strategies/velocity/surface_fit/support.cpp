#include "support.hpp"

#include <cmath>

#include <dsc/surface/support.hpp>

namespace dsc::strategies::fit {
namespace {

/// Sums over points.
struct PointSums {
    double square = 0.0;
    double parts = 0.0;
};

}  // namespace

void measure_support(const surface::SurfaceView& view, std::span<const surface::FacePoint> places,
                     std::span<const PointFit> fits, Support& support) {
    const std::size_t count = view.vertex_count();
    std::vector<PointSums> sums(count);
    std::vector<double> weights(fits.size());
    for (std::size_t i = 0; i < fits.size(); ++i) {
        weights[i] = fits[i].weight;
        if (!(fits[i].weight > 0.0)) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const double part = places[i].weights[k];
            PointSums& sum = sums[view.faces[places[i].face][k]];
            sum.square += part * fits[i].distance * fits[i].distance;
            sum.parts += part;
        }
    }
    surface::vertex_support(view, places.first(fits.size()), weights, support.share);
    support.residual.assign(count, 0.0);
    for (std::size_t v = 0; v < count; ++v) {
        if (sums[v].parts > 0.0) support.residual[v] = std::sqrt(sums[v].square / sums[v].parts);
    }
}

}  // namespace dsc::strategies::fit
