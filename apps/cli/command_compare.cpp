// SPDX-License-Identifier: MIT
// How different do two pictures look, by every measure that papers quote.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <type_traits>
#include <variant>

#include "commands.h"
#include "learned.h"
#include "verdigris/color/convert.h"
#include "verdigris/error.h"
#include "verdigris/files/image_file.h"
#include "verdigris/files/png.h"
#include "verdigris/metrics/metrics.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris::cli {
namespace fs = std::filesystem;
namespace {

const std::vector<std::string> kMetrics{"flip", "lpips", "ssim", "ms-ssim", "deltae", "psnr"};

struct Arguments {
    std::string reference, test, map, lpips_weights, lpips_net;
    std::vector<std::string> metrics = kMetrics;
    double ppd = kFlipPixelsPerDegree;

    bool wants(const char* metric) const { return std::ranges::count(metrics, metric) > 0; }
};

/// Any picture we read as encoded sRGB; `notes` is told what that cost, by file.
Image<SrgbF> encoded_picture(const std::string& path, Statuses& notes) {
    const ImageFile file = read_image(path);
    notes.insert(notes.end(), file.notes.begin(), file.notes.end());  // each names the file
    Image<SrgbF> out = Image<SrgbF>::for_overwrite(file.info.width, file.info.height);
    const auto convert = [&]<class P>(const Image<P>& image) {
        parallel_rows(image.height(), 32, [&](RowRun run) {
            for (int y = run.begin; y < run.end; ++y) {
                std::transform(image.row(y), image.row(y) + image.width(), out.row(y), [](P c) {
                    if constexpr (std::is_same_v<P, SrgbU8>) return srgb_from_u8(c);
                    if constexpr (std::is_same_v<P, SrgbU16>) return srgb_from_u16(c);
                    if constexpr (std::is_same_v<P, LinearF>) return srgb_from_linear(c);
                });
            }
        });
    };
    std::visit(convert, file.pixels);
    if (std::holds_alternative<Image<LinearF>>(file.pixels))
        notes.push_back({"linear", Severity::info,
                         fs::path(path).filename().string() +
                             ": linear light, compared as the encoded sRGB that it becomes"});
    const auto outside = std::ranges::count_if(out.pixels(), [](const SrgbF& c) {
        return std::min({c.r, c.g, c.b}) < 0 || std::max({c.r, c.g, c.b}) > 1;
    });
    if (outside > 0) {
        notes.push_back({"limited", Severity::caution,
                         fmt::format("{}: {:.3g} % of its pixels lie outside of what a screen "
                                     "shows and are limited to it",
                                     fs::path(path).filename().string(),
                                     100.0 * double(outside) / double(out.pixel_count()))});
    }
    return out;
}

/// Lines of name, value and what the value means; the same results as JSON.
struct Comparison {
    struct Line {
        std::string name, value, meaning;
    };
    std::vector<Line> lines;
    Json metrics = Json::object(), unavailable = Json::object();

