// SPDX-License-Identifier: MIT
// Format: docs/VIEWER_DATA.md.
#include "verdigris/deliver/viewer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "verdigris/color/convert.h"
#include "verdigris/deliver/blob.h"
#include "verdigris/deliver/json_text.h"
#include "verdigris/deliver/source_type.h"
#include "verdigris/deliver/status_json.h"
#include "verdigris/deliver/uncertainty_map.h"
#include "verdigris/deliver/viewer_recipe.h"
#include "verdigris/files/base64.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

using Json = nlohmann::ordered_json;

// luma_fill tells clipped pixels by its sign, so 0 and -1 must return exactly: steps of a power of
// two from -1, which put 0 at 2^15.
constexpr Quantization kFillSteps{1.0 / 32768, -1};

// chosen: smaller pages matter more here than the time to write one.
constexpr int kPngLevel = 6;

Json blob_json(const Blob& blob) {
    return {{"channels", blob.channels},
            {"scale", blob.quantization.scale},
            {"offset", blob.quantization.offset},
            {"data", blob.data}};
}

// Everything heavy in the document, made in parallel; each fills its own slot.
class Slots {
  public:
    Json* add(std::function<Json()> make) {
        Job& job = jobs_.emplace_back();
        job.slot = std::make_unique<Json>();
        job.make = std::move(make);
        return job.slot.get();
    }
    void run(const Progress& progress) {
        std::mutex reporting;
        std::int64_t done = 0;
        const auto total = std::int64_t(jobs_.size());
        parallel_for(int(jobs_.size()), [&](int i) {
            Job& job = jobs_[std::size_t(i)];
            *job.slot = job.make();
            const std::scoped_lock lock(reporting);
            report(progress, "deliver", ++done, total);
        });
    }

  private:
    struct Job {
        std::unique_ptr<Json> slot;
        std::function<Json()> make;
    };
    std::vector<Job> jobs_;
};

// A blob of an image at the viewer's size; an absent image is zero everywhere.
std::function<Json()> color_blob(const Image<SrgbF>& image, PictureSize extent) {
    return [&image, extent] {
        if (image.empty()) {
            return blob_json(encode_blob(Image<SrgbF>(extent.width, extent.height).view()));
        }
        return blob_json(encode_blob(resampled(image, extent).view()));
    };
}

std::string picture_uri(const Image<SrgbF>& image, PictureSize extent) {
    const Image<SrgbF> small = resampled(image, extent);
    Image<SrgbU8> codes = Image<SrgbU8>::for_overwrite(extent.width, extent.height);
    std::transform(small.pixels().begin(), small.pixels().end(), codes.pixels().begin(),
                   [](SrgbF c) { return u8_from_srgb(c); });
    return "data:image/png;base64," +
           base64(encode_png(codes.view(), png_options(SourceType::capture, kPngLevel)));
}

Json law_json(const Trajectory& trajectory, PictureSize extent, Slots& slots,
              std::vector<std::pair<std::string, Json*>>& pending) {
    pending = {{"base", slots.add(color_blob(trajectory.base, extent))},
               {"rate", slots.add(color_blob(trajectory.rate, extent))}};
    if (trajectory.law.order == 2) {
        pending.push_back({"curvature", slots.add(color_blob(trajectory.curvature, extent))});
    }
    Json nodes;  // null for a polynomial
    for (const LawNode& n : trajectory.law.nodes) nodes.push_back({n.horizon, n.phi, n.phi2});
    return {{"kind", "law"},   {"order", trajectory.law.order}, {"context", trajectory.law.context},
            {"nodes", nodes},  {"clamp", trajectory.clamp},     {"base", nullptr},
            {"rate", nullptr}, {"curvature", nullptr}};
}

// The roots of the pixels' shares. A half width is off by at most sqrt(own(h)) / 2 steps, so steps
// are as wide as a hundredth of a code allows: finer ones would only be noise, which no zlib packs.
// A pixel that moves never becomes 0, which says that it is held.
Json share_blob(const Spread& spread, PictureSize extent) {
    constexpr double kWorst = 0.01 / 255;  // chosen: nobody sees it, and a legend cannot tell it
    Image<float> roots = own_share(spread, extent);
    double own = 0, largest = 0;
    for (const SpreadNode& n : spread.nodes) own = std::max(own, n.own);
    for (float& v : roots.pixels()) {
        v = std::sqrt(v);
        largest = std::max(largest, double(v));
    }
    const double allowed = own > 0 ? 2 * kWorst / (kHalfWidth80 * std::sqrt(own)) : 1;
    const double step = std::max(allowed, largest / 65535);
    for (float& v : roots.pixels()) {
        if (v > 0) v = std::max(v, float(step));
    }
    return blob_json(encode_blob(roots.view(), {step, 0}));
}

Json spread_json(const Delivery& delivery) {
    const Spread& spread = delivery.forecast->spread;
    if (!spread.known()) return nullptr;
    Json nodes = Json::array();
    for (const SpreadNode& n : spread.nodes) nodes.push_back({n.horizon, n.common, n.own});
    return {{"common", {spread.common.r, spread.common.g, spread.common.b}},
            {"nodes", nodes},
            {"full_codes", uncertainty_full_codes(delivery)},
            {"own", nullptr}};
}

