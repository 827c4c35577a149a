// SPDX-License-Identifier: MIT
#include "verdigris/render/render.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include "verdigris/pixels/parallel_rows.h"
#include "verdigris/render/light_path.h"
#include "verdigris/render/tone_map.h"
#include "verdigris/render/vector.h"

namespace verdigris {
namespace {

constexpr int kTile = 16;  // pixels a side: about 1 ms of work
constexpr int kMostTilesPerReport = 128;
// chosen: an interrupt is heard within half a second, unless a single tile takes longer.
constexpr std::chrono::milliseconds kLongReport{200};
constexpr int kFirstSamples = 8;
constexpr int kMostExtent = 16384;
constexpr double kMostStops = 100, kWidestView = 170;

void check(const RenderScene& scene, const RenderOptions& o) {
    const auto refuse = [](const char* sentence) { throw Error(ErrorCode::usage, sentence); };
    if (!scene.shape || !scene.tracer || !scene.maps || !scene.lighting) {
        refuse("a scene needs a shape, its tracer, maps and light");
    }
    if (o.width < 1 || o.height < 1 || o.width > kMostExtent || o.height > kMostExtent) {
        refuse("a picture has 1 to 16384 pixels a side");
    }
    if (o.most_samples < kFirstSamples || o.most_samples > 1 << 20 ||
        (o.most_samples & (o.most_samples - 1)) != 0) {
        refuse("the samples of a pixel are a power of two from 8 to 1048576");
    }
    if (!(o.tolerance >= 0)) refuse("a tolerance is 0 or more codes");
    if (!(std::abs(o.exposure) <= kMostStops)) refuse("an exposure is -100 to 100 stops");
    const Viewpoint& view = scene.view;
    const float away = length(view.target - view.position);
    if (!(away > 0 && std::isfinite(away)) || !(view.field_of_view > 0) ||
        view.field_of_view > kWidestView) {
        refuse("a view looks from one point at another, over more than 0 to 170 degrees");
    }
    if (o.bounces < 0 || o.bounces > 64) refuse("light may bounce 0 to 64 times");
}

/// Rays of a pinhole.
struct Pinhole {
    Vec3F position, right, up, forward;
    float scale, middle_x, middle_y;

    Pinhole(const Viewpoint& view, int width, int height) : position(view.position) {
        forward = unit(view.target - view.position);
        right = cross(forward, {0, 1, 0});
        // Straight up or down any direction of the picture is as good: that of a map of the ground.
        right = length(right) > 1e-4f ? unit(right) : unit(cross(forward, {0, 0, -1}));
        up = cross(right, forward);
        const int shorter = std::min(width, height);
        scale = float(2 * std::tan(view.field_of_view * double(kPi) / 360) / shorter);
        middle_x = float(width) / 2;
        middle_y = float(height) / 2;
    }
    Vec3F direction(float x, float y) const {
        return unit(forward + right * ((x - middle_x) * scale) + up * ((middle_y - y) * scale));
    }
};

// Offsets from a pixel's center, distributed as a tent of radius 1: the pixel filter, drawn from
// instead of multiplied with.
float tent(float u) {
    return u < 0.5f ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 - 2 * u);
}

struct PixelSum {
    LinearF mean;
    float error = 0;  // of the mean, in codes
    int samples = 0;
};

// About what the eye sees of it: codes of 255. Gamma 2 is near enough to sRGB for a threshold.
float difference_in_codes(LinearF a, LinearF b, float gain) {
    const LinearF x = pbr_neutral(a * gain), y = pbr_neutral(b * gain);
    const auto codes = [](float p, float q) { return std::abs(std::sqrt(p) - std::sqrt(q)) * 255; };
    return std::max({codes(x.r, y.r), codes(x.g, y.g), codes(x.b, y.b)});
}

class Renderer {
  public:
    Renderer(const RenderScene& scene, const RenderOptions& options)
        : scene_(scene),
          options_(options),
          pinhole_(scene.view, options.width, options.height),
          gain_(float(std::exp2(options.exposure))),
          pixels_(options.width, options.height),
          columns_((options.width + kTile - 1) / kTile),
          rows_((options.height + kTile - 1) / kTile) {}

    int tiles() const { return columns_ * rows_; }

    /// Doubles the samples of the pixels that need it, in one tile. Returns the rays traced.
    std::int64_t refine(int tile) {
        LightPaths paths(scene_, options_.bounces);
        const int x0 = tile % columns_ * kTile, y0 = tile / columns_ * kTile;
        for (int y = y0; y < std::min(y0 + kTile, options_.height); ++y) {
            for (int x = x0; x < std::min(x0 + kTile, options_.width); ++x) {
                PixelSum& p = pixels_(x, y);
                if (p.samples == 0) {
                    p.mean = mean_of(paths, x, y, 0, kFirstSamples / 2);
                    p.samples = kFirstSamples / 2;
                } else if (!wanted(x, y)) {
                    continue;
                }
                // Both halves are stratified in themselves, and together better than either: what
                // they differ by is no less than the error of their mean.
                const LinearF more = mean_of(paths, x, y, p.samples, p.samples);
                p.error = difference_in_codes(p.mean, more, gain_) / 2;
                p.mean = mix(p.mean, more, 0.5f);
                p.samples *= 2;
            }
        }
        return paths.rays();
    }

