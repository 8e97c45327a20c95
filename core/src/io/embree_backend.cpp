// Ray casting with Embree: the backend libdsc_embree.so.
#include "io/embree_backend.hpp"

#include <cstring>
#include <limits>

#include <embree3/rtcore.h>
#include <fmt/core.h>

#include <dsc/base/backend.hpp>
#include <dsc/base/error.hpp>

namespace dsc::io {

namespace {

struct Handles {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;

    Handles() = default;
    Handles(const Handles&) = delete;
    Handles& operator=(const Handles&) = delete;
    ~Handles() {
        if (scene != nullptr) rtcReleaseScene(scene);
        if (device != nullptr) rtcReleaseDevice(device);
    }
};

[[noreturn]] void fail_device(RTCDevice device) {
    throw Error(ExitCode::internal, "picture.device", "picture",
                fmt::format("Embree reports error {}", static_cast<int>(rtcGetDeviceError(device))),
                "close other programs if memory is short");
}

void fill_ray(RTCRay& ray, const Vec3f& origin, const Vec3f& direction, float distance) {
    ray.org_x = origin.x();
    ray.org_y = origin.y();
    ray.org_z = origin.z();
    ray.dir_x = direction.x();
    ray.dir_y = direction.y();
    ray.dir_z = direction.z();
    ray.tnear = 0.0F;
    ray.tfar = distance;
    ray.time = 0.0F;
    ray.mask = 0xffffffffU;
    ray.id = 0;
    ray.flags = 0;
}

// One thread, and the instruction set that every x86-64 processor has: the same tree and the same
// hits on every machine.
void build(Handles& out, const std::vector<Vec3f>& points,
           const std::vector<std::array<std::uint32_t, 3>>& faces) {
    out.device = rtcNewDevice("threads=1,isa=sse2");
    if (out.device == nullptr) fail_device(nullptr);
    out.scene = rtcNewScene(out.device);
    rtcSetSceneFlags(out.scene, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(out.device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* corner = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                           sizeof(Vec3f), points.size());
    void* index = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                          3 * sizeof(std::uint32_t), faces.size());
    if (corner == nullptr || index == nullptr) {
        rtcReleaseGeometry(geometry);
        fail_device(out.device);
    }
    std::memcpy(corner, points.data(), points.size() * sizeof(Vec3f));
    std::memcpy(index, faces.data(), faces.size() * 3 * sizeof(std::uint32_t));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(out.scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(out.scene);
    if (rtcGetDeviceError(out.device) != RTC_ERROR_NONE) fail_device(out.device);
}

class EmbreeScene final : public RayScene {
public:
    EmbreeScene(const std::vector<Vec3f>& points,
                const std::vector<std::array<std::uint32_t, 3>>& faces) {
        build(handles_, points, faces);
    }

    bool first_hit(const Vec3f& origin, const Vec3f& direction, RayHit& hit) const override {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRayHit query;
        fill_ray(query.ray, origin, direction, std::numeric_limits<float>::infinity());
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(handles_.scene, &context, &query);
        if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
        hit = {query.hit.primID, query.ray.tfar, query.hit.u, query.hit.v};
        return true;
    }

    bool blocked(const Vec3f& origin, const Vec3f& direction, float distance) const override {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRay ray;
        fill_ray(ray, origin, direction, distance);
        rtcOccluded1(handles_.scene, &context, &ray);
        return ray.tfar < 0.0F;
    }

private:
    Handles handles_;
};

std::unique_ptr<RayScene> make_scene(const std::vector<Vec3f>& points,
                                     const std::vector<std::array<std::uint32_t, 3>>& faces) {
    return std::make_unique<EmbreeScene>(points, faces);
}

}  // namespace
}  // namespace dsc::io

extern "C" DSC_BACKEND_EXPORT const void* dsc_backend_embree() {
    static constexpr dsc::io::EmbreeBackend table{dsc::io::make_scene};
    return &table;
}
