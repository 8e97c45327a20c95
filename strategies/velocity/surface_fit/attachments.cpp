#include "attachments.hpp"

#include <cmath>
#include <limits>

namespace dsc::strategies::fit {
namespace {

constexpr std::size_t attachment_block = 1024;  // vertices
constexpr double precedence = 10.0;  // weight of an attachment over that of a nearby point: it
                                     // dominates bending

}  // namespace

void attach_vertices(const surface::SurfaceView& view, std::span<const Vec3> points,
                     std::span<const surface::FacePoint> places, std::span<const double> lengths,
                     double reach, std::vector<std::uint32_t>& attached) {
    attached.assign(view.vertex_count(), no_point);
    std::vector<double> nearest(view.vertex_count(), std::numeric_limits<double>::infinity());
    for (std::uint32_t i = 0; i < places.size(); ++i) {
        std::uint32_t corner = 0;
        double least = std::numeric_limits<double>::infinity();
        for (const std::uint32_t v : view.faces[places[i].face]) {
            const double distance = (view.positions[v] - points[i]).norm();
            if (distance > least || (distance == least && v > corner)) continue;
            least = distance;
            corner = v;
        }
        if (!(least < reach * lengths[corner]) || !(least < nearest[corner])) continue;
        nearest[corner] = least;
        attached[corner] = i;
    }
}

void attachment_rows(const surface::SurfaceView& view, std::span<const Vec3> points,
                     std::span<const std::uint32_t> attached, std::span<const double> widths,
                     std::size_t first, RowSystem& system, Workers* workers) {
    for_blocks(workers, attached.size(), attachment_block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
            const auto corner = static_cast<std::uint32_t>(v);
            for (std::size_t k = 0; k < 3; ++k) {
                Row& row = system.rows[first + 3 * v + k];
                double& wanted = system.wanted[first + 3 * v + k];
                row = {};
                wanted = 0.0;
                if (attached[v] == no_point) continue;
                const auto axis = static_cast<Eigen::Index>(k);
                const double root = std::sqrt(precedence) * widths[v];
                row.direction[axis] = root;
                row.factor[0] = 1.0;
                row.vertex.fill(corner);
                wanted = root * (points[attached[v]] - view.positions[v])[axis];
            }
        }
    });
}

}  // namespace dsc::strategies::fit
