// SPDX-License-Identifier: MIT
// The three stages and the delivery as the program runs them: `age` calls all of them in a row,
// the stage commands one each, through the same functions and the same result folder.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "arguments.h"
#include "session.h"
#include "verdigris/deliver/deliver.h"
#include "verdigris/files/staged_folder.h"
#include "verdigris/forecast/forecast_io.h"
#include "verdigris/material/material.h"
#include "verdigris/observe/observe.h"

namespace verdigris::cli {

/// Names inside a result folder, in one place.
inline constexpr const char* kObservedFolder = "observed";
inline constexpr const char* kForecastFolder = "forecast";
inline constexpr const char* kMaterialFolder = "material";
inline constexpr const char* kTexturesFolder = "textures";
inline constexpr const char* kGltfFile = "aged.glb";
inline constexpr const char* kViewerFile = "viewer.html";
inline constexpr const char* kSheetFile = "contact_sheet.png";
inline constexpr const char* kManifestFile = "manifest.json";

/// Nothing of the user's is ever replaced. Throws Error{usage} if the output lies in the input, or
/// the input where a result would go; Error{refused} if `output` holds files that are not a result
/// of ours or the result of another recording, unless forced.
void check_output_folder(const std::filesystem::path& output, const std::filesystem::path& input,
                         bool force);

/// The last part of a path, also for "." and "folder/": how a recording is called.
std::string input_name(const std::filesystem::path& input);

/// An observation and the folder it waits in, not yet part of the result; null if it already is.
struct ObservedStage {
    Observation observation;
    std::unique_ptr<StagedFolder> staged;
    void commit() {
        if (staged) staged->commit();
        staged.reset();
    }
};

/// Observes for <output>/observed, or reads what is there if it was made from the same bytes with
/// the same options.
ObservedStage run_observe(Session& session, const std::filesystem::path& input,
                          const std::filesystem::path& output, const ObserveArguments& arguments);

/// Forecasts and applies the guards. Does not write. Throws Error{refused} unless forced.
SavedForecast run_forecast(Session& session, const Observation& observation,
                           const ForecastArguments& arguments);

/// The recipe of stage 3. Tells the user if patina that was already observed counts as patina.
MaterialRecipe run_material(Session& session, const Observation& observation,
                            const SavedForecast& saved, const MaterialArguments& arguments);

/// Everything in `staged`, ready to commit. Returns the manifest as JSON.
Json run_deliver(Session& session, const Observation& observation, const SavedForecast& saved,
                 const MaterialRecipe& recipe, const Json& options, StagedFolder& staged);

/// Writes the recipe and a 16-bit coverage map per horizon into <folder>.
void write_material_stage(const SavedForecast& saved, const MaterialRecipe& recipe,
                          const std::filesystem::path& folder);

/// Throws Error{bad_input} naming the command that makes the missing stage.
void require_stage(const std::filesystem::path& output, const char* folder, const char* command);

/// The options that earlier stages left in the folder; an empty object if there are none.
Json read_options(const std::filesystem::path& folder);
void write_options(const std::filesystem::path& folder, const Json& options);

}  // namespace verdigris::cli
