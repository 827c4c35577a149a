// SPDX-License-Identifier: MIT
#include "verdigris/observe/observation_io.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "verdigris/error.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/files/npy.h"
#include "verdigris/files/png.h"
#include "verdigris/observe/layout_json.h"
#include "verdigris/observe/sample_store.h"

namespace verdigris {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "verdigris-observation";
constexpr int kVersion = 2;  // 2: samples may be stored as the planes they were coded in

Json json_of(Rect r) {
    return Json::array({r.x, r.y, r.width, r.height});
}

Json json_of(const Observation& o) {
    Json j;
    j["format"] = kFormat;
    j["version"] = kVersion;
    j["source"] = {{"name", o.source_name}, {"sha256", o.source_sha256}};
    j["width"] = o.width();
    j["height"] = o.height();
    j["axis"] = {{"units", o.axis.units},
                 {"samples", o.axis.samples},
                 {"samples_per_unit", o.axis.samples_per_unit},
                 {"seconds_per_unit", o.axis.seconds_per_unit}};
    Json samples = Json::array();
    for (const Sample& s : o.samples) {
        samples.push_back({{"unit", s.unit},
                           {"seconds", s.seconds},
                           {"frames", s.frames},
                           {"interpolated", s.interpolated}});
    }
    j["samples"] = samples;
    j["noise"] = {{"sigma", o.noise.sigma}, {"tau", o.noise.tau}, {"tau_given", o.noise.tau_given}};
    j["crop"] = {{"rect", json_of(o.crop.rect)},
                 {"fills_frame", o.crop.fills_frame},
                 {"area_share", o.crop.area_share},
                 {"score_ratio", o.crop.score_ratio},
                 {"sentence", o.crop.sentence}};
    j["decode"] = {{"decoded", o.decode.decoded},
                   {"lost", o.decode.lost},
                   {"first_lost", o.decode.first_lost},
                   {"reason", o.decode.reason}};
    Json notes = Json::array();
    for (const Status& n : o.notes) {
        notes.push_back(
            {{"id", n.id}, {"severity", to_string(n.severity)}, {"sentence", n.sentence}});
    }
    j["notes"] = notes;
    return j;
}

Observation observation_from(const Json& j) {
    Observation o;
    const Json& source = j.at("source");
    o.source_name = source.at("name").get<std::string>();
    o.source_sha256 = source.at("sha256").get<std::string>();
    const Json& axis = j.at("axis");
    o.axis.units = axis.at("units").get<double>();
    o.axis.samples = axis.at("samples").get<int>();
    o.axis.samples_per_unit = axis.at("samples_per_unit").get<int>();
    o.axis.seconds_per_unit = axis.at("seconds_per_unit").get<double>();
    for (const Json& s : j.at("samples")) {
        o.samples.push_back({s.at("unit").get<double>(), s.at("seconds").get<double>(),
                             s.at("frames").get<int>(), s.at("interpolated").get<bool>()});
    }
    const Json& noise = j.at("noise");
    o.noise = {noise.at("sigma").get<double>(), noise.at("tau").get<double>(),
               noise.at("tau_given").get<bool>()};
    const Json& crop = j.at("crop");
    const auto rect = crop.at("rect").get<std::array<int, 4>>();
    o.crop.rect = {rect[0], rect[1], rect[2], rect[3]};
    o.crop.fills_frame = crop.at("fills_frame").get<bool>();
    o.crop.area_share = crop.at("area_share").get<double>();
    o.crop.score_ratio = crop.at("score_ratio").get<double>();
    o.crop.sentence = crop.at("sentence").get<std::string>();
    const Json& decode = j.at("decode");
    o.decode = {decode.at("decoded").get<int>(), decode.at("lost").get<int>(),
                decode.at("first_lost").get<int>(), decode.at("reason").get<std::string>()};
    for (const Json& n : j.at("notes")) {
        const auto name = n.at("severity").get<std::string>();
        const auto severity = severity_from(name);
        if (!severity) {
            throw Error(ErrorCode::bad_input, "names the unknown severity '" + name + "'");
        }
        o.notes.push_back(
            {n.at("id").get<std::string>(), *severity, n.at("sentence").get<std::string>()});
    }
    return o;
}

// Of samples that are in memory or in an unnamed file: always as encoded sRGB.
void write_samples(const Observation& o, const std::filesystem::path& target) {
    NpyWriter writer(target, NpyType::u16,
                     {std::size_t(o.height()), std::size_t(o.width()), std::size_t(3)});
    for (int i = 0; i < o.store->count(); ++i) {
        const Image<SrgbF> image = o.store->image(i);
        SampleCodes codes(3 * image.pixel_count());
        pack_rgb(image, codes);
        writer.append(std::as_bytes(std::span(codes)));
    }
    writer.commit();
}

[[noreturn]] void bad(const std::filesystem::path& file, const std::string& sentence) {
    throw Error(ErrorCode::bad_input, sentence, file.string());
}

// Numbers that later stages divide by or index with.
void check(const Observation& o, const std::filesystem::path& file) {
    const auto finite = [](double v) { return std::isfinite(v); };
    if (o.axis.samples < 1 || o.axis.samples_per_unit < 1 || !(o.axis.units > 0) ||
        !finite(o.axis.units) || !finite(o.axis.seconds_per_unit)) {
        bad(file, "the time axis makes no sense");
    }
    if (!(o.noise.sigma >= 0) || !(o.noise.tau >= 0) || !finite(o.noise.sigma) ||
        !finite(o.noise.tau)) {
        bad(file, "the noise makes no sense");
    }
    for (std::size_t i = 0; i < o.samples.size(); ++i) {
        if (!finite(o.samples[i].unit) || (i > 0 && !(o.samples[i].unit > o.samples[i - 1].unit))) {
            bad(file, "the samples are not in the order of time");
        }
    }
}

Mask read_mask(const std::filesystem::path& file, int width, int height) {
    Mask mask = read_gray_png(file);
    if (!mask.same_size(width, height)) {
        bad(file, "the mask has another size than the samples");
    }
    for (auto& m : mask.pixels()) m = m >= 128 ? kInside : std::uint8_t(0);
    return mask;
}

}  // namespace

