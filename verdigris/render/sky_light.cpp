// SPDX-License-Identifier: MIT
#include "verdigris/render/sky_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "verdigris/color/convert.h"
#include "verdigris/error.h"
#include "verdigris/files/image_file.h"
#include "verdigris/pixels/parallel_rows.h"
#include "verdigris/render/vector.h"

namespace verdigris {
namespace {

constexpr float kMostRadiance = 65504;
constexpr int kRowsPerRun = 16;

float held(float v) {
    return std::isfinite(v) ? std::clamp(v, 0.0f, kMostRadiance) : 0.0f;
}

float smooth(float t) {
    return t * t * (3 - 2 * t);
}

// The interval of a cumulative table that u falls into, and where in it.
struct Drawn {
    int index;
    float inside;  // [0, 1]
    float share;   // of the interval
};
Drawn draw(const float* cumulative, int count, float u) {
    const int i = int(std::upper_bound(cumulative, cumulative + count - 1, u) - cumulative);
    const float before = i > 0 ? cumulative[i - 1] : 0, share = cumulative[i] - before;
    return {i, share > 0 ? std::clamp((u - before) / share, 0.0f, 1.0f) : 0.5f, share};
}

Image<LinearF> linear_picture(ImageFile file) {
    if (auto* linear = std::get_if<Image<LinearF>>(&file.pixels)) return std::move(*linear);
    Image<LinearF> out(file.info.width, file.info.height);
    std::visit(
        [&](const auto& image) {
            using Pixel = std::decay_t<decltype(image(0, 0))>;
            for (int y = 0; y < image.height(); ++y) {
                for (int x = 0; x < image.width(); ++x) {
                    if constexpr (std::is_same_v<Pixel, SrgbU8>) {
                        out(x, y) = linear_from_srgb(srgb_from_u8(image(x, y)));
                    } else if constexpr (std::is_same_v<Pixel, SrgbU16>) {
                        out(x, y) = linear_from_srgb(srgb_from_u16(image(x, y)));
                    }
                }
            }
        },
        file.pixels);
    return out;
}

}  // namespace

SkyLight::SkyLight(Image<LinearF> picture) : picture_(std::move(picture)) {
    if (picture_.empty()) throw Error(ErrorCode::usage, "a sky needs a picture with pixels");
    const int width = picture_.width(), height = picture_.height();
    cumulative_ = Image<float>::for_overwrite(width, height);
    std::vector<double> rows(std::size_t(height), 0.0);
    parallel_rows(height, kRowsPerRun, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            for (int x = 0; x < width; ++x) {
                LinearF& c = picture_(x, y);
                c = {held(c.r), held(c.g), held(c.b)};
            }
        }
    });
    parallel_rows(height, kRowsPerRun, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            // Light between texel centers is interpolated: a cell is as bright as the brightest
            // texel that reaches into it, so that no light lies where none is looked for.
            const auto brightness = [&](int x) {
                const int left = x > 0 ? x - 1 : width - 1, right = x + 1 < width ? x + 1 : 0;
                float most = 0;
                for (int row = std::max(y - 1, 0); row <= std::min(y + 1, height - 1); ++row) {
                    for (const int column : {left, x, right}) {
                        most = std::max(most, luminance(picture_(column, row)) *
                                                  (row == y && column == x ? 1.0f : 0.25f));
                    }
                }
                return most;
            };
            const double area = std::cos(kPi * y / height) - std::cos(kPi * (y + 1) / height);
            double sum = 0;
            for (int x = 0; x < width; ++x) {
                sum += double(brightness(x));
                cumulative_(x, y) = float(sum);
            }
            for (int x = 0; x < width; ++x) {
                cumulative_(x, y) =
                    sum > 0 ? float(double(cumulative_(x, y)) / sum) : float(x + 1) / float(width);
            }
            cumulative_(width - 1, y) = 1;
            rows[std::size_t(y)] = sum * area;
        }
    });
    double total = 0, light = 0;
    row_cumulative_.resize(std::size_t(height));
    for (int y = 0; y < height; ++y) {
        total += rows[std::size_t(y)];
        row_cumulative_[std::size_t(y)] = float(total);
        double row = 0;
        for (int x = 0; x < width; ++x) row += double(luminance(picture_(x, y)));
        light += row / width * (std::cos(kPi * y / height) - std::cos(kPi * (y + 1) / height)) / 2;
    }
    if (!(total > 0))
        throw Error(ErrorCode::usage, "a sky that is black everywhere lights nothing");
    for (int y = 0; y < height; ++y) {
        float& at = row_cumulative_[std::size_t(y)];
        at = float(double(at) / total);
    }
    row_cumulative_.back() = 1;
    mean_ = float(light);
}

