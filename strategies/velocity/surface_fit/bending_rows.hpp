#pragma once
// Rows that keep the surface smooth except at creases.

#include <span>

#include "rows.hpp"
#include "surface_links.hpp"

namespace dsc::strategies::fit {

/// The data for the rows of the hinges.
struct BendingTerm {
    const surface::SurfaceView& view;
    std::span<const Hinge> hinges;
    std::span<const Vec3> normals;   ///< filtered, per face; they give the wanted angles of the
                                     ///< hinges
    std::span<const double> widths;  ///< per vertex: of the points near it
    double length = 0.0;             ///< lambda, in widths
    double saturation = 0.0;         ///< theta_0, radians: sharper hinges resist less
};

/// Writes one row per hinge from `first` on, which already exist: (unit vector across the edge to
/// corner 2 + the same to corner 3), along the mean normal of both faces, shall become -2 sin(angle
/// / 2), linearised in the displacements with the heights of the corners kept. The angle is that of
/// the filtered normals, so that curved parts do not shrink. [step]
void bending_rows(const BendingTerm& term, std::size_t first, RowSystem& system, Workers* workers);

}  // namespace dsc::strategies::fit
