// SPDX-License-Identifier: MIT
#include "verdigris/forecast/forecast_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "verdigris/color/convert.h"
#include "verdigris/error.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/files/npy.h"
#include "verdigris/files/png.h"
#include "verdigris/files/staged_folder.h"
#include "verdigris/forecast/context_pixels.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr const char* kFormat = "verdigris-forecast/1";
constexpr const char* kManifest = "forecast.json";

std::span<const std::byte> bytes_of(const Image<SrgbF>& image) {
    return std::as_bytes(image.pixels());
}

void write_image(const fs::path& path, const Image<SrgbF>& image) {
    write_npy(path, NpyType::f32, {std::size_t(image.height()), std::size_t(image.width()), 3},
              bytes_of(image));
}

void write_images(const fs::path& path, const std::vector<Image<SrgbF>>& images) {
    const Image<SrgbF>& first = images.front();
    NpyWriter writer(path, NpyType::f32,
                     {std::size_t(first.height()), std::size_t(first.width()), 3});
    for (const Image<SrgbF>& image : images) writer.append(bytes_of(image));
    writer.commit();
}

std::vector<Image<SrgbF>> read_images(const fs::path& path, bool stacked) {
    const NpyFile file(path);
    const auto& shape = file.shape();
    const std::size_t dimensions = stacked ? 4 : 3;
    const auto values = file.values<float>();
    constexpr std::size_t kLargest = 1u << 20;
    if (shape.size() != dimensions || shape.back() != 3 ||
        std::any_of(shape.begin(), shape.end(),
                    [](std::size_t s) { return s == 0 || s > kLargest; })) {
        throw Error(ErrorCode::bad_input,
                    stacked ? "is not a stack of color images (frames, height, width, 3)"
                            : "is not a color image (height, width, 3)",
                    path.string());
    }
    if (std::any_of(values.begin(), values.end(), [](float v) { return !std::isfinite(v); })) {
        throw Error(ErrorCode::bad_input, "holds a value that is not a number", path.string());
    }
    const std::size_t count = stacked ? shape[0] : 1;
    const int height = int(shape[dimensions - 3]), width = int(shape[dimensions - 2]);
    std::vector<Image<SrgbF>> images;
    for (std::size_t i = 0; i < count; ++i) {
        Image<SrgbF> image = Image<SrgbF>::for_overwrite(width, height);
        std::memcpy(static_cast<void*>(image.row(0)), values.data() + i * image.pixel_count() * 3,
                    image.byte_count());
        images.push_back(std::move(image));
    }
    return images;
}

Image<SrgbF> read_one(const fs::path& path) {
    return std::move(read_images(path, false).front());
}

Json guards_json(const Statuses& guards) {
    Json out = Json::array();
    for (const Status& g : guards) {
        out.push_back(
            {{"id", g.id}, {"severity", to_string(g.severity)}, {"sentence", g.sentence}});
    }
    return out;
}

Statuses guards_from(const Json& json) {
    Statuses out;
    for (const Json& g : json) {
        const auto name = g.at("severity").get<std::string>();
        const auto severity = severity_from(name);
        if (!severity) {
            throw Error(ErrorCode::bad_input, "names the unknown severity '" + name + "'",
                        kManifest);
        }
        out.push_back({g.at("id"), *severity, g.at("sentence")});
    }
    return out;
}

Json law_nodes_json(const TimeLaw& law) {
    Json out = Json::array();
    for (const LawNode& n : law.nodes) out.push_back({n.horizon, n.phi, n.phi2});
    return out;
}

/// [[horizon, phi, phi2], ...], of forecasts written before there were any: none.
std::vector<LawNode> law_nodes_from(const Json& json, const fs::path& manifest) {
    std::vector<LawNode> nodes;
    for (const Json& n : json.value("law_nodes", Json::array())) {
        const LawNode node{n.at(0), n.at(1), n.at(2)};
        const bool increases = node.horizon > (nodes.empty() ? 0 : nodes.back().horizon);
        if (!increases || !std::isfinite(node.horizon) || !std::isfinite(node.phi) ||
            !std::isfinite(node.phi2) || n.size() != 3) {
            throw Error(ErrorCode::bad_input,
                        "has a law whose nodes are not increasing horizons with two numbers each",
                        manifest.string());
        }
        nodes.push_back(node);
    }
    return nodes;
}

