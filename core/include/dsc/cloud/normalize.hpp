#pragma once
// Converts a cloud to normalised units, and results back.

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <dsc/cloud/cloud.hpp>
#include <dsc/geometry/vec.hpp>

namespace dsc::cloud {

/// Uniform: normalised = rotation * (input - centre) * scale. The default is the identity.
struct Transform {
    Vec3 centre = Vec3::Zero();
    double scale = 1.0;                         ///< above 0
    std::optional<Eigen::Matrix3d> rotation{};  ///< only if the cloud was rotated (cloud/vary.hpp)

    Vec3 apply(const Vec3& input) const {
        const Vec3 scaled = (input - centre) * scale;
        return rotation ? Vec3(*rotation * scaled) : scaled;
    }
    Vec3 inverse(const Vec3& normalised) const {
        return direction_to_input(normalised) / scale + centre;
    }
    /// Turns a direction, for example a normal, back to the input's axes.
    Vec3 direction_to_input(const Vec3& normalised) const {
        return rotation ? Vec3(rotation->transpose() * normalised) : normalised;
    }
    bool identity() const { return !rotation && scale == 1.0 && centre == Vec3::Zero(); }
};

/// The box of the thesis: 3 units wide, centred at the origin.
inline Box3 simulation_box() { return {Vec3::Constant(-1.5), Vec3::Constant(1.5)}; }

struct Normalized {
    std::vector<Vec3> points;  ///< in normalised units, in the order of the cloud
    Transform transform;
    std::vector<Colour> colours{};     ///< empty, or one per point
    std::vector<Vec3> normals{};       ///< empty, or one per point; unit vectors
    std::vector<Vec3> areas{};         ///< empty, or one per point, in squared normalised units
    std::vector<double> confidence{};  ///< empty, or one per point
    Orientation orientation{};         ///< in normalised units
};

/// Refuses points that bound no volume: fewer than 4, all equal, all on a line, all on a plane.
/// Exact predicates decide this. Clouds thinner than 1e-9 of their diagonal, or than the rounding
/// of their coordinates, also count as flat. The message begins with `name`. Throws GeometryError
/// "cloud.few", "cloud.equal", "cloud.collinear", "cloud.coplanar", "cloud.non_finite". [setup]
void require_volume(std::span<const Vec3> points, std::string_view name);

/// The normalisation of the thesis: moves the centre of the cloud's box to the origin and scales
/// its largest half-extent to `scale_target`. Throws as require_volume, and GeometryError
/// "cloud.scale" unless it is above 0 and at most 1.5. [setup]
Normalized normalize(const Cloud& cloud, double scale_target = 0.9);

/// Keeps the coordinates, with the identity as transform. Throws as require_volume, and
/// GeometryError "cloud.outside_box" unless `box` contains every point. [setup]
Normalized keep_coordinates(const Cloud& cloud, const Box3& box = simulation_box());

}  // namespace dsc::cloud
