// SPDX-License-Identifier: MIT
#include "verdigris/render/light_path.h"

#include <algorithm>
#include <cmath>

#include "verdigris/render/brdf.h"
#include "verdigris/render/vector.h"

namespace verdigris {
namespace {

// chosen: the object has radius 1, and 1e-4 of it is a tenth of a pixel.
constexpr float kOffset = 1e-4f;
// chosen: ten times white. What comes over the object itself may not exceed it, per path.
constexpr float kMostIndirect = 10;
// chosen: a normal that a map bends away from the viewer is taken back to this cosine.
constexpr float kLeastCosine = 0.01f;

// Pairs of dimensions: 0 is the pixel, then two per vertex.
constexpr std::uint32_t kPairsPerVertex = 2;

float power_weight(float own, float other) {
    const float a = own * own, b = other * other;
    return a + b > 0 ? a / (a + b) : 0;
}

// Under the surface there is nothing to see: such a direction is turned up again.
Vec3F turned_up(Vec3F direction, Vec3F face) {
    return direction - face * (2 * dot(direction, face));
}

LinearF limited(LinearF c) {
    const float most = std::max({c.r, c.g, c.b});
    return most > kMostIndirect ? c * (kMostIndirect / most) : c;
}

}  // namespace

struct LightPaths::Vertex {
    Vec3F position;  // just outside
    Vec3F face;      // unit, to the side the path came from
    LocalFrame frame;
    Brdf brdf;
    Lighting::Weights weights;
};

LightPaths::LightPaths(const RenderScene& scene, int bounces)
    : scene_(scene),
      bounces_(bounces),
      cos_(float(std::cos(scene.turn))),
      sin_(float(std::sin(scene.turn))) {}

RayHit LightPaths::nearest(Vec3F from, Vec3F direction) {
    ++rays_;
    return scene_.tracer->nearest(to_object(from), to_object(direction));
}
bool LightPaths::blocked(Vec3F from, Vec3F direction) {
    if (!scene_.shape->hides_itself) return false;
    ++rays_;
    return scene_.tracer->blocked(to_object(from), to_object(direction));
}

LightPaths::Vertex LightPaths::vertex(const RayHit& hit, Vec3F direction) const {
    const Shape& shape = *scene_.shape;
    const auto& corner = shape.triangles[hit.triangle];
    const float w[3] = {1 - hit.second - hit.third, hit.second, hit.third};
    Vec3F position, normal, along;
    float u = 0, v = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t i = corner[k];
        position = position + shape.positions[i] * w[k];
        normal = normal + shape.normals[i] * w[k];
        along = along + shape.tangents[i].direction * w[k];
        u += shape.coordinates[i].u * w[k];
        v += shape.coordinates[i].v * w[k];
    }
    const SurfaceMaps::Point point = scene_.maps->at(u, v, shape.beyond);

    Vec3F face = to_world(unit_or_zero(hit.face));
    Vec3F n = to_world(unit_or_zero(normal));
    if (dot(n, n) == 0) n = face;
    if (dot(n, face) < 0) n = -n;  // normals of a hostile mesh may lie on the other side
    Vec3F t = to_world(along);
    t = unit_or_zero(t - n * dot(n, t));
    if (dot(t, t) == 0) t = frame_around(n).tangent;
    const Vec3F b = cross(n, t) * shape.tangents[corner[0]].sign;
    const Vec3F viewer = -direction;
    Vec3F bent = t * point.normal.x + b * point.normal.y + n * point.normal.z;
    // Seen from behind the normal turns around, as glTF asks, with what the map says: what stands
    // out in front is a hollow there.
    if (dot(face, viewer) < 0) {
        face = -face;
        bent = -bent;
    }
    const float facing = dot(bent, viewer);
    if (facing < kLeastCosine) bent = bent + viewer * (kLeastCosine - facing);
    const LocalFrame frame = frame_around(unit(bent));
    Vec3F local_viewer = frame.local(viewer);
    local_viewer.z = std::max(local_viewer.z, 1e-4f);
    const Brdf brdf(point.surface, local_viewer);
    const Vec3F outside = to_world(position) + face * kOffset;
    const auto weights = scene_.lighting->weights(
        {outside, frame.normal, viewer, brdf.alpha(), 1 - brdf.highlight_share()});
    return {outside, face, frame, brdf, weights};
}

LinearF LightPaths::direct(const Vertex& at, std::uint32_t sample, std::uint32_t pair,
                           std::uint32_t seed) {
    if (!(at.weights.sum > 0)) return {};
    const Lighting& lighting = *scene_.lighting;
    const Vec3F direction =
        lighting.sample(at.position, at.weights, sobol_point(sample, pair, seed));
    if (dot(direction, at.face) <= 0) return {};
    const Lighting::Light light = lighting.along(at.position, direction, at.weights);
    if (!(light.pdf > 0)) return {};
    LinearF sum{};
    // The direction itself, and the one below the surface that would be turned up to it.
    for (const Vec3F& l : {direction, turned_up(direction, at.face)}) {
        const Vec3F local = at.frame.local(l);
        if (local.z <= 0) continue;
        const Brdf::Value value = at.brdf.evaluate(local);
        sum += value.f * (local.z * power_weight(light.pdf, value.pdf) / light.pdf);
    }
    if (luminance(sum) <= 0 || blocked(at.position, direction)) return {};
    return sum * light.radiance;
}

LinearF LightPaths::path(const Vertex& first, std::uint32_t sample, std::uint32_t seed) {
    const Lighting& lighting = *scene_.lighting;
    LinearF result{}, through = gray(1);
    Vertex at = first;
    for (int bounce = 0;; ++bounce) {
        const std::uint32_t pair = 1 + kPairsPerVertex * std::uint32_t(bounce);
        const LinearF direct_light = through * direct(at, sample, pair, seed);
        result += bounce == 0 ? direct_light : limited(direct_light);

        const Brdf::Sample next = at.brdf.sample(sobol_point(sample, pair + 1, seed));
        if (!(next.pdf > 0)) return result;
        through = through * next.weight;
        Vec3F direction = at.frame.world(next.to_light);
        if (dot(direction, at.face) < 0) direction = turned_up(direction, at.face);

        const RayHit hit = scene_.shape->hides_itself ? nearest(at.position, direction) : RayHit{};
        if (!hit.hit) {
            const Lighting::Light light = lighting.along(at.position, direction, at.weights);
            const LinearF found = through * light.radiance * power_weight(next.pdf, light.pdf);
            return result + (bounce == 0 ? found : limited(found));
        }
        if (bounce == bounces_) return result;
        at = vertex(hit, direction);
    }
}

bool LightPaths::light(Vec3F from, Vec3F direction, std::uint32_t sample, std::uint32_t seed,
                       LinearF& result) {
    const RayHit hit = nearest(from, direction);
    if (!hit.hit) return false;
    const Vertex first = vertex(hit, direction);
    result = {};
    for (std::uint32_t k = 0; k < kSplits; ++k) result += path(first, sample * kSplits + k, seed);
    result = result * (1.0f / kSplits);
    return true;
}

}  // namespace verdigris
