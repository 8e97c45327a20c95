#include "bending_rows.hpp"

#include <cmath>

namespace dsc::strategies::fit {
namespace {

constexpr std::size_t hinge_block = 1024;
constexpr double least_height = 0.15;   // edge lengths: lower corners would have unbounded weights
constexpr double least_opening = 1e-6;  // length of the normals' sum below which a hinge is folded
                                        // shut and has no normal

/// The position of a corner relative to an edge.
struct Apex {
    double foot;    // foot of the height on the edge: 0 at its beginning, 1 at its end
    double height;  // at least least_height edge lengths
    double part;    // true height over `height`
};

Apex apex_of(const Vec3& corner, const Vec3& begin, const Vec3& edge, double length) {
    const double foot = (corner - begin).dot(edge) / (length * length);
    const double height = (corner - begin - foot * edge).norm();
    const double bounded = std::max(height, least_height * length);
    return {foot, bounded, height / bounded};
}

void bending_row(const BendingTerm& term, const Hinge& hinge, Row& row, double& wanted) {
    row = {};
    wanted = 0.0;
    const surface::SurfaceView& view = term.view;
    const auto [a, b, c, d] = hinge.vertices;
    const auto [f, g] = hinge.faces;
    const Vec3 edge = view.positions[b] - view.positions[a];
    const double length = edge.norm();
    const double area = view.face_areas[f] + view.face_areas[g];
    const Vec3 both = view.face_normals[f] + view.face_normals[g];
    const double opening = both.norm();
    if (!(length > 0.0) || !(area > 0.0) || !(opening > least_opening)) return;

    const Vec3 normal = both / opening;
    const Apex one = apex_of(view.positions[c], view.positions[a], edge, length);
    const Apex two = apex_of(view.positions[d], view.positions[a], edge, length);
    const double bent =
        -(one.part + two.part) * half_sine(view.face_normals[f], view.face_normals[g], edge);
    const double target =
        -(one.part + two.part) * half_sine(term.normals[f], term.normals[g], edge);
    const double lambda = term.length * 0.5 * (term.widths[a] + term.widths[b]);
    const double ratio = bent / term.saturation;
    const double root = lambda * lambda * std::sqrt(3.0 / area) * length / (1.0 + ratio * ratio);
    row.direction = root * normal;
    row.factor = {-((1.0 - one.foot) / one.height + (1.0 - two.foot) / two.height),
                  -(one.foot / one.height + two.foot / two.height), 1.0 / one.height,
                  1.0 / two.height};
    row.vertex = hinge.vertices;
    wanted = root * (target - bent);
}

}  // namespace

void bending_rows(const BendingTerm& term, std::size_t first, RowSystem& system, Workers* workers) {
    for_blocks(workers, term.hinges.size(), hinge_block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            bending_row(term, term.hinges[i], system.rows[first + i], system.wanted[first + i]);
    });
}

}  // namespace dsc::strategies::fit
