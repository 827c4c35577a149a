// SPDX-License-Identifier: MIT
#include "stages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <system_error>

#include "json_of.h"
#include "learned.h"
#include "verdigris/color/convert.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/files/png.h"
#include "verdigris/forecast/choose.h"
#include "verdigris/forecast/guards.h"
#include "verdigris/material/material_io.h"
#include "verdigris/observe/early_state.h"
#include "verdigris/observe/observation_io.h"

namespace verdigris::cli {
namespace fs = std::filesystem;
namespace {

constexpr const char* kOptionsFile = "options.json";
/// chosen: enough to see the history on the slider, few enough to keep the page small.
constexpr int kObservedFramesShown = 13;
constexpr int kObservedFramesShownLarge = 7;
constexpr std::size_t kLargeImage = 640 * 640;
constexpr double kMuchMemory = 2e9;  // chosen: what a small machine has to spare

constexpr const char* kEntries[] = {kObservedFolder, kForecastFolder, kMaterialFolder,
                                    kTexturesFolder, kGltfFile,       kViewerFile,
                                    kSheetFile,      kManifestFile};

/// The manifest of an earlier run of ours; null if there is none.
Json earlier_manifest(const fs::path& output) {
    std::error_code error;
    if (!fs::is_regular_file(output / kManifestFile, error)) return nullptr;
    const Json json = Json::parse(read_text(output / kManifestFile), nullptr, false);
    const bool ours = json.is_object() && json.contains("format") && json["format"].is_string() &&
                      json["format"].get<std::string>().starts_with("verdigris-manifest/");
    return ours ? json : Json(nullptr);
}

bool is_ours(const fs::path& output) {
    std::error_code error;
    return !earlier_manifest(output).is_null() ||
           fs::is_regular_file(output / kObservedFolder / "observation.json", error);
}

/// Is `inner` `outer`, or under it? Both may not exist yet.
bool lies_in(const fs::path& inner, const fs::path& outer) {
    std::error_code error;
    const fs::path in = fs::weakly_canonical(fs::absolute(inner), error);
    const fs::path out = fs::weakly_canonical(fs::absolute(outer), error);
    return std::mismatch(out.begin(), out.end(), in.begin(), in.end()).first == out.end();
}

std::vector<ObservedFrame> frames_to_show(const Observation& o) {
    const int count = int(o.samples.size());
    const std::size_t pixels = std::size_t(o.width()) * std::size_t(o.height());
    const int most = pixels > kLargeImage ? kObservedFramesShownLarge : kObservedFramesShown;
    const int shown = std::min(count, most);
    std::vector<ObservedFrame> frames;
    for (int i = 0; i < shown; ++i) {
        const int index =
            shown == 1 ? count - 1 : int(std::lround(double(i) * (count - 1) / (shown - 1)));
        const double unit = o.samples[std::size_t(index)].unit - o.samples.back().unit;
        frames.push_back({unit, o.store->image(index)});
    }
    return frames;
}

/// A straight line between two pictures is easy to predict and says nothing: too many of those in
/// the context, and no back-test means anything.
std::optional<Status> interpolated_context(const Observation& o, int length) {
    const int count = int(o.samples.size());
    int made_up = 0;
    for (int i = std::max(count - length, 0); i < count; ++i) {
        made_up += o.samples[std::size_t(i)].interpolated ? 1 : 0;
    }
    if (made_up == 0) return std::nullopt;
    const bool most = 2 * made_up > length;
    return Status{"interpolated_context", most ? Severity::refusal : Severity::caution,
                  fmt::format("{} of the {} units that the forecast is fitted on hold no picture "
                              "and were interpolated{}",
                              made_up, length,
                              most ? ": there is too little to forecast from. Leave the gap out, "
                                     "or use --force"
                                   : "")};
}

/// derived: a frame of the context is 12 bytes per pixel, and the samples it came from are 6 more,
/// mapped. Measured with /usr/bin/time: what comes on top at 2048 x 2048 and 4096 x 4096, where the
/// whole run takes 1.4 and 5.1 GB.
double memory_bytes(const Observation& o, int context) {
    const double pixels = double(o.width()) * double(o.height());
    return pixels * (18.0 * context + 130);
}

/// What decides an observation, beside the input bytes and the program's version.
Json observation_key(const Json& options) {
    return {{"version", VERDIGRIS_VERSION}, {"observe", options}};
}

}  // namespace

void check_output_folder(const fs::path& output, const fs::path& input, bool force) {
    std::error_code error;
    if (fs::is_directory(input, error) && lies_in(output, input)) {
        throw Error(ErrorCode::usage,
                    "the output folder lies inside the input folder; choose another with -o",
                    output.string());
    }
    for (const char* entry : kEntries) {
        if (lies_in(input, output / entry)) {
            throw Error(ErrorCode::usage,
                        "the input would be overwritten by the result; choose another folder "
                        "with -o",
                        (output / entry).string());
        }
    }
    if (!fs::exists(output, error)) return;
    if (!fs::is_directory(output, error)) {
        throw Error(ErrorCode::failed, "is a file, not a folder; choose another with -o",
                    output.string());
    }
    if (is_ours(output)) {
        const Json manifest = earlier_manifest(output);
        const std::string name = manifest.is_null() ? "" : manifest["input"].value("name", "");
        // As the manifest has it: what is not UTF-8 in a name was replaced there.
        const Json asked = Json::parse(
            Json(input_name(input)).dump(-1, ' ', false, Json::error_handler_t::replace));
        if (!force && !name.empty() && name != asked.get<std::string>()) {
            throw Error(ErrorCode::refused,
                        "holds the result of '" + name +
                            "', another recording; choose another "
                            "folder, or --force to replace it",
                        output.string());
        }
        return;
    }
    // Not even --force replaces what is not ours.
    for (const char* entry : kEntries) {
        if (fs::exists(output / entry, error)) {
            throw Error(ErrorCode::refused,
                        fmt::format("holds a '{}' that is not a result of ours; choose another "
                                    "folder",
                                    entry),
                        output.string());
        }
    }
    fs::directory_iterator entries(output, error);
    if (error)
        throw Error(ErrorCode::failed, "cannot be read: " + error.message(), output.string());
    const bool has_foreign =
        std::any_of(fs::begin(entries), fs::end(entries), [](const fs::directory_entry& e) {
            return !e.path().filename().string().starts_with(".partial-");
        });
    if (has_foreign && !force) {
        throw Error(ErrorCode::refused,
                    "the output folder holds other files; choose an empty one or use --force",
                    output.string());
    }
}

std::string input_name(const fs::path& input) {
    std::error_code error;
    const fs::path whole = fs::weakly_canonical(fs::absolute(input), error);
    return (whole.filename().empty() ? whole.parent_path() : whole).filename().string();
}

void require_stage(const fs::path& output, const char* folder, const char* command) {
    std::error_code error;
    if (!fs::is_directory(output, error)) {
        throw Error(ErrorCode::bad_input, "there is no such result folder", output.string());
    }
    if (!fs::is_directory(output / folder, error)) {
        throw Error(ErrorCode::bad_input,
                    fmt::format("has no '{}' yet; run `verdigris {}` first", folder, command),
                    output.string());
    }
}

Json read_options(const fs::path& folder) {
    std::error_code error;
    if (!fs::exists(folder / kOptionsFile, error)) return Json::object();
    Json options = Json::parse(read_text(folder / kOptionsFile), nullptr, false);
    return options.is_object() ? options : Json::object();
}
void write_options(const fs::path& folder, const Json& options) {
    write_file(folder / kOptionsFile,
               options.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

ObservedStage run_observe(Session& session, const fs::path& input, const fs::path& output,
                          const ObserveArguments& arguments) {
    ObserveOptions options = arguments.options();
    const Json key = observation_key(json_of(arguments));
    const Recording recording = open_recording(input, arguments.recording_options());
    const Progress progress = session.progress();
    const std::string hash = recording.sha256(progress);

    const fs::path existing = output / kObservedFolder;
    if (fs::exists(existing / kOptionsFile) && read_options(existing) == key) {
        try {
            Observation found = read_observation(existing);
            if (found.source_sha256 == hash) {
                session.say(fmt::format("observe: same input and options as in {}, kept",
                                        existing.string()));
                return {std::move(found), nullptr};
            }
        } catch (const Error&) {
            session.say("observe: the earlier observation is damaged; observing again");
        }
    }

    auto staged = std::make_unique<StagedFolder>(output);
    const fs::path folder = staged->path() / kObservedFolder;
    fs::create_directories(folder);
    options.store = folder / "samples.npy";
    Observation observation = observe(recording, options, progress);
    observation.source_sha256 = hash;
    write_observation(observation, folder);
    write_options(folder, key);
    return {std::move(observation), std::move(staged)};
}

SavedForecast run_forecast(Session& session, const Observation& observation,
                           const ForecastArguments& arguments) {
    SavedForecast saved;
    saved.horizons = arguments.sorted_horizons();
    saved.source_name = observation.source_name;
    saved.source_sha256 = observation.source_sha256;
    const int length = std::min(arguments.context, int(observation.samples.size()));
    if (const double bytes = memory_bytes(observation, length); bytes > kMuchMemory) {
        session.say(
            fmt::format("  note: {}x{} pixels with a context of {} take about {:.1f} GB of "
                        "memory; a smaller --size or --context takes less",
                        observation.width(), observation.height(), length, bytes / 1e9));
    }
    const bool learned = is_checkpoint(arguments.forecaster);
    const LearnedForecaster chosen =
        learned ? learned_forecaster(arguments.forecaster, saved.horizons, observation)
                : LearnedForecaster{forecaster_by_name(arguments.forecaster, arguments.options()),
                                    arguments.context};
    const Forecaster& forecaster = chosen.forecaster;
    saved.context = context_from(observation, chosen.context);
    if (learned && saved.context.length() < chosen.context) {
        throw Error(ErrorCode::refused,
                    fmt::format("has {} unit steps; this network must see {}",
                                saved.context.length(), chosen.context),
                    observation.source_name);
    }
    report(session.progress(), "forecast", 0, 1);
    saved.forecast = forecaster.forecast(saved.context);
    saved.forecast.guards = check_guards(saved.context, saved.forecast, saved.horizons);
    saved.forecast.guards.insert(saved.forecast.guards.begin(), chosen.notes.begin(),
                                 chosen.notes.end());
    if (const auto status = interpolated_context(observation, saved.context.length())) {
        saved.forecast.guards.insert(saved.forecast.guards.begin(), *status);
    }
    if (!session.force) refuse_if_needed(saved.forecast.guards);
    report(session.progress(), "forecast", 1, 1);
    return saved;
}

MaterialRecipe run_material(Session& session, const Observation& observation,
                            const SavedForecast& saved, const MaterialArguments& arguments) {
    if (arguments.clean_state == "context") {
        return prepare_material(saved.context, saved.forecast, arguments.options);
    }
    const Image<SrgbF> start = early_state(observation);
    if (arguments.clean_state == "auto" && !has_left(start, saved.context)) {
        return prepare_material(saved.context, saved.forecast, arguments.options);
    }
    if (arguments.clean_state == "auto") {
        session.say(
            "  note: the specimen has visibly left the state the recording began in; that "
            "state counts as clean metal (--clean-state context: the last one does)");
    }
    return prepare_material(saved.context, saved.forecast, arguments.options, &start);
}

void write_material_stage(const SavedForecast& saved, const MaterialRecipe& recipe,
                          const fs::path& folder) {
    write_recipe(recipe, folder);
    Material material;
    for (double horizon : saved.horizons) {
        materialize(recipe, saved.forecast, horizon, material);
        Image<std::uint16_t> coverage(material.coverage.width(), material.coverage.height());
        std::transform(material.coverage.pixels().begin(), material.coverage.pixels().end(),
                       coverage.pixels().begin(), u16_from_unit);
        write_png(folder / ("coverage_" + horizon_label(horizon) + ".png"), coverage);
    }
}

Json run_deliver(Session& session, const Observation& observation, const SavedForecast& saved,
                 const MaterialRecipe& recipe, const Json& options, StagedFolder& staged) {
    const Progress progress = session.progress();
    Delivery delivery;
    delivery.title = saved.source_name;
    delivery.stem = asset_stem(fs::path(saved.source_name).stem().string());
    delivery.horizons = saved.horizons;
    delivery.forecast = &saved.forecast;
    delivery.recipe = &recipe;
    delivery.specimen = &observation.specimen;
    delivery.guards = observation.notes;
    delivery.guards.insert(delivery.guards.end(), saved.forecast.guards.begin(),
                           saved.forecast.guards.end());
    for (Status& guard : delivery.guards) guard.sentence = as_sentence(guard.sentence);
    delivery.units_observed = observation.axis.units;
    const Json observed = json_of(observation);
    for (const auto& [name, value] : observed.items()) {
        delivery.facts.emplace_back(name,
                                    value.dump(-1, ' ', false, Json::error_handler_t::replace));
    }
    delivery.facts.emplace_back("options",
                                options.dump(-1, ' ', false, Json::error_handler_t::replace));

    const fs::path& root = staged.path();
    std::vector<fs::path> files;
    for (const fs::path& file : write_textures(delivery, root / kTexturesFolder, progress)) {
        files.push_back(fs::path(kTexturesFolder) / file);
    }
    write_gltf(delivery, root / kGltfFile, progress);
    files.emplace_back(kGltfFile);
    // Only now: the textures need the memory, and show no observed frame.
    delivery.observed = frames_to_show(observation);
    if (viewer_is_built_in()) {
        write_viewer(delivery, root / kViewerFile, progress);
        files.emplace_back(kViewerFile);
    } else {
        session.say(
            "  note: this build has no viewer (built without node); see `verdigris doctor`");
    }
    write_contact_sheet(delivery, root / kSheetFile, progress);
    files.emplace_back(kSheetFile);
    write_manifest(delivery, files, root / kManifestFile);
    return Json::parse(read_text(root / kManifestFile));
}

}  // namespace verdigris::cli