LinearF SkyLight::radiance(Vec3F d) const {
    if (picture_.empty()) {
        const float t = std::clamp(std::abs(d.y), 0.0f, 1.0f);
        return mix(horizon_, d.y < 0 ? below_ : above_, smooth(t));
    }
    const int width = picture_.width(), height = picture_.height();
    const float u = std::atan2(d.z, d.x) / (2 * kPi) + 0.5f;
    const float v = std::acos(std::clamp(d.y, -1.0f, 1.0f)) / kPi;
    const float x = u * float(width) - 0.5f, y = v * float(height) - 0.5f;
    const float fx = std::floor(x), fy = std::floor(y), tx = x - fx, ty = y - fy;
    const auto column = [&](int i) { return i < 0 ? i + width : i >= width ? i - width : i; };
    const auto row = [&](int i) { return std::clamp(i, 0, height - 1); };
    const int x0 = column(int(fx)), x1 = column(int(fx) + 1);
    const LinearF *top = picture_.row(row(int(fy))), *bottom = picture_.row(row(int(fy) + 1));
    return mix(mix(top[x0], top[x1], tx), mix(bottom[x0], bottom[x1], tx), ty);
}

SkyLight::Sample SkyLight::sample(UnitPoint p) const {
    const int width = picture_.width(), height = picture_.height();
    const Drawn row = draw(row_cumulative_.data(), height, p.y);
    const Drawn column = draw(cumulative_.row(row.index), width, p.x);
    // Even over the area of the cell: even in the cosine of the polar angle.
    const float top = std::cos(kPi * float(row.index) / float(height));
    const float bottom = std::cos(kPi * float(row.index + 1) / float(height));
    const float y = top + (bottom - top) * row.inside;
    const float phi = 2 * kPi * ((float(column.index) + column.inside) / float(width) - 0.5f);
    const float r = std::sqrt(std::max(0.0f, 1 - y * y));
    const float area = (top - bottom) * 2 * kPi / float(width);
    return {{r * std::cos(phi), y, r * std::sin(phi)}, row.share * column.share / area};
}

float SkyLight::pdf(Vec3F d) const {
    if (picture_.empty()) return 0;
    const int width = picture_.width(), height = picture_.height();
    const float u = std::atan2(d.z, d.x) / (2 * kPi) + 0.5f;
    const float v = std::acos(std::clamp(d.y, -1.0f, 1.0f)) / kPi;
    const int x = std::clamp(int(u * float(width)), 0, width - 1);
    const int y = std::clamp(int(v * float(height)), 0, height - 1);
    const auto share = [](const float* c, int i) { return c[i] - (i > 0 ? c[i - 1] : 0); };
    const float area =
        (std::cos(kPi * float(y) / float(height)) - std::cos(kPi * float(y + 1) / float(height))) *
        2 * kPi / float(width);
    return share(row_cumulative_.data(), y) * share(cumulative_.row(y), x) / area;
}

SkyLight read_sky_light(const std::filesystem::path& path) {
    const ImageInfo info = read_image_info(path);
    const auto refuse = [&](const std::string& sentence) {
        throw Error(ErrorCode::bad_input, sentence, path.string());
    };
    if (std::int64_t(info.width) * info.height > kMaxSkyPixels) {
        refuse(fmt::format("has {} x {} pixels; surroundings may have 8192 x 4096", info.width,
                           info.height));
    }
    if (info.width != 2 * info.height) {
        refuse(
            fmt::format("has {} x {} pixels; surroundings are equirectangular, twice as wide as "
                        "high",
                        info.width, info.height));
    }
    try {
        return SkyLight(linear_picture(read_image(path)));
    } catch (const Error& error) {
        if (error.code() != ErrorCode::usage) throw;
        refuse("is black everywhere: it lights nothing");
    }
    throw Error(ErrorCode::failed, "unreachable", path.string());
}

}  // namespace verdigris
