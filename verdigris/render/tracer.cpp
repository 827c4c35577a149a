// SPDX-License-Identifier: MIT
#include "verdigris/render/tracer.h"

#include <embree3/rtcore.h>

#include <cstring>
#include <limits>

#include "verdigris/error.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {

struct Tracer::State {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    ~State() {
        if (scene) rtcReleaseScene(scene);
        if (device) rtcReleaseDevice(device);
    }
    void check() const {
        const RTCError error = rtcGetDeviceError(device);
        if (error == RTC_ERROR_NONE) return;
        throw Error(ErrorCode::failed, error == RTC_ERROR_OUT_OF_MEMORY
                                           ? "not enough memory for a tree over the triangles"
                                           : "Embree cannot trace rays on this machine");
    }
};

Tracer::Tracer(const Shape& shape) : state_(std::make_unique<State>()) {
    State& s = *state_;
    // Not "threads=1": that would limit all of oneTBB for as long as the device lives.
    s.device = rtcNewDevice(nullptr);
    if (!s.device) throw Error(ErrorCode::failed, "Embree cannot trace rays on this machine");
    s.scene = rtcNewScene(s.device);
    rtcSetSceneFlags(s.scene, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(s.device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* positions =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(Vec3F), shape.positions.size());
    void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                              sizeof(shape.triangles[0]), shape.triangles.size());
    s.check();
    std::memcpy(positions, shape.positions.data(), shape.positions.size() * sizeof(Vec3F));
    std::memcpy(triangles, shape.triangles.data(),
                shape.triangles.size() * sizeof(shape.triangles[0]));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(s.scene, geometry);
    rtcReleaseGeometry(geometry);
    // On several threads the tree need not be the same twice.
    on_one_thread([&] { rtcJoinCommitScene(s.scene); });
    s.check();
}
Tracer::~Tracer() = default;
Tracer::Tracer(Tracer&&) noexcept = default;
Tracer& Tracer::operator=(Tracer&&) noexcept = default;

namespace {

RTCRay ray_along(Vec3F from, Vec3F direction) {
    RTCRay ray{};
    ray.org_x = from.x;
    ray.org_y = from.y;
    ray.org_z = from.z;
    ray.dir_x = direction.x;
    ray.dir_y = direction.y;
    ray.dir_z = direction.z;
    ray.tnear = 0;
    ray.tfar = std::numeric_limits<float>::infinity();
    ray.mask = ~0u;
    return ray;
}

}  // namespace

RayHit Tracer::nearest(Vec3F from, Vec3F direction) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query{};
    query.ray = ray_along(from, direction);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(state_->scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return {true,        query.ray.tfar, query.hit.primID,
            query.hit.u, query.hit.v,    {query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z}};
}

bool Tracer::blocked(Vec3F from, Vec3F direction) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray = ray_along(from, direction);
    rtcOccluded1(state_->scene, &context, &ray);
    return ray.tfar < 0;
}

}  // namespace verdigris