void require_size(const Image<SrgbF>& image, const Image<SrgbF>& like, const fs::path& path) {
    if (!image.same_size(like)) {
        throw Error(ErrorCode::bad_input, "has another size than base.npy", path.string());
    }
}

Json spread_json(const Spread& spread) {
    if (!spread.known()) return nullptr;
    Json nodes = Json::array();
    for (const SpreadNode& n : spread.nodes) nodes.push_back({n.horizon, n.common, n.own});
    return {{"common", {spread.common.r, spread.common.g, spread.common.b}}, {"nodes", nodes}};
}

/// Of forecasts written before there were any: unknown.
void read_spread(const Json& json, const fs::path& folder, const Image<SrgbF>& like,
                 Spread& spread) {
    if (!json.contains("spread") || json.at("spread").is_null()) return;
    const Json& from = json.at("spread");
    const auto bad = [&] {
        return Error(ErrorCode::bad_input,
                     "has a spread that is not variances at increasing horizons",
                     (folder / kManifest).string());
    };
    const auto variance = [](double v) { return std::isfinite(v) && v >= 0; };
    const auto common = from.at("common").get<std::array<float, 3>>();
    spread.common = {common[0], common[1], common[2]};
    if (!std::ranges::all_of(common, variance)) throw bad();
    for (const Json& n : from.at("nodes")) {
        const SpreadNode node{n.at(0), n.at(1), n.at(2)};
        const double before = spread.nodes.empty() ? 0 : spread.nodes.back().horizon;
        if (!(node.horizon > before) || !std::isfinite(node.horizon) || !variance(node.common) ||
            !variance(node.own))
            throw bad();
        spread.nodes.push_back(node);
    }
    spread.own = read_one(folder / "spread.npy");
    require_size(spread.own, like, folder / "spread.npy");
    for (const SrgbF& p : spread.own.pixels())
        if (p.r < 0 || p.g < 0 || p.b < 0)
            throw Error(ErrorCode::bad_input, "holds a negative variance",
                        (folder / "spread.npy").string());
}

Json manifest_of(const SavedForecast& saved) {
    const Forecast& f = saved.forecast;
    return {{"format", kFormat},
            {"forecaster", f.forecaster},
            {"explanation", f.explanation},
            {"kind", f.is_trajectory() ? "law" : "frames"},
            {"order", f.trajectory.law.order},
            {"law_context", f.trajectory.law.context},
            {"law_nodes", law_nodes_json(f.trajectory.law)},
            {"clamp", f.trajectory.clamp},
            {"spread", spread_json(f.spread)},
            {"stack_horizons", f.stack.horizons},
            {"context_length", f.context_length},
            {"guards", guards_json(f.guards)},
            {"horizons", saved.horizons},
            {"sigma", saved.context.sigma},
            {"tau", saved.context.tau},
            {"specimen", !saved.context.specimen.empty()},
            {"clipped", !saved.context.clipped.empty()},
            {"source_name", saved.source_name},
            {"source_sha256", saved.source_sha256}};
}

void write_picture(const Forecast& forecast, double horizon, const fs::path& path) {
    const Image<SrgbF> frame = forecast.at(horizon);
    Image<SrgbU16> encoded = Image<SrgbU16>::for_overwrite(frame.width(), frame.height());
    parallel_rows(frame.height(), 64, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            for (int x = 0; x < frame.width(); ++x) encoded(x, y) = u16_from_srgb(frame(x, y));
        }
    });
    write_png(path, encoded);
}

Mask read_mask(const fs::path& path, const Image<SrgbF>& like) {
    Mask mask = read_gray_png(path);
    if (!mask.same_size(like)) {
        throw Error(ErrorCode::bad_input, "has another size than base.npy", path.string());
    }
    return mask;
}

void read_law(const Json& json, const fs::path& folder, Trajectory& trajectory) {
    trajectory.law = {json.at("order"), json.at("law_context"),
                      law_nodes_from(json, folder / kManifest)};
    trajectory.clamp = json.at("clamp");
    if (trajectory.law.order < 0 || trajectory.law.order > 2) {
        throw Error(ErrorCode::bad_input, "has an order that is not 0, 1 or 2",
                    (folder / kManifest).string());
    }
    if (trajectory.law.tabulated() && trajectory.law.order != 2) {
        throw Error(ErrorCode::bad_input, "has a law with nodes whose order is not 2",
                    (folder / kManifest).string());
    }
    trajectory.rate = read_one(folder / "rate.npy");
    require_size(trajectory.rate, trajectory.base, folder / "rate.npy");
    if (trajectory.law.order == 2) {
        trajectory.curvature = read_one(folder / "curvature.npy");
        require_size(trajectory.curvature, trajectory.base, folder / "curvature.npy");
    }
}

