// SPDX-License-Identifier: MIT
// Stage 3. A forecast frame becomes albedo, normal, roughness, metallic and height.
// Path: forecast -> [material] -> deliver.   Model: docs/models/material.md
// Based on: [Paper] Eqs. (2), (3) and the constants beside them.
#pragma once

#include <string>
#include <vector>

#include "verdigris/color/pixel_types.h"
#include "verdigris/forecast/forecast.h"
#include "verdigris/pixels/image.h"
#include "verdigris/status.h"

namespace verdigris {

/// Specimen that a glint hides, in MaterialRecipe::active.
inline constexpr std::uint8_t kUnderGlint = 128;

/// The paper's constants [Paper, Section 3] unless marked.
struct MaterialOptions {
    double coverage_exponent = 0.85;
    double normalizer_percentile = 0.99;  ///< of the change map above tau
    double roughness_clean = 0.16, roughness_patina = 0.88, roughness_gamma = 0.75;
    double micro_roughness = 0.06;  ///< +- from the high-pass of the height field
    double metallic_patina = 0.03, metallic_clean = 0.97, metallic_gamma = 1.25;
    double height_patina_weight = 0.45;
    double height_sigma = 1.0;  ///< Gaussian on the luma, pixels. chosen: see the model
    double micro_sigma = 2.0;   ///< low-pass of the high-pass, pixels. chosen
    double micro_range = 0.04;  ///< high-pass amplitude that counts as full. chosen
    double normal_scale = 2.6;  ///< the paper's gradient scale
    double normal_gain = 3;     ///< 8: plain Sobel; 1: gradient per pixel. chosen: see the model
    /// Where the 99th percentile is taken, in units. 0: at twice the context length, the horizon
    /// up to which the guards trust a forecast. Fixed per specimen, so that coverage grows
    /// smoothly with the age. chosen.
    double reference_horizon = 0;
};

/// How a map is known. One camera and one light cannot separate them.
enum class Origin {
    measured,  ///< read off the frames
    modeled,   ///< follows from the forecast through a stated formula
    assumed,   ///< a constant of the material class
};
struct MapOrigin {
    std::string map;  ///< "albedo", "normal", "roughness", "metallic", "height"
    Origin origin{};
    std::string sentence;
};

/// All that stage 3 needs beside a frame; computed once per specimen.
struct MaterialRecipe {
    MaterialOptions options;
    Image<SrgbF> canvas;  ///< the clean state C: temporal median of the context, unless given
    /// False if the clean state was given: then the observed state carries coverage of its own.
    bool observed_is_clean = true;
    /// Per pixel max(tau, |x(0) - C|): with it, coverage is 0 at horizon 0 and continuous after.
    /// tau itself if the clean state was given.
    Image<float> dead_zone;
    double tau = 0;
    double normalizer = 1;  ///< s of Eq. (2); 1 if nothing changes
    double reference_horizon = 0;
    /// kInside: specimen, covered by Eq. (2). kUnderGlint: specimen that was clipped, coverage 0.
    /// 0: backdrop, coverage 0 and no metal. Empty: kInside everywhere.
    Mask active;
    /// Luma to use where a pixel is clipped (a smooth fill), so that a glint raises no bump;
    /// negative elsewhere.
    Image<float> luma_fill;
};

/// The maps at one horizon. All of one size, all in [0, 1] but `normal`.
struct Material {
    Image<SrgbF> albedo;     ///< the frame itself, encoded sRGB
    Image<Vec3F> normal;     ///< unit, +X right, +Y up (OpenGL), +Z to the viewer
    Image<float> roughness;  ///< perceptual, as glTF
    Image<float> metallic;
    Image<float> height;    ///< 0..1
    Image<float> coverage;  ///< p of Eq. (2)
};

/// Median, dead-zone, normalizer, fill. O(pixels * n log n).
/// `clean_state`, if given, is the surface before it aged (the start of the recording): coverage
/// is then counted from there, and patina that was already observed is not taken for metal.
MaterialRecipe prepare_material(const Context& context, const Forecast& forecast,
                                const MaterialOptions& options = {},
                                const Image<SrgbF>* clean_state = nullptr);

/// Has the specimen visibly left `start`, as seen in the median of the context? True if the mean
/// change over the specimen is above 5 % of full scale and above 2 tau. chosen: 5 % is seen at a
/// glance, and [Paper] Section 4 has its whole recordings move by 12 %.
bool has_left(const Image<SrgbF>& start, const Context& context);

/// The maps of a frame, into `out` (resized if needed, so that scrubbing allocates nothing).
/// One fused pass over rows, SIMD, in parallel; same bytes at any thread count.
void materialize(const MaterialRecipe& recipe, ImageView<const SrgbF> frame, Material& out);
/// frame(h) of the trajectory and its maps in one pass: what scrubbing costs.
void materialize(const MaterialRecipe& recipe, const Trajectory& trajectory, double horizon,
                 Material& out);
/// Any forecast.
void materialize(const MaterialRecipe& recipe, const Forecast& forecast, double horizon,
                 Material& out);

/// What can be said about each map, honestly: of a forecast state, or of the last observed one,
/// whose albedo is a photograph.
enum class MapsOf { forecast, observed };
std::vector<MapOrigin> map_origins(const Forecast& forecast, bool observed_is_clean = true,
                                   MapsOf maps_of = MapsOf::forecast);
std::string to_string(Origin origin);

}  // namespace verdigris
