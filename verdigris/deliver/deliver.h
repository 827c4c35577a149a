// SPDX-License-Identifier: MIT
// A material on disk: texture packs, one GLB with variants, the HTML viewer, a contact sheet, and
// the manifest that says how all of it came to be.
// Path: material -> [deliver].
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "verdigris/forecast/forecast.h"
#include "verdigris/material/material.h"
#include "verdigris/progress.h"
#include "verdigris/status.h"

namespace verdigris {

/// One earlier observed frame, for the contact sheet and the viewer. unit <= 0, 0 is the last.
struct ObservedFrame {
    double unit = 0;
    Image<SrgbF> image;
};

/// Everything a writer may need; owned by the caller.
struct Delivery {
    std::string stem;                 ///< from asset_stem(): "CopperPatinating"
    std::string title;                ///< for people: "copper_patinating"
    std::vector<double> horizons;     ///< increasing, > 0
    const Forecast* forecast = nullptr;
    const MaterialRecipe* recipe = nullptr;
    const Mask* specimen = nullptr;
    std::vector<ObservedFrame> observed;  ///< oldest first; the last has unit 0
    Statuses guards;                  ///< all that fired, for viewer and sheet
    double units_observed = 0;        ///< that the recording spans
    /// Origin and options for the manifest, in order; values are JSON texts.
    std::vector<std::pair<std::string, std::string>> facts;
};

/// A file stem for assets: CamelCase of `name`, without the words by which Blender's Node Wrangler
/// sorts maps ("metal", "base", "col", ...), never empty.
std::string asset_stem(const std::string& name);

/// textures/<Stem>_u010/<Stem>_u010[_2K]_Color.png, _NormalGL, _Roughness, _Metalness,
/// _Displacement (16 bit), _ORM; dx/..._NormalDX; masters16/ 16-bit of each; README.txt with the
/// conventions. One pack per horizon and one for the observed state (u000). "2K" only if true.
/// Returns the files written, relative to `folder`. Throws Error{failed}.
std::vector<std::filesystem::path> write_textures(const Delivery& delivery,
                                                  const std::filesystem::path& folder,
                                                  const Progress& progress = {});

/// One GLB: a flat quad with tangents, KHR_materials_variants, a variant per horizon and one for
/// the observed state, which is also the default. gltf-validator: 0 errors, 0 warnings.
void write_gltf(const Delivery& delivery, const std::filesystem::path& file,
                const Progress& progress = {});

/// The self-contained viewer. Throws Error{failed} if this build has none (built without node).
void write_viewer(const Delivery& delivery, const std::filesystem::path& file,
                  const Progress& progress = {});
bool viewer_is_built_in();

/// Observed and forecast frames in a row, change map, maps, guards in words.
void write_contact_sheet(const Delivery& delivery, const std::filesystem::path& file,
                         const Progress& progress = {});

/// manifest.json: resolved options, input hash, version, noise, guards, per-map origin, files.
void write_manifest(const Delivery& delivery, const std::vector<std::filesystem::path>& files,
                    const std::filesystem::path& file);

}  // namespace verdigris
