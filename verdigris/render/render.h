// SPDX-License-Identifier: MIT
// A material on a shape under fixed light, as a picture: for people who decide whether the material
// is good, and for comparing materials by what they look like.
// Beside the path: material -> [render].   Model: docs/models/render.md
#pragma once

#include <cstdint>

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"
#include "verdigris/progress.h"
#include "verdigris/render/lighting.h"
#include "verdigris/render/shape.h"
#include "verdigris/render/surface_maps.h"
#include "verdigris/render/tracer.h"

namespace verdigris {

/// Where the picture is taken from. +Y is up in it, or -Z if it looks straight up or down.
struct Viewpoint {
    Vec3F position{0, 0, 5}, target{};
    double field_of_view = 26;  ///< of the picture's shorter side, degrees in (0, 170]. chosen: as
                                ///< an 85 mm lens
};

/// What is seen where there is no object: it lights nothing. Brightest around the middle.
struct Backdrop {
    LinearF middle, corner;
};

/// All pointers must outlive the rendering.
struct RenderScene {
    const Shape* shape = nullptr;
    const Tracer* tracer = nullptr;  ///< over `shape`
    const SurfaceMaps* maps = nullptr;
    const Lighting* lighting = nullptr;
    Viewpoint view;
    Backdrop backdrop;
    double turn = 0;  ///< of the object around +Y, radians, counter-clockwise from above
};

struct RenderOptions {
    int width = 1024, height = 1024;
    /// A pixel gets samples until its own estimate of the noise that is left, a standard
    /// deviation after tone mapping, is below this many codes of 255. The estimate is careful:
    /// what is left is about a third of it. 0: all of `most_samples`.
    double tolerance = 3;
    double exposure = 0;     ///< stops it will be developed with; noise is judged so
    int most_samples = 256;  ///< rays of the camera per pixel; a power of two from 8 on
    int bounces = 3;         ///< from the object to itself, where it hides itself
    std::uint32_t seed = 0;
};

struct Rendering {
    Image<LinearF> light;
    std::int64_t samples = 0;  ///< rays of the camera in all; each splits into four paths
    std::int64_t rays = 0;     ///< traced in all
};

/// Path tracing with quasi-random samples and multiple importance sampling of lights and of the
/// surface [VeachGuibas1995]. Unbiased but for light that comes over the object itself (`bounces`,
/// and at most 10 a path, so that no single one shows) and for stopping early where a pixel's own
/// samples happen to agree. The same picture at any thread count.
/// Throws Error{usage}: an option out of range, a scene without parts, a view from nowhere.
/// Cost: docs/BENCHMARKS.md.
Rendering render(const RenderScene& scene, const RenderOptions& options,
                 const Progress& progress = {});

}  // namespace verdigris
