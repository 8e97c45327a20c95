// Ray casting with Embree.
#include "io/ray_scene.hpp"

#include <cstring>
#include <limits>

#include <embree3/rtcore.h>
#include <fmt/core.h>

#include <dsc/base/error.hpp>

namespace dsc::io {

struct RayScene::Data {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    ~Data() {
        if (scene != nullptr) rtcReleaseScene(scene);
        if (device != nullptr) rtcReleaseDevice(device);
    }
};

namespace {

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

}  // namespace

// One thread, and the instruction set that every x86-64 processor has: the same tree and the same
// hits on every machine.
RayScene::RayScene(const std::vector<Vec3f>& points,
                   const std::vector<std::array<std::uint32_t, 3>>& faces)
    : data_(std::make_unique<Data>()) {
    data_->device = rtcNewDevice("threads=1,isa=sse2");
    if (data_->device == nullptr) fail_device(nullptr);
    data_->scene = rtcNewScene(data_->device);
    rtcSetSceneFlags(data_->scene, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(data_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* corner = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                           sizeof(Vec3f), points.size());
    void* index = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                          3 * sizeof(std::uint32_t), faces.size());
    if (corner == nullptr || index == nullptr) {
        rtcReleaseGeometry(geometry);
        fail_device(data_->device);
    }
    std::memcpy(corner, points.data(), points.size() * sizeof(Vec3f));
    std::memcpy(index, faces.data(), faces.size() * 3 * sizeof(std::uint32_t));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(data_->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(data_->scene);
    if (rtcGetDeviceError(data_->device) != RTC_ERROR_NONE) fail_device(data_->device);
}

RayScene::~RayScene() = default;

bool RayScene::first_hit(const Vec3f& origin, const Vec3f& direction, RayHit& hit) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query;
    fill_ray(query.ray, origin, direction, std::numeric_limits<float>::infinity());
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(data_->scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    hit = {query.hit.primID, query.ray.tfar, query.hit.u, query.hit.v};
    return true;
}

bool RayScene::blocked(const Vec3f& origin, const Vec3f& direction, float distance) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray;
    fill_ray(ray, origin, direction, distance);
    rtcOccluded1(data_->scene, &context, &ray);
    return ray.tfar < 0.0F;
}

}  // namespace dsc::io