void write_observation(const Observation& o, const std::filesystem::path& folder) {
    if (!o.store)
        throw Error(ErrorCode::failed, "the observation holds no samples", folder.string());
    const std::filesystem::path samples = folder / "samples.npy";
    std::error_code ignored;
    const std::filesystem::path behind = path_of(*o.store);
    SampleLayout layout = rgb_layout(o.width(), o.height());
    if (!behind.empty() && std::filesystem::equivalent(behind, samples, ignored)) {
        layout = layout_of(*o.store);
    } else {
        write_samples(o, samples);
    }
    write_png(folder / "specimen.png", o.specimen);
    write_png(folder / "clipped.png", o.clipped);
    // Last, so that a folder with an observation.json is complete.
    Json j = json_of(o);
    j["stored_as"] = json_of(layout);
    write_file(folder / "observation.json",
               j.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

Observation read_observation(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / "observation.json";
    const std::string text = read_text(file);
    Observation o;
    int width = 0, height = 0;
    std::optional<SampleLayout> layout;
    try {
        const Json j = Json::parse(text);
        if (!j.is_object() || j.value("format", "") != kFormat) {
            bad(file, "is not an observation of Verdigris");
        }
        if (j.at("version").get<int>() > kVersion) {
            bad(file, "was written by a newer version of Verdigris");
        }
        width = j.at("width").get<int>();
        height = j.at("height").get<int>();
        o = observation_from(j);
        if (j.contains("stored_as") && j.at("stored_as").at("model") != "srgb") {
            layout = layout_from(j.at("stored_as"));
        }
    } catch (const Error& e) {
        if (!e.where().empty()) throw;
        bad(file, e.sentence());
    } catch (const nlohmann::json::exception& e) {
        bad(file, std::string("cannot be understood: ") + e.what());
    }
    check(o, file);
    const std::filesystem::path samples = folder / "samples.npy";
    o.store = open_samples(samples, layout ? &*layout : nullptr);
    if (o.store->width() != width || o.store->height() != height ||
        o.store->count() != int(o.samples.size())) {
        bad(samples, "has another size than observation.json says");
    }
    o.specimen = read_mask(folder / "specimen.png", width, height);
    o.clipped = read_mask(folder / "clipped.png", width, height);
    return o;
}

}  // namespace verdigris
