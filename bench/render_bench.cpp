// SPDX-License-Identifier: MIT
// Stills, and the rays behind them against Embree's own: the smallest loop that asks it for the
// same camera rays, and for as many shadow rays, over the same triangles in the same run. A path
// tracer also makes, shades and weighs each ray: what share of Embree's speed is left is printed
// as the counter "of_embree". The noise that is left is held against many times the samples.
//   verdigris_render_bench                    times
//   verdigris_render_bench noise              PSNR of the default tolerance, minutes
#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <string_view>

#include "verdigris/color/convert.h"
#include "verdigris/pixels/parallel_rows.h"
#include "verdigris/render/settings.h"
#include "verdigris/render/tone_map.h"

namespace {
using namespace verdigris;

/// Copper with a little texture, so that maps are read as in earnest.
Material copper(int side, float roughness) {
    Material m{Image<SrgbF>(side, side),
               Image<Vec3F>(side, side),
               Image<float>(side, side),
               Image<float>(side, side),
               {},
               {}};
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const float wave = std::sin(float(y) * 0.21f) * std::cos(float(x) * 0.017f);
            m.albedo(x, y) = {0.90f + 0.02f * wave, 0.72f, 0.62f - 0.02f * wave};
            const float slope = 0.03f * wave, length = std::sqrt(1 + slope * slope);
            m.normal(x, y) = {0, slope / length, 1 / length};
            m.roughness(x, y) = roughness + 0.04f * wave;
            m.metallic(x, y) = 0.97f;
        }
    }
    return m;
}

struct Studio {
    Setting setting;
    SurfaceMaps maps;
    Lighting lighting = studio_lighting();
    Tracer tracer;
    explicit Studio(SceneKind kind, float roughness = 0.3f)
        : setting(make_setting(kind, 1)), maps(copper(1024, roughness)), tracer(setting.shape) {}
    RenderScene scene() const {
        return {&setting.shape,    &tracer,          &maps, &lighting, setting.view,
                studio_backdrop(), setting.rest_turn};
    }
};

void still(benchmark::State& state, SceneKind kind) {
    const Studio studio(kind);
    RenderOptions options;
    options.width = options.height = 512;
    Rendering r;
    for (auto _ : state) r = render(studio.scene(), options);
    state.counters["samples_per_pixel"] = double(r.samples) / 512 / 512;
    state.counters["Mrays"] = double(r.rays) / 1e6;
    state.counters["Mpaths/s"] =
        benchmark::Counter(double(r.samples) / 1e6, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK_CAPTURE(still, sphere_512, SceneKind::sphere)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(still, plate_512, SceneKind::plate)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(still, drape_512, SceneKind::drape)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Embree alone over a shape.
struct Bare {
    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene scene = rtcNewScene(device);
    explicit Bare(const Shape& shape) {
        RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        std::memcpy(rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12,
                                            shape.positions.size()),
                    shape.positions.data(), 12 * shape.positions.size());
        std::memcpy(rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12,
                                            shape.triangles.size()),
                    shape.triangles.data(), 12 * shape.triangles.size());
        rtcCommitGeometry(g);
        rtcAttachGeometry(scene, g);
        rtcReleaseGeometry(g);
        rtcCommitScene(scene);
    }
    ~Bare() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
};

/// Rays per second of the smallest loop: a camera ray per sample and, where it hits, a shadow ray
/// and a bounced one. 512 x 512 pixels, 4 samples each.
double embree_rays_per_second(const Studio& studio) {
    const Bare bare(studio.setting.shape);
    std::atomic<std::int64_t> rays = 0;
    const auto begin = std::chrono::steady_clock::now();
    parallel_for(512, [&](int y) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        std::int64_t count = 0;
        for (int i = 0; i < 512 * 4; ++i) {
            RTCRayHit q{};
            const Vec3F from = studio.setting.view.position;
            const float x = (float(i) / 2048 - 0.5f) * 0.44f, h = (0.5f - float(y) / 512) * 0.44f;
            const float down = -from.y / from.z;
            const float length = std::sqrt(x * x + (h + down) * (h + down) + 1);
            q.ray = {from.x,      from.y,     from.z,
                     0,           x / length, (h + down) / length,
                     -1 / length, 0,          std::numeric_limits<float>::infinity(),
                     ~0u,         0,          0};
            q.hit.geomID = RTC_INVALID_GEOMETRY_ID;
            rtcIntersect1(bare.scene, &context, &q);
            ++count;
            if (q.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
            const float t = q.ray.tfar * 0.9999f;
            RTCRay away{from.x + t * q.ray.dir_x,
                        from.y + t * q.ray.dir_y,
                        from.z + t * q.ray.dir_z,
                        0,
                        -0.5f,
                        0.6f,
                        0.62f,
                        0,
                        std::numeric_limits<float>::infinity(),
                        ~0u,
                        0,
                        0};
            rtcOccluded1(bare.scene, &context, &away);
            RTCRayHit bounced{};
            bounced.ray = away;
            bounced.ray.tfar = std::numeric_limits<float>::infinity();
            bounced.ray.dir_x = 0.7f;
            bounced.hit.geomID = RTC_INVALID_GEOMETRY_ID;
            rtcIntersect1(bare.scene, &context, &bounced);
            count += 2;
        }
        rays += count;
    });
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    return double(rays) / took.count();
}

void rays_against_embree(benchmark::State& state) {
    const Studio studio(SceneKind::drape);
    RenderOptions options;
    options.width = options.height = 256;
    options.tolerance = 0;
    options.most_samples = 32;
    double ours = 0, theirs = 0;
    for (auto _ : state) {  // in turns, the best of each: other programs use the machine too
        const auto begin = std::chrono::steady_clock::now();
        const Rendering r = render(studio.scene(), options);
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
        ours = std::max(ours, double(r.rays) / took.count());
        theirs = std::max(theirs, embree_rays_per_second(studio));
    }
    state.counters["Mrays/s"] = ours / 1e6;
    state.counters["embree_Mrays/s"] = theirs / 1e6;
    state.counters["of_embree"] = ours / theirs;
}
BENCHMARK(rays_against_embree)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(7);

int noise() {
    for (const float roughness : {0.1f, 0.3f, 0.6f, 0.9f}) {
        const Studio studio(SceneKind::sphere, roughness);
        RenderOptions o;
        o.width = o.height = 256;
        const Rendering quick = render(studio.scene(), o);
        o.tolerance = 0;
        o.most_samples = 1024;
        o.seed = 1;
        const Rendering slow = render(studio.scene(), o);
        double square = 0;
        float worst = 0;
        for (std::size_t i = 0; i < quick.light.pixel_count(); ++i) {
            const SrgbF a = srgb_from_linear(pbr_neutral(quick.light.pixels()[i]));
            const SrgbF b = srgb_from_linear(pbr_neutral(slow.light.pixels()[i]));
            for (const float d : {a.r - b.r, a.g - b.g, a.b - b.b}) {
                square += double(d) * double(d);
                worst = std::max(worst, std::abs(d) * 255);
            }
        }
        const double rms = std::sqrt(square / double(3 * quick.light.pixel_count()));
        std::printf(
            "roughness %.1f: %.1f samples a pixel, rms %.2f codes, PSNR %.1f dB, worst "
            "pixel %.1f codes, against %.0f samples\n",
            double(roughness), double(quick.samples) / double(quick.light.pixel_count()), rms * 255,
            -20 * std::log10(rms), double(worst), 1024.0);
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 2 && std::string_view(argv[1]) == "noise") return noise();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
