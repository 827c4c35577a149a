// SPDX-License-Identifier: MIT
// A material on a shape in a studio, as a picture or a video.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "commands.h"
#include "render_source.h"
#include "stages.h"
#include "verdigris/files/image_file.h"
#include "verdigris/files/png.h"
#include "verdigris/recording/recording_writer.h"
#include "verdigris/render/material_folder.h"
#include "verdigris/render/model.h"
#include "verdigris/render/settings.h"
#include "verdigris/render/tone_map.h"

namespace verdigris::cli {
namespace fs = std::filesystem;
namespace {

// chosen: a little still at both ends of an aging, to look at what it began and ended with.
constexpr double kStillShare = 0.1;

struct Arguments {
    std::string input, output, scene = "sphere", light = "studio", motion;
    int size = 1024;
    bool whole = false;
    std::vector<double> horizons;
    double exposure = 0, seconds = 4, fps = 24, tolerance = RenderOptions().tolerance;
};

enum class OutputKind { png, exr, mp4 };

std::string lower_extension(const fs::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension) c = char(std::tolower(static_cast<unsigned char>(c)));
    return extension;
}

OutputKind output_kind(const Arguments& a) {
    const std::string extension = lower_extension(a.output);
    if (extension == ".png") return OutputKind::png;
    if (extension == ".exr") return OutputKind::exr;
    if (extension == ".mp4") return OutputKind::mp4;
    throw Error(ErrorCode::usage, "a rendering is a .png, an .exr (linear light) or an .mp4",
                a.output);
}

void check_new(const fs::path& target, bool force) {
    std::error_code error;
    if (!force && fs::exists(target, error)) {
        throw Error(ErrorCode::refused, "is there already; --force replaces it", target.string());
    }
}

// Not even --force means these: they are what the picture is made of.
void check_no_input(const fs::path& target, const Arguments& a) {
    std::vector<fs::path> inputs{a.light, a.scene};
    if (is_material_folder(a.input)) {
        const std::vector<fs::path> maps = maps_of_material_folder(a.input);
        inputs.insert(inputs.end(), maps.begin(), maps.end());
    }
    for (const fs::path& input : inputs) {
        std::error_code error;
        if (fs::equivalent(target, input, error))
            throw Error(ErrorCode::usage, "is rendered from; -o would overwrite it",
                        target.string());
    }
}

Setting setting_of(const Arguments& a, double aspect) {
    if (const auto kind = scene_kind_from(a.scene)) return make_setting(*kind, aspect);
    const fs::path path = a.scene;
    if (lower_extension(path) != ".glb") {
        throw Error(
            ErrorCode::usage,
            fmt::format("--scene is plate, sphere, drape or a .glb; '{}' is none", a.scene));
    }
    return make_setting(read_model(path));
}

Lighting lighting_of(const Arguments& a) {
    return a.light == "studio" ? studio_lighting() : sky_lighting(read_sky_light(a.light));
}

/// All that stays while materials and angles change.
class Stage {
  public:
    Stage(const Arguments& a, double aspect)
        : setting_(setting_of(a, aspect)), tracer_(setting_.shape), lighting_(lighting_of(a)) {
        options_.width = options_.height = a.size;
        options_.tolerance = a.tolerance;
        // Linear light has no exposure: its noise is judged as it would be developed by default.
        options_.exposure = output_kind(a) == OutputKind::exr ? 0 : a.exposure;
        exposure_ = a.exposure;
    }
    const Setting& setting() const { return setting_; }
    double samples_per_pixel() const {
        return pictures_ > 0 ? double(samples_) / options_.width / options_.height / pictures_ : 0;
    }
    Image<LinearF> light(const SurfaceMaps& maps, double turn, const Progress& progress) {
        const RenderScene scene{&setting_.shape, &tracer_,          &maps, &lighting_,
                                setting_.view,   studio_backdrop(), turn};
        Rendering r = render(scene, options_, progress);
        samples_ += r.samples;
        ++pictures_;
        return std::move(r.light);
    }
    Image<SrgbU8> picture(const SurfaceMaps& maps, double turn, const Progress& progress) {
        return developed(light(maps, turn, progress), exposure_);
    }

