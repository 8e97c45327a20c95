// The support of the vertices.
#include "dsc/surface/support.hpp"

namespace dsc::surface {

void vertex_support(const SurfaceView& view, std::span<const FacePoint> places,
                    std::span<const double> areas, std::vector<double>& support) {
    support.assign(view.vertex_count(), 0.0);
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (!(areas[i] > 0.0)) continue;
        for (std::size_t k = 0; k < 3; ++k)
            support[view.faces[places[i].face][k]] += places[i].weights[k] * areas[i];
    }
    for (std::size_t v = 0; v < support.size(); ++v) {
        double area = 0.0;
        for (const std::uint32_t f : view.faces_of(v)) area += view.face_areas[f] / 3.0;
        if (support[v] > 0.0) support[v] = support[v] < area ? support[v] / area : 1.0;
    }
}

}  // namespace dsc::surface
