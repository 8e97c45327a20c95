#pragma once
// The winding number of area vectors, computed by clusters: 1 inside a solid, 0 outside, 1/2 on its
// surface.

#include <cstddef>
#include <memory>
#include <span>

#include <dsc/base/workers.hpp>
#include <dsc/cloud/cloud.hpp>
#include <dsc/geometry/vec.hpp>

namespace dsc::cloud {

/// The field of vectors mu_j at positions y_j, and the operators that orient a cloud with it. With
/// d = y_j - x and rho^2 = |d|^2 + (eps^2 + eps_j^2) / 2,
///   w(x)       = 1/(4 pi) sum_j mu_j . d / rho^3                         (A mu at the positions),
///   -grad w(x) = 1/(4 pi) sum_j [mu_j / rho^3 - 3 (mu_j . d) d / rho^5]  (G mu at the positions),
///   (A^T r)_j  = 1/(4 pi) sum_i r_i (y_j - x_i) / rho^3.
/// Sources that are far from a group of targets are replaced by one source at their weighted mean.
/// The sums are computed in float after the positions are moved and scaled, so coordinates may be
/// large. Errors of w of 0.01 are usual; they decrease with `opening`. The result has the same bits
/// for any number of threads and any width of the registers.
class WindingField {
public:
    /// `weights`: one positive number per position, such as an area; they define the centre of a
    /// cluster. A cluster is used as one source if its radius is below `opening` times the distance
    /// from all targets of a group; 0: never. Throws GeometryError "cloud.empty" without positions,
    /// "cloud.non_finite", "cloud.large" above 2^31 - 1 positions. [setup]
    WindingField(std::span<const Vec3> positions, std::span<const double> weights,
                 double opening = 0.5);
    ~WindingField();
    WindingField(WindingField&&) noexcept;
    WindingField& operator=(WindingField&&) noexcept;

    std::size_t size() const noexcept;

    /// Smoothing length eps_j of each position, in the units of the positions. 0 before the first
    /// call. [step]
    void set_smoothing(std::span<const double> lengths);
    /// Vectors mu_j, in squared units. Zero before the first call. [step]
    void set_vectors(std::span<const Vec3> vectors);

    /// w at the positions; the smoothing of the targets is that of the positions. [step]
    void winding(std::span<double> w, Workers* workers = nullptr);
    /// -grad w at the positions, with the same smoothing: along the normal that points out of the
    /// solid. Unit 1/length. [step]
    void gradient(std::span<Vec3> g, Workers* workers = nullptr);
    /// A^T r, in 1 / squared units, for one number per position. The vectors do not change. [step]
    void adjoint(std::span<const double> r, std::span<Vec3> g, Workers* workers = nullptr);

    /// w at other points. `smoothing`: one length per point, or empty for 0. Throws GeometryError
    /// "cloud.non_finite", "cloud.large". [step]
    void evaluate(std::span<const Vec3> points, std::span<const double> smoothing,
                  std::span<double> w, Workers* workers = nullptr) const;
    /// -grad w at other points. Throws as evaluate. [step]
    void evaluate_gradient(std::span<const Vec3> points, std::span<const double> smoothing,
                           std::span<Vec3> g, Workers* workers = nullptr) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// The field of a cloud's samples; `smoothing` is in units of their widths. Throws as the
/// constructor. [setup]
WindingField winding_field(std::span<const SurfaceSample> samples, double smoothing = 0.5);

}  // namespace dsc::cloud