  private:
    Setting setting_;
    Tracer tracer_;
    Lighting lighting_;
    RenderOptions options_;
    double exposure_ = 0;
    std::int64_t samples_ = 0;
    int pictures_ = 0;
};

// shot.png, or shot_u010.png where there are several.
fs::path still_path(const Arguments& a, const std::vector<double>& horizons, double horizon) {
    const fs::path path = a.output;
    if (horizons.size() < 2) return path;
    return path.parent_path() /
           (path.stem().string() + "_" + horizon_label(horizon) + path.extension().string());
}

// All are rendered before the first is written: an interrupt leaves nothing.
std::vector<fs::path> write_stills(Session& session, const Arguments& a, const RenderSource& source,
                                   const std::vector<double>& horizons, Stage& stage) {
    std::vector<fs::path> paths;
    std::vector<std::function<void()>> writes;
    for (const double horizon : horizons) {
        const fs::path path = still_path(a, horizons, horizon);
        check_new(path, session.force);
        paths.push_back(path);
    }
    for (std::size_t i = 0; i < horizons.size(); ++i) {
        const SurfaceMaps maps = source.maps(horizons[i]);
        auto light = std::make_shared<Image<LinearF>>(
            stage.light(maps, stage.setting().rest_turn, session.progress()));
        const fs::path& path = paths[i];
        if (output_kind(a) == OutputKind::exr) {
            writes.push_back([path, light] { write_exr(path, light->view()); });
        } else {
            writes.push_back([path, light, exposure = a.exposure] {
                write_png(path, developed(*light, exposure));
            });
        }
    }
    for (const auto& write : writes) write();
    return paths;
}

void write_video(Session& session, const Arguments& a, const RenderSource& source, double horizon,
                 Stage& stage) {
    WriterOptions options;
    options.width = options.height = a.size;
    options.fps = a.fps;
    options.replace = session.force;
    const int frames = std::max(1, int(std::lround(a.seconds * a.fps)));
    const auto writer = write_recording(a.output, options);
    const Progress progress = session.progress();
    std::optional<SurfaceMaps> maps;
    double shown = -1;
    for (int i = 0; i < frames; ++i) {
        const bool aging = a.motion == "aging";
        const double share = frames > 1 ? double(i) / (frames - 1) : 0;
        const double age = std::clamp((share - kStillShare) / (1 - 2 * kStillShare), 0.0, 1.0);
        const double wanted = aging ? horizon * age : horizon;
        if (wanted != shown) maps.emplace(source.maps(wanted));
        shown = wanted;
        const double turn =
            aging ? stage.setting().rest_turn : turntable_turn(stage.setting(), double(i) / frames);
        // The bar counts frames, and an interrupt is heard within one.
        const Progress within = [&](std::string_view stage_name, std::int64_t done,
                                    std::int64_t total) {
            return !progress || progress(stage_name, i * std::int64_t(1000) + 1000 * done / total,
                                         frames * std::int64_t(1000));
        };
        writer->add(stage.picture(*maps, turn, within).view());
    }
    writer->commit();
}

void check(const Arguments& a, const RenderSource& source) {
    const bool video = output_kind(a) == OutputKind::mp4;
    if (!video && !a.motion.empty()) {
        throw Error(ErrorCode::usage, "--motion makes a video: name it, as in -o shot.mp4");
    }
    if (!source.ages() && (!a.horizons.empty() || a.motion == "aging")) {
        throw Error(ErrorCode::usage,
                    "--horizons and --motion aging need a result of `verdigris age`; a folder of "
                    "maps has one age only",
                    a.input);
    }
    // "nan" passes every range.
    for (const auto& [name, value] : {std::pair{"--seconds", a.seconds},
                                      {"--fps", a.fps},
                                      {"--exposure", a.exposure},
                                      {"--noise", a.tolerance}}) {
        if (!std::isfinite(value)) {
            throw Error(ErrorCode::usage, fmt::format("{}: {} is no number", name, value));
        }
    }
    if (video && a.size % 2 != 0) {
        throw Error(ErrorCode::usage,
                    fmt::format("an .mp4 needs an even --size; {} is odd", a.size), a.output);
    }
    if (video && a.horizons.size() > 1) {
        throw Error(ErrorCode::usage, "a video takes one horizon: --motion aging goes up to it");
    }
}

void run(Session& session, Arguments a) {
    output_kind(a);
    const RenderSource source(a.input, a.whole);
    check(a, source);
    if (a.motion.empty()) a.motion = "turntable";
    std::vector<double> horizons = a.horizons;
    if (horizons.empty()) horizons = {source.last_horizon()};
    std::sort(horizons.begin(), horizons.end());
    horizons.erase(std::unique(horizons.begin(), horizons.end()), horizons.end());

    std::set<fs::path> paths;
    for (const double h : horizons) {
        const fs::path path = still_path(a, horizons, h);
        check_no_input(path, a);
        check_new(path, session.force);
        if (!paths.insert(path).second) {
            throw Error(ErrorCode::usage,
                        fmt::format("two of the --horizons would both be {}", path.string()));
        }
    }
    Stage stage(a, source.aspect());
    std::vector<fs::path> written{a.output};
    if (output_kind(a) == OutputKind::mp4) {
        write_video(session, a, source, horizons.back(), stage);
    } else {
        written = write_stills(session, a, source, horizons, stage);
    }
    Json names = Json::array();
    for (const fs::path& path : written) {
        names.push_back(path.string());
        session.say(fmt::format("Look at   {}", path.string()));
    }
    Json result = {{"written", names}, {"scene", a.scene}, {"light", a.light}, {"size", a.size}};
    if (source.ages()) result["horizons"] = horizons;
    result["samples_per_pixel"] = stage.samples_per_pixel();
    session.result(result);
}

}  // namespace

