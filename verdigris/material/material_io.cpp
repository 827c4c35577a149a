// SPDX-License-Identifier: MIT
#include "verdigris/material/material_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <type_traits>
#include <utility>

#include "verdigris/error.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/files/npy.h"
#include "verdigris/files/png.h"
#include "verdigris/files/staged_folder.h"
#include "verdigris/material/options_check.h"

namespace verdigris {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr const char* kFormat = "verdigris-recipe/1";
constexpr const char* kManifest = "recipe.json";

/// Every option under the name it has in material.h.
struct Field {
    const char* name;
    double MaterialOptions::*value;
};
constexpr std::array<Field, 15> kFields{{
    {"coverage_exponent", &MaterialOptions::coverage_exponent},
    {"normalizer_percentile", &MaterialOptions::normalizer_percentile},
    {"roughness_clean", &MaterialOptions::roughness_clean},
    {"roughness_patina", &MaterialOptions::roughness_patina},
    {"roughness_gamma", &MaterialOptions::roughness_gamma},
    {"micro_roughness", &MaterialOptions::micro_roughness},
    {"metallic_patina", &MaterialOptions::metallic_patina},
    {"metallic_clean", &MaterialOptions::metallic_clean},
    {"metallic_gamma", &MaterialOptions::metallic_gamma},
    {"height_patina_weight", &MaterialOptions::height_patina_weight},
    {"height_sigma", &MaterialOptions::height_sigma},
    {"micro_sigma", &MaterialOptions::micro_sigma},
    {"micro_range", &MaterialOptions::micro_range},
    {"normal_scale", &MaterialOptions::normal_scale},
    {"normal_gain", &MaterialOptions::normal_gain},
}};

template <class P>
constexpr std::size_t kChannelsOf = std::is_same_v<P, float> ? 1 : 3;

template <class P>
void write_array(const fs::path& path, const Image<P>& image) {
    std::vector<std::size_t> shape{std::size_t(image.height()), std::size_t(image.width())};
    constexpr std::size_t kChannels = kChannelsOf<P>;
    if (kChannels > 1) shape.push_back(kChannels);
    write_npy(path, NpyType::f32, shape, std::as_bytes(image.pixels()));
}

template <class P>
Image<P> read_array(const fs::path& path) {
    constexpr std::size_t kChannels = kChannelsOf<P>, kLargest = 1u << 20;
    static_assert(sizeof(P) == kChannels * sizeof(float));
    const NpyFile file(path);
    const auto& shape = file.shape();
    const auto values = file.values<float>();
    const bool fits =
        kChannels == 1 ? shape.size() == 2 : shape.size() == 3 && shape[2] == kChannels;
    if (!fits || shape[0] == 0 || shape[1] == 0 || shape[0] > kLargest || shape[1] > kLargest) {
        throw Error(
            ErrorCode::bad_input,
            fmt::format("is not an image of {} channel{}", kChannels, kChannels == 1 ? "" : "s"),
            path.string());
    }
    if (std::any_of(values.begin(), values.end(), [](float v) { return !std::isfinite(v); })) {
        throw Error(ErrorCode::bad_input, "holds a value that is not a number", path.string());
    }
    Image<P> image = Image<P>::for_overwrite(int(shape[1]), int(shape[0]));
    std::memcpy(static_cast<void*>(image.row(0)), values.data(), image.byte_count());
    return image;
}

template <class P>
void require_size(const Image<P>& image, const Image<SrgbF>& canvas, const fs::path& path) {
    if (!image.same_size(canvas)) {
        throw Error(ErrorCode::bad_input, "has another size than canvas.npy", path.string());
    }
}

MaterialRecipe recipe_from(const Json& json, const fs::path& folder) {
    const std::string manifest = (folder / kManifest).string();
    if (json.at("format") != kFormat) {
        throw Error(ErrorCode::bad_input, fmt::format("is not of the format {}", kFormat),
                    manifest);
    }
    MaterialRecipe recipe;
    for (const Field& f : kFields) recipe.options.*f.value = json.at("options").at(f.name);
    recipe.options.reference_horizon = json.at("options").at("reference_horizon");
    recipe.tau = json.at("tau");
    recipe.normalizer = json.at("normalizer");
    recipe.reference_horizon = json.at("reference_horizon");
    recipe.observed_is_clean = json.at("observed_is_clean");
    try {
        check_options(recipe.options);
    } catch (const Error& e) {
        throw Error(ErrorCode::bad_input, e.sentence(), manifest);
    }
    if (!(recipe.normalizer > 0) || !(recipe.tau >= 0)) {
        throw Error(ErrorCode::bad_input, "needs a positive normalizer and a tau of 0 or more",
                    manifest);
    }
    recipe.canvas = read_array<SrgbF>(folder / "canvas.npy");
    recipe.dead_zone = read_array<float>(folder / "dead_zone.npy");
    recipe.luma_fill = read_array<float>(folder / "luma_fill.npy");
    recipe.active = read_gray_png(folder / "active.png");
    require_size(recipe.dead_zone, recipe.canvas, folder / "dead_zone.npy");
    require_size(recipe.luma_fill, recipe.canvas, folder / "luma_fill.npy");
    require_size(recipe.active, recipe.canvas, folder / "active.png");
    return recipe;
}

}  // namespace

void write_recipe(const MaterialRecipe& recipe, const fs::path& folder) {
    Json options;
    for (const Field& f : kFields) options[f.name] = recipe.options.*f.value;
    options["reference_horizon"] = recipe.options.reference_horizon;
    const Json manifest{{"format", kFormat},
                        {"options", options},
                        {"tau", recipe.tau},
                        {"normalizer", recipe.normalizer},
                        {"reference_horizon", recipe.reference_horizon},
                        {"observed_is_clean", recipe.observed_is_clean}};
    StagedFolder staged(folder);
    const fs::path& to = staged.path();
    write_array(to / "canvas.npy", recipe.canvas);
    write_array(to / "dead_zone.npy", recipe.dead_zone);
    write_array(to / "luma_fill.npy", recipe.luma_fill);
    write_png(to / "active.png", recipe.active);
    write_file(to / kManifest, manifest.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
    staged.commit(kManifest);
}

MaterialRecipe read_recipe(const fs::path& folder) {
    const fs::path manifest = folder / kManifest;
    const std::string text = read_text(manifest);
    try {
        return recipe_from(Json::parse(text), folder);
    } catch (const Json::exception& e) {
        throw Error(ErrorCode::bad_input, fmt::format("is not a recipe ({})", e.what()),
                    manifest.string());
    }
}

}  // namespace verdigris
