// SPDX-License-Identifier: MIT
// Stage 3 written plainly from docs/VIEWER_DATA.md, one pixel at a time and whole images between
// the steps: what the fused kernel is held against by tests and by the benchmark. Slow.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "verdigris/color/convert.h"
#include "verdigris/material/material.h"

namespace verdigris::reference {

inline Image<float> blur(const Image<float>& in, double sigma) {
    const int radius = int(std::ceil(3 * sigma));
    std::vector<double> taps;
    double sum = 0;
    for (int k = -radius; k <= radius; ++k) {
        taps.push_back(sigma > 0 ? std::exp(-k * k / (2 * sigma * sigma)) : 1);
        sum += taps.back();
    }
    const int width = in.width(), height = in.height();
    Image<float> columns(width, height), out(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            double v = 0;
            for (int k = -radius; k <= radius; ++k) {
                v +=
                    taps[std::size_t(k + radius)] * double(in(x, std::clamp(y + k, 0, height - 1)));
            }
            columns(x, y) = float(v / sum);
        }
    }
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            double v = 0;
            for (int k = -radius; k <= radius; ++k) {
                v += taps[std::size_t(k + radius)] *
                     double(columns(std::clamp(x + k, 0, width - 1), y));
            }
            out(x, y) = float(v / sum);
        }
    }
    return out;
}

inline Vec3F normal_of(const Image<float>& h, int x, int y, double k) {
    const auto at = [&](int dx, int dy) {
        return double(
            h(std::clamp(x + dx, 0, h.width() - 1), std::clamp(y + dy, 0, h.height() - 1)));
    };
    const double sobel_x =
        at(1, -1) + 2 * at(1, 0) + at(1, 1) - at(-1, -1) - 2 * at(-1, 0) - at(-1, 1);
    const double sobel_y =
        at(-1, 1) + 2 * at(0, 1) + at(1, 1) - at(-1, -1) - 2 * at(0, -1) - at(1, -1);
    const double nx = -k * sobel_x, ny = k * sobel_y, length = std::sqrt(nx * nx + ny * ny + 1);
    return {float(nx / length), float(ny / length), float(1 / length)};
}

inline Material materialize(const MaterialRecipe& recipe, const Image<SrgbF>& frame) {
    const MaterialOptions& o = recipe.options;
    const int width = frame.width(), height = frame.height();
    Material m{frame.clone(),
               Image<Vec3F>(width, height),
               Image<float>(width, height),
               Image<float>(width, height),
               Image<float>(width, height),
               Image<float>(width, height)};
    Image<float> brightness(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const SrgbF c = frame(x, y), canvas = recipe.canvas(x, y);
            const double change = (std::abs(double(c.r) - double(canvas.r)) +
                                   std::abs(double(c.g) - double(canvas.g)) +
                                   std::abs(double(c.b) - double(canvas.b))) /
                                  3;
            const double excess =
                std::clamp((change - double(recipe.dead_zone(x, y))) / recipe.normalizer, 0.0, 1.0);
            const int zone = recipe.active(x, y);
            const double p = zone == kInside ? std::pow(excess, o.coverage_exponent) : 0;
            const double surface = zone == 0 ? 1 : p;  // the backdrop is no metal
            m.coverage(x, y) = float(p);
            m.metallic(x, y) =
                float(o.metallic_patina + (o.metallic_clean - o.metallic_patina) *
                                              std::pow(1 - surface, o.metallic_gamma));
            m.roughness(x, y) = float(o.roughness_clean + (o.roughness_patina - o.roughness_clean) *
                                                              std::pow(surface, o.roughness_gamma));
            brightness(x, y) = recipe.luma_fill(x, y) >= 0 ? recipe.luma_fill(x, y) : luma(c);
        }
    }
    const Image<float> smooth = blur(brightness, o.height_sigma);
    const double w = o.height_patina_weight;
    for (std::size_t i = 0; i < smooth.pixel_count(); ++i) {
        m.height.pixels()[i] = float(std::clamp(
            (1 - w) * double(smooth.pixels()[i]) + w * double(m.coverage.pixels()[i]), 0.0, 1.0));
    }
    const Image<float> low = blur(m.height, o.micro_sigma);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const double micro =
                std::clamp((double(m.height(x, y)) - double(low(x, y))) / o.micro_range, -1.0,
                           1.0) *
                o.micro_roughness;
            m.roughness(x, y) = float(std::clamp(double(m.roughness(x, y)) + micro, 0.04, 1.0));
            m.normal(x, y) = normal_of(m.height, x, y, o.normal_scale * o.normal_gain / 8);
        }
    }
    return m;
}

/// The largest difference over all maps; normals by component.
inline double largest_difference(const Material& a, const Material& b) {
    double largest = 0;
    const auto plane = [&](const Image<float>& p, const Image<float>& q) {
        for (std::size_t i = 0; i < p.pixel_count(); ++i) {
            const double d = std::abs(double(p.pixels()[i]) - double(q.pixels()[i]));
            largest = std::isnan(d) ? 1e9 : std::max(largest, d);
        }
    };
    plane(a.roughness, b.roughness);
    plane(a.metallic, b.metallic);
    plane(a.height, b.height);
    plane(a.coverage, b.coverage);
    for (std::size_t i = 0; i < a.normal.pixel_count(); ++i) {
        const Vec3F p = a.normal.pixels()[i], q = b.normal.pixels()[i];
        const SrgbF c = a.albedo.pixels()[i], d = b.albedo.pixels()[i];
        for (double v :
             {double(p.x) - double(q.x), double(p.y) - double(q.y), double(p.z) - double(q.z),
              double(c.r) - double(d.r), double(c.g) - double(d.g), double(c.b) - double(d.b)}) {
            largest = std::isnan(v) ? 1e9 : std::max(largest, std::abs(v));
        }
    }
    return largest;
}

}  // namespace verdigris::reference