Json scalars_json(const MaterialOptions& o, const MaterialRecipe& recipe) {
    return {{"coverage_exponent", o.coverage_exponent},
            {"roughness_clean", o.roughness_clean},
            {"roughness_patina", o.roughness_patina},
            {"roughness_gamma", o.roughness_gamma},
            {"micro_roughness", o.micro_roughness},
            {"metallic_patina", o.metallic_patina},
            {"metallic_clean", o.metallic_clean},
            {"metallic_gamma", o.metallic_gamma},
            {"height_patina_weight", o.height_patina_weight},
            {"height_sigma", o.height_sigma},
            {"micro_sigma", o.micro_sigma},
            {"normal_scale", o.normal_scale},
            {"normal_gain", o.normal_gain},
            {"micro_range", o.micro_range},
            {"tau", recipe.tau},
            {"normalizer", recipe.normalizer},
            {"reference_horizon", recipe.reference_horizon},
            {"observed_is_clean", recipe.observed_is_clean}};
}

Json people_json(const Delivery& delivery, PictureSize extent) {
    return {{"format", "verdigris-viewer/1"},
            {"title", delivery.title},
            {"version", writer_version()},
            {"width", extent.width},
            {"height", extent.height},
            {"context", delivery.forecast->context_length},
            {"units_observed", delivery.units_observed},
            {"horizons", delivery.horizons},
            {"uncertainty", uncertainty_json(delivery)},
            {"spread", spread_json(delivery)},
            {"forecaster",
             {{"name", delivery.forecast->forecaster},
              {"explanation", delivery.forecast->explanation}}},
            {"guards", guards_json(delivery.guards)},
            {"origins", origins_json(*delivery.forecast, *delivery.recipe)}};
}

// "<" appears only inside JSON strings, where \u003c means the same and ends no element.
std::string without_markup(const std::string& text) {
    std::string safe;
    safe.reserve(text.size());
    for (char c : text) {
        if (c == '<') {
            safe += "\\u003c";
        } else {
            safe += c;
        }
    }
    return safe;
}

}  // namespace

std::string viewer_json(const Delivery& delivery, const Progress& progress) {
    delivered_states(delivery);  // throws if the delivery is not complete
    const Forecast& forecast = *delivery.forecast;
    const MaterialRecipe& recipe = *delivery.recipe;
    const PictureSize extent = fitted({recipe.canvas.width(), recipe.canvas.height()}, kViewerSide);

    Json document = people_json(delivery, extent);
    Slots slots;
    std::vector<std::pair<std::string, Json*>> law;
    std::vector<Json*> frames;
    Json* stack_base = nullptr;
    if (forecast.is_trajectory()) {
        document["trajectory"] = law_json(forecast.trajectory, extent, slots, law);
    } else {
        document["trajectory"] = {{"kind", "frames"},
                                  {"base", nullptr},
                                  {"horizons", forecast.stack.horizons},
                                  {"frames", Json::array()}};
        stack_base = slots.add(color_blob(forecast.stack.base, extent));
        for (const Image<SrgbF>& frame : forecast.stack.frames) {
            frames.push_back(slots.add(color_blob(frame, extent)));
        }
    }
    std::vector<Json*> pictures;
    for (const ObservedFrame& frame : delivery.observed) {
        pictures.push_back(slots.add([&frame, extent]() -> Json {
            return {{"unit", frame.unit}, {"image", picture_uri(frame.image, extent)}};
        }));
    }
    const ViewerRecipe small = viewer_recipe(recipe, extent);
    Json* canvas = slots.add([&] { return blob_json(encode_blob(small.canvas.view())); });
    Json* dead_zone = slots.add([&] { return blob_json(encode_blob(small.dead_zone.view())); });
    Json* active = slots.add([&] { return blob_json(encode_blob(small.active.view())); });
    Json* fill =
        slots.add([&] { return blob_json(encode_blob(small.luma_fill.view(), kFillSteps)); });
    Json* share = nullptr;
    if (forecast.spread.known()) {
        share = slots.add([&] { return share_blob(forecast.spread, extent); });
    }
    slots.run(progress);

    for (auto& [key, slot] : law) document["trajectory"][key] = std::move(*slot);
    if (stack_base) document["trajectory"]["base"] = std::move(*stack_base);
    for (Json* frame : frames) document["trajectory"]["frames"].push_back(std::move(*frame));
    if (share) document["spread"]["own"] = std::move(*share);
    document["observed"] = Json::array();
    for (Json* picture : pictures) document["observed"].push_back(std::move(*picture));
    document["material"] = scalars_json(small.options, recipe);
    document["canvas"] = std::move(*canvas);
    document["dead_zone"] = std::move(*dead_zone);
    document["active"] = std::move(*active);
    document["luma_fill"] = std::move(*fill);
    return without_markup(json_text(document));
}

}  // namespace verdigris