    /// Decides who needs more. One difference is a poor estimate: neighbors are asked too.
    bool plan() {
        const int width = options_.width, height = options_.height;
        if (wanted_.empty()) wanted_ = Mask(width, height);
        const float allowed = float(options_.tolerance * options_.tolerance);
        const auto counts = map_rows<std::int64_t>(height, kTile, [&](RowRun run) {
            std::int64_t count = 0;
            for (int y = run.begin; y < run.end; ++y) {
                for (int x = 0; x < width; ++x) {
                    wanted_(x, y) =
                        pixels_(x, y).samples < options_.most_samples &&
                                (options_.tolerance == 0 || mean_square_error(x, y) > allowed)
                            ? kInside
                            : 0;
                    count += wanted_(x, y) != 0;
                }
            }
            return count;
        });
        for (const std::int64_t count : counts) {
            if (count > 0) return true;
        }
        return false;
    }

    Rendering result(std::int64_t rays) const {
        Rendering out{Image<LinearF>::for_overwrite(options_.width, options_.height), 0, rays};
        for (std::size_t i = 0; i < pixels_.pixel_count(); ++i) {
            out.light.pixels()[i] = pixels_.pixels()[i].mean;
            out.samples += pixels_.pixels()[i].samples;
        }
        return out;
    }

  private:
    bool wanted(int x, int y) const { return wanted_(x, y) != 0; }

    float mean_square_error(int x, int y) const {
        constexpr int kReach = 2;
        float sum = 0;
        int count = 0;
        for (int j = std::max(y - kReach, 0); j <= std::min(y + kReach, options_.height - 1); ++j) {
            for (int i = std::max(x - kReach, 0); i <= std::min(x + kReach, options_.width - 1);
                 ++i) {
                sum += pixels_(i, j).error * pixels_(i, j).error;
                ++count;
            }
        }
        return sum / float(count);
    }

    LinearF backdrop(float x, float y) const {
        const float dx = x / float(options_.width) - 0.5f, dy = y / float(options_.height) - 0.5f;
        const float t = std::clamp(2 * (dx * dx + dy * dy), 0.0f, 1.0f);
        return mix(scene_.backdrop.middle, scene_.backdrop.corner, t * (2 - t));
    }

    LinearF mean_of(LightPaths& paths, int x, int y, int first, int count) const {
        const std::uint32_t seed =
            seed_of(std::uint32_t(x) | std::uint32_t(y) << 16, options_.seed + 1);
        LinearF sum{}, light;
        for (int i = first; i < first + count; ++i) {
            const UnitPoint u = sobol_point(std::uint32_t(i), 0, seed);
            const float px = float(x) + 0.5f + tent(u.x), py = float(y) + 0.5f + tent(u.y);
            const Vec3F direction = pinhole_.direction(px, py);
            const bool hit =
                paths.light(pinhole_.position, direction, std::uint32_t(i), seed, light);
            sum += hit ? light : backdrop(px, py);
        }
        return sum * (1 / float(count));
    }

    const RenderScene& scene_;
    const RenderOptions& options_;
    Pinhole pinhole_;
    float gain_;
    Image<PixelSum> pixels_;
    Mask wanted_;
    int columns_, rows_;
};

}  // namespace

Rendering render(const RenderScene& scene, const RenderOptions& options, const Progress& progress) {
    check(scene, options);
    Renderer renderer(scene, options);
    const int tiles = renderer.tiles();
    int passes = 1;
    for (int n = kFirstSamples; n < options.most_samples; n *= 2) ++passes;
    const std::int64_t total = std::int64_t(passes) * tiles;
    std::vector<std::int64_t> rays(std::size_t(tiles), 0);
    for (int pass = 0; pass == 0 || renderer.plan(); ++pass) {
        // How many tiles go together is a matter of time, and changes none of them.
        int together = 2;
        for (int first = 0; first < tiles;) {
            report(progress, "render", std::int64_t(pass) * tiles + first, total);
            const auto start = std::chrono::steady_clock::now();
            const int count = std::min(together, tiles - first);
            parallel_for(
                count, [&](int i) { rays[std::size_t(first + i)] += renderer.refine(first + i); });
            first += count;
            const auto spent = std::chrono::steady_clock::now() - start;
            if (spent > kLongReport) together = std::max(together / 2, 2);
            if (spent < kLongReport / 4) together = std::min(together * 2, kMostTilesPerReport);
        }
    }
    report(progress, "render", total, total);
    std::int64_t sum = 0;
    for (const std::int64_t n : rays) sum += n;
    return renderer.result(sum);
}

}  // namespace verdigris
