// Transfers the colours of a cloud to a surface.
#include "colours.hpp"

namespace dsc::run {

void paint(surface::TriangleMesh& surface, const cloud::TargetCloud& target) {
    if (target.colours().empty()) return;
    surface.colours.clear();
    surface.colours.reserve(surface.points.size());
    for (const Vec3& p : surface.points) {
        const std::size_t nearest = target.search().nearest(target.transform().apply(p)).index;
        surface.colours.push_back(target.colours()[nearest]);
    }
}

}  // namespace dsc::run
