// SPDX-License-Identifier: MIT
#include "verdigris/render/surface_maps.h"

#include <algorithm>
#include <cmath>

#include "verdigris/color/convert.h"
#include "verdigris/error.h"
#include "verdigris/pixels/parallel_rows.h"
#include "verdigris/render/vector.h"

namespace verdigris {
namespace {

constexpr int kRowsPerRun = 16;
// 0 has a code of its own: flat stays flat to the last bit.
constexpr float kNormalZero = 32768, kNormalScale = 32767;

std::uint16_t code_of_component(float n) {
    return std::uint16_t(std::lround(std::clamp(n, -1.0f, 1.0f) * kNormalScale + kNormalZero));
}

// The two texels around coordinate x (in texels, centers at +0.5) and the share of the second.
struct Neighbors {
    int a, b;
    float share;
};
Neighbors neighbors(float x, int extent, Beyond beyond) {
    if (!(std::abs(x) < 1e9f)) x = 0;  // wild coordinates of a hostile mesh
    if (beyond == Beyond::repeat) {
        x -= std::floor(x / float(extent)) * float(extent);
    }
    const float at = x - 0.5f;
    int a = int(at) - (at < 0);  // floor, which SSE2 has no instruction for
    const float low = float(a);
    int b = a + 1;
    if (beyond == Beyond::repeat) {
        a = a < 0 ? extent - 1 : std::min(a, extent - 1);
        b = b >= extent ? 0 : b;
    } else {
        a = std::clamp(a, 0, extent - 1);
        b = std::clamp(b, 0, extent - 1);
    }
    return {a, b, at - low};
}

}  // namespace

SurfaceMaps::SurfaceMaps(const Material& m)
    : SurfaceMaps(m, {0, 0, m.albedo.width(), m.albedo.height()}) {}

SurfaceMaps::SurfaceMaps(const Material& m, Rect window) {
    if (m.albedo.empty() || !m.albedo.same_size(m.normal) || !m.albedo.same_size(m.roughness) ||
        !m.albedo.same_size(m.metallic)) {
        throw Error(ErrorCode::usage, "the maps of a material must all have one size, and pixels");
    }
    if (window.x < 0 || window.y < 0 || window.width < 1 || window.height < 1 ||
        window.width > m.albedo.width() - window.x ||
        window.height > m.albedo.height() - window.y) {
        throw Error(ErrorCode::usage, "a part of a material must lie within it");
    }
    texels_ = Image<Texel>::for_overwrite(window.width, window.height);
    parallel_rows(texels_.height(), kRowsPerRun, [&](RowRun run) {
        for (int row = run.begin; row < run.end; ++row) {
            for (int column = 0; column < texels_.width(); ++column) {
                const int x = window.x + column, y = window.y + row;
                const LinearF c = linear_from_srgb(m.albedo(x, y));
                const Vec3F n = m.normal(x, y);
                texels_(column, row).v = {u16_from_unit(c.r),     u16_from_unit(c.g),
                                          u16_from_unit(c.b),     u16_from_unit(m.roughness(x, y)),
                                          code_of_component(n.x), code_of_component(n.y),
                                          code_of_component(n.z), u16_from_unit(m.metallic(x, y))};
            }
        }
    });
}

SurfaceMaps::Point SurfaceMaps::at(float u, float v, Beyond beyond) const {
    const Neighbors x = neighbors(u * float(width()), width(), beyond);
    const Neighbors y = neighbors(v * float(height()), height(), beyond);
    const Texel *top = texels_.row(y.a), *bottom = texels_.row(y.b);
    const float w11 = x.share * y.share, w01 = x.share - w11, w10 = y.share - w11;
    const float w00 = 1 - x.share - w10;
    std::array<float, 8> sum;
    for (std::size_t k = 0; k < 8; ++k) {
        sum[k] = w00 * float(top[x.a].v[k]) + w01 * float(top[x.b].v[k]) +
                 w10 * float(bottom[x.a].v[k]) + w11 * float(bottom[x.b].v[k]);
    }
    constexpr float kUnit = 1.0f / 65535;
    // Of length about 1; a normal that points into the surface is laid flat.
    const Vec3F n{sum[4] - kNormalZero, sum[5] - kNormalZero, std::max(sum[6] - kNormalZero, 1.0f)};
    return {{{sum[0] * kUnit, sum[1] * kUnit, sum[2] * kUnit}, sum[3] * kUnit, sum[7] * kUnit},
            unit(n)};
}

}  // namespace verdigris