void read_stack(const Json& json, const fs::path& folder, FrameStack& stack) {
    stack.horizons = json.at("stack_horizons").get<std::vector<double>>();
    stack.frames = read_images(folder / "stack.npy", true);
    if (stack.frames.size() != stack.horizons.size() ||
        !std::is_sorted(stack.horizons.begin(), stack.horizons.end())) {
        throw Error(ErrorCode::bad_input, "does not hold one frame per horizon",
                    (folder / "stack.npy").string());
    }
    require_size(stack.frames.front(), stack.base, folder / "stack.npy");
}

SavedForecast saved_from(const Json& json, const fs::path& folder) {
    if (json.at("format") != kFormat) {
        throw Error(ErrorCode::bad_input, fmt::format("is not of the format {}", kFormat),
                    (folder / kManifest).string());
    }
    SavedForecast saved;
    saved.forecast.forecaster = json.at("forecaster");
    saved.forecast.explanation = json.at("explanation");
    saved.forecast.context_length = json.at("context_length");
    saved.forecast.guards = guards_from(json.at("guards"));
    saved.horizons = json.at("horizons").get<std::vector<double>>();
    saved.source_name = json.at("source_name");
    saved.source_sha256 = json.at("source_sha256");
    Image<SrgbF> base = read_one(folder / "base.npy");
    Context& context = saved.context;
    context.sigma = json.at("sigma");
    context.tau = json.at("tau");
    context.frames = read_images(folder / "context.npy", true);
    require_size(context.frames.front(), base, folder / "context.npy");
    if (json.at("specimen").get<bool>())
        context.specimen = read_mask(folder / "specimen.png", base);
    if (json.at("clipped").get<bool>()) context.clipped = read_mask(folder / "clipped.png", base);
    read_spread(json, folder, base, saved.forecast.spread);
    if (json.at("kind") == "frames") {
        saved.forecast.stack.base = std::move(base);
        read_stack(json, folder, saved.forecast.stack);
    } else {
        saved.forecast.trajectory.base = std::move(base);
        read_law(json, folder, saved.forecast.trajectory);
    }
    return saved;
}

}  // namespace

std::string horizon_label(double horizon) {
    if (!(horizon >= 0) || !std::isfinite(horizon)) {
        throw Error(ErrorCode::usage, "a horizon must be a number of units, 0 or more");
    }
    std::string text = fmt::format("{:07.3f}", horizon);  // 007.500; a thousandth of a unit
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
    std::replace(text.begin(), text.end(), '.', '_');
    return "u" + text;
}

void write_forecast(const SavedForecast& saved, const fs::path& folder) {
    check_context(saved.context);
    const Forecast& forecast = saved.forecast;
    StagedFolder staged(folder);
    const fs::path& to = staged.path();
    write_images(to / "context.npy", saved.context.frames);
    if (!saved.context.specimen.empty()) write_png(to / "specimen.png", saved.context.specimen);
    if (!saved.context.clipped.empty()) write_png(to / "clipped.png", saved.context.clipped);
    if (forecast.is_trajectory()) {
        write_image(to / "base.npy", forecast.trajectory.base);
        write_image(to / "rate.npy", forecast.trajectory.rate);
        if (forecast.trajectory.law.order == 2) {
            write_image(to / "curvature.npy", forecast.trajectory.curvature);
        }
    } else {
        write_image(to / "base.npy", forecast.stack.base);
        write_images(to / "stack.npy", forecast.stack.frames);
    }
    if (forecast.spread.known()) write_image(to / "spread.npy", forecast.spread.own);
    for (double horizon : saved.horizons) {
        write_picture(forecast, horizon, to / ("forecast_" + horizon_label(horizon) + ".png"));
    }
    write_file(to / kManifest,
               manifest_of(saved).dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
    staged.commit(kManifest);
}

SavedForecast read_forecast(const fs::path& folder) {
    const fs::path manifest = folder / kManifest;
    const std::string text = read_text(manifest);
    try {
        return saved_from(Json::parse(text), folder);
    } catch (const Json::exception& e) {
        throw Error(ErrorCode::bad_input, fmt::format("is not a forecast ({})", e.what()),
                    manifest.string());
    }
}

}  // namespace verdigris
