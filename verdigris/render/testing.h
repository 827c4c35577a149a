// SPDX-License-Identifier: MIT
// Materials, shapes and scenes for the tests of this room.
#pragma once

#include <algorithm>
#include <utility>

#include "verdigris/color/convert.h"
#include "verdigris/render/render.h"
#include "verdigris/render/vector.h"

namespace verdigris {

/// The same everywhere; `linear` is the base color in linear light.
inline Material even_material(LinearF linear, float roughness, float metallic, int side = 2) {
    Material m{Image<SrgbF>(side, side),
               Image<Vec3F>(side, side),
               Image<float>(side, side),
               Image<float>(side, side),
               {},
               {}};
    std::ranges::fill(m.albedo.pixels(), srgb_from_linear(linear));
    std::ranges::fill(m.normal.pixels(), Vec3F{0, 0, 1});
    std::ranges::fill(m.roughness.pixels(), roughness);
    std::ranges::fill(m.metallic.pixels(), metallic);
    return m;
}

/// A shape, a material and light, kept together.
struct TestScene {
    Shape shape;
    SurfaceMaps maps;
    Lighting lighting;
    Tracer tracer;
    Viewpoint view{{0, 0, 5}, {}, 26};

    TestScene(Shape s, const Material& m, Lighting l)
        : shape(std::move(s)), maps(m), lighting(std::move(l)), tracer(shape) {}
    RenderScene scene() const { return {&shape, &tracer, &maps, &lighting, view, Backdrop{}, 0}; }
    Rendering rendered(int side, int samples = 64) const {
        RenderOptions options;
        options.width = options.height = side;
        options.most_samples = samples;
        options.tolerance = 0;
        return render(scene(), options);
    }
};

inline Lighting even_light(float radiance) {
    return Lighting(SkyLight(gray(radiance)), {});
}

}  // namespace verdigris
