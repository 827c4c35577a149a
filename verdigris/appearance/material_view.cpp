// SPDX-License-Identifier: MIT
#include "verdigris/appearance/material_view.h"

#include <algorithm>

#include "verdigris/color/convert.h"
#include "verdigris/error.h"
#include "verdigris/render/tone_map.h"

namespace verdigris {
namespace {

constexpr int kSmallest = 32, kLargest = 2048, kMostSamples = 4096;

Rect checked(const ViewOptions& o, Rect shown) {
    if (o.size < kSmallest || o.size > kLargest)
        throw Error(ErrorCode::usage, "a view has 32 to 2048 pixels a side");
    if (o.samples < 8 || o.samples > kMostSamples || (o.samples & (o.samples - 1)) != 0)
        throw Error(ErrorCode::usage, "the samples of a view are a power of two from 8 to 4096");
    if (shown.width < 1 || shown.height < 1)
        throw Error(ErrorCode::usage, "a view shows at least one pixel of a material");
    return shown;
}

}  // namespace

MaterialView::MaterialView(const ViewOptions& options, Rect shown)
    : options_(options),
      shown_(checked(options, shown)),
      setting_(make_setting(options.scene, double(shown.width) / shown.height)),
      tracer_(setting_.shape),
      lighting_(studio_lighting()) {}

Image<SrgbF> MaterialView::picture(const Material& material, std::uint32_t seed) const {
    const SurfaceMaps maps(material, shown_);
    const RenderScene scene{&setting_.shape,   &tracer_,          &maps, &lighting_, setting_.view,
                            studio_backdrop(), setting_.rest_turn};
    RenderOptions options;
    options.width = options.height = options_.size;
    options.tolerance = 0;
    options.most_samples = options_.samples;
    options.seed = seed;
    const Rendering rendering = render(scene, options);
    auto out = Image<SrgbF>::for_overwrite(options_.size, options_.size);
    std::ranges::transform(rendering.light.pixels(), out.pixels().begin(),
                           [](LinearF c) { return srgb_from_linear(pbr_neutral(c)); });
    return out;
}

}  // namespace verdigris