    void add(std::string name, std::string value, std::string meaning) {
        lines.push_back({std::move(name), std::move(value), std::move(meaning)});
    }
    void lack(const char* key, const char* name, const std::string& why) {
        metrics[key] = nullptr;
        unavailable[key] = why;
        add(name, "n/a", why);
    }
};

void add_flip(Comparison& out, const FlipResult& r, double ppd) {
    out.metrics["flip"] = {{"mean", r.mean},          {"first_quartile", r.first_quartile},
                           {"median", r.median},      {"third_quartile", r.third_quartile},
                           {"minimum", r.minimum},    {"maximum", r.maximum},
                           {"pixels_per_degree", ppd}};
    const bool usual = std::abs(ppd - kFlipPixelsPerDegree) < 0.005;
    out.add("FLIP", fmt::format("{:.6f}", r.mean),
            fmt::format("lower is closer, 0 identical, 1 the most; seen at {:.2f} pixels per "
                        "degree{}",
                        ppd, usual ? " (0.7 m from a 0.7 m wide 4K screen)" : ""));
    out.add("  quartiles",
            fmt::format("{:.4f} {:.4f} {:.4f}", r.first_quartile, r.median, r.third_quartile),
            "of its map, each pixel weighed by its error");
    out.add("  largest", fmt::format("{:.6f}", r.maximum), "the worst pixel");
}

void add_psnr(Comparison& out, double mse) {
    const bool identical = mse == 0;
    out.metrics["psnr"] = {{"decibels", identical ? Json(nullptr) : Json(psnr_of(mse))},
                           {"identical", identical}};
    out.metrics["mse"] = mse;
    out.add("PSNR", identical ? "identical" : fmt::format("{:.2f} dB", psnr_of(mse)),
            "higher is closer; of encoded values, peak 1");
    out.add("MSE", fmt::format("{:.4g}", mse), "lower is closer, 0 identical; mean over channels");
}

void print(Session& session, const Arguments& a, const Comparison& c, int width, int height) {
    session.say(fmt::format("{} against {}, {} x {} pixels", a.test, a.reference, width, height));
    std::size_t name = 0, value = 0;
    for (const auto& line : c.lines) {
        name = std::max(name, line.name.size());
        value = std::max(value, line.value.size());
    }
    for (const auto& line : c.lines)
        session.say(
            fmt::format("{:<{}}  {:>{}}  {}", line.name, name, line.value, value, line.meaning));
}

void check_map(const Arguments& a) {
    if (a.map.empty()) return;
    if (!a.wants("flip")) throw Error(ErrorCode::usage, "--map draws FLIP: add flip to --metric");
    std::string extension = fs::path(a.map).extension().string();
    for (char& c : extension) c = char(std::tolower(static_cast<unsigned char>(c)));
    if (extension != ".png") throw Error(ErrorCode::usage, "--map is written as a .png", a.map);
    for (const std::string& input : {a.reference, a.test}) {
        std::error_code ignored;
        if (fs::equivalent(a.map, input, ignored))
            throw Error(ErrorCode::usage, "is compared; --map would overwrite it", a.map);
    }
}

void run(Session& session, const Arguments& a) {
    check_map(a);
    const ImageInfo one = read_image_info(a.reference), two = read_image_info(a.test);
    if (one.width != two.width || one.height != two.height) {
        throw Error(ErrorCode::bad_input,
                    fmt::format("has {} x {} pixels and {} has {} x {}: only pictures of one size "
                                "are compared",
                                one.width, one.height, a.test, two.width, two.height),
                    a.reference);
    }
    Statuses notes;
    const Image<SrgbF> reference = encoded_picture(a.reference, notes),
                       test = encoded_picture(a.test, notes);
    Comparison out;
    const Progress progress = session.progress();
    int done = 0;
    const auto wanted = [&](const char* metric) {
        if (!a.wants(metric)) return false;
        report(progress, metric, done++, int(kMetrics.size()));  // where Ctrl-C is heard
        return true;
    };
    std::optional<FlipResult> flipped;
    if (wanted("flip")) {
        flipped = flip(reference, test, {.pixels_per_degree = a.ppd});
        add_flip(out, *flipped, a.ppd);
    }
    if (wanted("lpips")) {
        const LpipsOutcome lpips = lpips_of(a.lpips_weights, a.lpips_net, reference, test);
        if (lpips.distance) {
            out.metrics["lpips"] = {
                {"distance", *lpips.distance}, {"net", lpips.net}, {"version", lpips.version}};
            out.add("LPIPS", fmt::format("{:.6f}", *lpips.distance),
                    fmt::format("lower is closer, 0 identical; version {}, {}", lpips.version,
                                lpips.net));
        } else {
            out.lack("lpips", "LPIPS", lpips.why_not);
        }
    }
    const auto structural = [&](const char* metric, const char* key, const char* name,
                                const char* meaning, auto measure) {
        if (!wanted(metric)) return;
        try {
            const double value = measure(reference, test);
            out.metrics[key] = value;
            out.add(name, fmt::format("{:.6f}", value), meaning);
        } catch (const Error& e) {  // too small for its window
            out.lack(key, name, e.sentence());
        }
    };
    structural("ssim", "ssim", "SSIM", "higher is closer, 1 identical; mean of R, G and B", ssim);
    structural("ms-ssim", "ms_ssim", "MS-SSIM", "the same on five scales", ms_ssim);
    if (wanted("deltae")) {
        const ColorDifference d = color_difference(reference, test);
        out.metrics["ciede2000"] = {{"mean", d.mean}, {"percentile95", d.percentile95}};
        out.add("CIEDE2000", fmt::format("{:.4f}", d.mean),
                "lower is closer, 0 identical; about 1 is just seen side by side");
        out.add("  95 %", fmt::format("{:.4f}", d.percentile95), "of the pixels differ no more");
    }
    if (wanted("psnr")) add_psnr(out, mean_squared_error(reference, test));
    if (!a.map.empty()) write_png(a.map, flip_picture(flipped->map));

    print(session, a, out, reference.width(), reference.height());
    if (!a.map.empty()) session.say(fmt::format("{}: the map of FLIP, black 0, white 1", a.map));
    Json told = Json::array();
    for (const Status& note : notes) {
        session.tell(note);
        told.push_back(note.sentence);
    }
    Json json = {{"reference", a.reference},
                 {"test", a.test},
                 {"width", reference.width()},
                 {"height", reference.height()},
                 {"metrics", out.metrics},
                 {"unavailable", out.unavailable},
                 {"map", a.map.empty() ? Json(nullptr) : Json(a.map)},
                 {"notes", told}};
    session.result(json);
}

}  // namespace

void add_compare(CLI::App& app, Session& session) {
    auto a = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand(
        "compare", "How different do two pictures look? FLIP, LPIPS, SSIM, CIEDE2000, PSNR");
    command->add_option("REFERENCE", a->reference, "A picture: PNG, JPEG, TIFF or OpenEXR")
        ->required();
    command->add_option("TEST", a->test, "Another of the same size")->required();
    command
        ->add_option("--metric", a->metrics,
                     "With commas between: flip, lpips, ssim, ms-ssim, deltae, psnr")
        ->delimiter(',')
        ->check(CLI::IsMember(kMetrics))
        ->capture_default_str();
    command->add_option("--map", a->map, "Write FLIP's map of errors, a .png")
        ->check(CLI::Validator(
            [](std::string& text) { return text.empty() ? "the name is missing" : ""; }, ""));
    command->add_option("--ppd", a->ppd, "Pixels in a degree of the field of view, for FLIP")
        ->check(CLI::Range(kFlipSmallestPpd, kFlipLargestPpd));
    command->add_option("--lpips-weights", a->lpips_weights,
                        "Weights of LPIPS (docs/models/metrics.md says how to make the file)");
    command->add_option("--lpips-net", a->lpips_net, "Which net they must be of")
        ->check(CLI::IsMember({"alex", "vgg", "squeeze"}));
    session.add_options(*command);
    command->callback([a, &session] { session.action = [a](Session& s) { run(s, *a); }; });
}

}  // namespace verdigris::cli
