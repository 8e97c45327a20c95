#pragma once
// Triangles for ray casting. Only its source uses Embree.

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
    /// Copies the triangles. Throws Error "picture.device" if Embree does not start. [setup]
    RayScene(const std::vector<Vec3f>& points,
             const std::vector<std::array<std::uint32_t, 3>>& faces);
    ~RayScene();
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;

    /// First face along the ray; false if there is none. [parallel]
    bool first_hit(const Vec3f& origin, const Vec3f& direction, RayHit& hit) const;
    /// Whether the ray hits anything before `distance`. [parallel]
    bool blocked(const Vec3f& origin, const Vec3f& direction, float distance) const;

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

}  // namespace dsc::io
