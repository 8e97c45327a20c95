#include "support.hpp"

#include <algorithm>
#include <cmath>

namespace dsc::strategies::fit {
namespace {

struct FaceSums {
    double weight = 0.0;
    double square = 0.0;
    double points = 0.0;
};

}  // namespace

void measure_support(const surface::SurfaceView& view, std::span<const surface::FacePoint> places, std::span<const PointFit> fits,
                     Support& support) {
    std::vector<FaceSums> faces(view.face_count());
    for (std::size_t i = 0; i < fits.size(); ++i) {
        if (!(fits[i].weight > 0.0)) continue;
        FaceSums& face = faces[places[i].face];
        face.weight += fits[i].weight;
        face.square += fits[i].distance * fits[i].distance;
        face.points += 1.0;
    }
    const std::size_t count = view.vertex_count();
    support.share.assign(count, 0.0);
    support.residual.assign(count, 0.0);
    for (std::size_t v = 0; v < count; ++v) {
        FaceSums ring;
        double area = 0.0;
        for (const std::uint32_t f : view.faces_of(v)) {
            ring.weight += faces[f].weight;
            ring.square += faces[f].square;
            ring.points += faces[f].points;
            area += view.face_areas[f];
        }
        if (ring.points > 0.0) support.residual[v] = std::sqrt(ring.square / ring.points);
        if (ring.weight > 0.0) support.share[v] = ring.weight < area ? ring.weight / area : 1.0;
    }
}

}  // namespace dsc::strategies::fit