void add_render(CLI::App& app, Session& session) {
    auto a = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("render", "A picture of the material, or a video");
    command
        ->add_option("MATERIAL", a->input,
                     "A result of `verdigris age`, or a folder of maps (OUT/textures/...)")
        ->required();
    command->add_option("-o,--out", a->output, "shot.png, shot.exr (linear light) or shot.mp4")
        ->required();
    command->add_option("--scene", a->scene, "plate, sphere, drape, or a model of yours (.glb)")
        ->capture_default_str();
    command->add_option("--light", a->light, "studio, or surroundings of yours (.exr, 2:1)")
        ->capture_default_str();
    command->add_option("--size", a->size, "Side of the picture in pixels")
        ->check(CLI::Range(16, 8192))
        ->capture_default_str();
    command
        ->add_option("--horizons", a->horizons,
                     "Ages, 0 is now (default: the last of the result). Several pictures have "
                     "them in their names: shot_u010.png")
        ->delimiter(',')
        ->check(CLI::Range(0.0, 1e4));
    command->add_option("--motion", a->motion, "Of a video: turntable (default) or aging")
        ->check(CLI::IsMember({"turntable", "aging"}));
    command->add_option("--seconds", a->seconds, "Of a video")
        ->check(CLI::Range(0.1, 600.0))
        ->capture_default_str();
    command->add_option("--fps", a->fps, "Of a video")
        ->check(CLI::Range(1.0, 120.0))
        ->capture_default_str();
    command->add_option("--exposure", a->exposure, "Stops, brighter or darker")
        ->check(CLI::Range(-10.0, 10.0))
        ->capture_default_str();
    command
        ->add_option("--noise", a->tolerance,
                     "How much a pixel may be off, in codes of 255; less takes longer")
        ->check(CLI::Range(0.05, 64.0))
        ->capture_default_str();
    command->add_flag("--whole", a->whole, "Of a result, the backdrop around the specimen as well");
    command->add_flag("--force", session.force, "Replace what is there");
    session.add_options(*command);
    command->callback([a, &session] { session.action = [a](Session& s) { run(s, *a); }; });
}

}  // namespace verdigris::cli
