#include "data_rows.hpp"

#include <algorithm>

namespace dsc::strategies::fit {
namespace {

constexpr std::size_t point_block = 1024;
constexpr double noise_reach = 6.0;     // least reach, in standard deviations
constexpr double dropped_beyond = 3.0;  // reaches beyond which a point has no effect
constexpr double widest = 2.0;       // limit of a point's width, in nearby widths: isolated points
                                     // represent no more area
constexpr double on_surface = 1e-9;  // widths within which the direction to a point is undefined

double mixed(std::span<const double> values, const std::array<std::uint32_t, 3>& face,
             const std::array<double, 3>& weights) {
    return weights[0] * values[face[0]] + weights[1] * values[face[1]] +
           weights[2] * values[face[2]];
}

PointFit data_row(const DataTerm& term, std::size_t i, Row& row, double& wanted) {
    row = {};
    wanted = 0.0;
    const surface::FacePoint& place = term.places[i];
    const auto& face = term.view.faces[place.face];
    const auto& b = place.weights;
    const Vec3 foot = b[0] * term.view.positions[face[0]] + b[1] * term.view.positions[face[1]] +
                      b[2] * term.view.positions[face[2]];
    const Vec3 way = term.points[i] - foot;
    const double distance = way.norm();
    const double width = mixed(term.widths, face, b);
    const double reach = std::max(noise_reach * term.noise, term.reach * width);
    if (!(distance <= dropped_beyond * reach)) return {0.0, distance};

    const Vec3& normal = term.view.face_normals[place.face];
    const Vec3 direction = distance > on_surface * width ? Vec3(way / distance) : normal;
    const double ratio = distance / reach;
    const double own =
        term.point_widths[i] > 0.0 ? std::min(term.point_widths[i], widest * width) : width;
    const double root = own / (1.0 + ratio * ratio);
    // Noise across a curved sheet moves the mean of its points outwards by sigma^2 times the mean
    // curvature.
    const double outwards = direction.dot(normal) < 0.0 ? -1.0 : 1.0;
    const double shift = term.curvature.empty()
                             ? 0.0
                             : outwards * term.noise * term.noise * mixed(term.curvature, face, b);
    row.direction = root * direction;
    row.factor = {b[0], b[1], b[2], 0.0};
    row.vertex = {face[0], face[1], face[2], face[0]};
    wanted = root * (distance - shift);
    return {root * root, distance};
}

}  // namespace

void data_rows(const DataTerm& term, std::size_t first, RowSystem& system,
               std::vector<PointFit>& fits, Workers* workers) {
    fits.resize(term.points.size());
    for_blocks(workers, term.points.size(), point_block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            fits[i] = data_row(term, i, system.rows[first + i], system.wanted[first + i]);
    });
}

}  // namespace dsc::strategies::fit
