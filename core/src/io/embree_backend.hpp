#pragma once
// Triangles for ray casting, with Embree.

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

namespace dsc::io {

using Vec3f = Eigen::Vector3f;

struct RayHit {
    std::uint32_t face = 0;
    float distance = 0.0F;
    float u = 0.0F;  ///< weight of the face's second corner
    float v = 0.0F;  ///< weight of its third
};

class RayScene {
public:
    RayScene() = default;
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;
    virtual ~RayScene() = default;

    /// First face along the ray; false if there is none. [parallel]
    virtual bool first_hit(const Vec3f& origin, const Vec3f& direction, RayHit& hit) const = 0;
    /// Whether the ray hits anything before `distance`. [parallel]
    virtual bool blocked(const Vec3f& origin, const Vec3f& direction, float distance) const = 0;
};

/// What Embree does for this module. Embree is loaded at the first call.
struct EmbreeBackend {
    /// Copies the triangles. Throws Error "picture.device" if Embree does not start. [setup]
    std::unique_ptr<RayScene> (*make_scene)(const std::vector<Vec3f>& points,
                                            const std::vector<std::array<std::uint32_t, 3>>& faces);
};

/// Throws Error "backend.load". [setup]
const EmbreeBackend& embree_backend();

}  // namespace dsc::io
