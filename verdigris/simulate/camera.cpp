// SPDX-License-Identifier: MIT
#include "verdigris/simulate/camera.h"

#include <cmath>
#include <cstddef>
#include <numbers>

#include "verdigris/color/convert.h"
#include "verdigris/pixels/parallel_rows.h"
#include "verdigris/simulate/camera_row.h"
#include "verdigris/simulate/random.h"

namespace verdigris {
namespace {

// Noise is cut from a tile, from another place in each row of each frame: numbers of exactly
// Gaussian shape at the cost of reading memory. chosen: a million; a row of 1080p then shares a
// piece with a hundredth of the others, shifted, which nothing downstream can see.
constexpr std::size_t kTile = std::size_t(1) << 20;

// Linear light to code values by table. chosen: 2^14 steps, under a fifth of a code in the darkest
// tenth of a percent, where sRGB is steepest, and under a fiftieth above 16 %.
constexpr int kLevels = 1 << 14;

}  // namespace

Camera::Camera(const SimulationSpec& spec) : spec_(spec), tile_(kTile) {
    const double samples = spec_.frames.units / CameraTrack::kNodeUnits;
    const double per_sample = std::max(1.0, spec_.frames.count / samples);
    shot_ = spec_.camera.shot_noise * per_sample;
    read_variance_ = spec_.camera.read_noise * spec_.camera.read_noise * per_sample;
    const Random random(spec_.seed, RandomStream::noise_tile);
    parallel_rows(int(kTile / 1024), 64, [&](RowRun run) {
        for (std::size_t i = std::size_t(run.begin) * 1024; i < std::size_t(run.end) * 1024; ++i)
            tile_[i] = float(random.gaussian(i));
    });
}

template <class Encode>
void Camera::rows(const Image<LinearF>& before, const Image<LinearF>& after, double t,
                  const FrameGains& gains, int index, const Encode& encode) const {
    const int width = before.width(), height = before.height();
    const std::size_t samples = std::size_t(width) * 3;
    const Random offsets(spec_.seed, RandomStream::noise_offset);
    std::vector<float> gain(samples);
    for (std::size_t i = 0; i < samples; ++i) gain[i] = float(gains.linear[i % 3]);
    parallel_rows(height, 32, [&](RowRun run) {
        std::vector<std::int32_t> line(samples);
        for (int y = run.begin; y < run.end; ++y) {
            const double turns = spec_.camera.flicker_bands * y / height + gains.flicker_phase;
            const std::uint64_t place =
                std::uint64_t(index) * std::uint64_t(height) + std::uint64_t(y);
            encode(
                y,
                {.before = &before.row(y)->r,
                 .after = &after.row(y)->r,
                 .gain = gain.data(),
                 .noise = tile_.data() + offsets.bits(place) % (kTile - samples),
                 .samples = samples,
                 .mix = float(t),
                 .band = float(1 + spec_.camera.flicker * std::sin(2 * std::numbers::pi * turns)),
                 .shot = float(shot_),
                 .read = float(read_variance_)},
                line);
        }
    });
}

void Camera::expose(const Image<LinearF>& before, const Image<LinearF>& after, double t,
                    const FrameGains& gains, int index, Image<SrgbU8>& frame) const {
    if (!frame.same_size(before))
        frame = Image<SrgbU8>::for_overwrite(before.width(), before.height());
    static const std::vector<float> curve = [] {
        std::vector<float> values(kLevels);
        for (int i = 0; i < kLevels; ++i)
            values[std::size_t(i)] = srgb_from_linear(float(i) / (kLevels - 1));
        return values;
    }();
    std::array<std::vector<std::uint8_t>, 3> codes;
    for (std::size_t c = 0; c < 3; ++c) {
        codes[c].resize(kLevels);
        const float gain = float(gains.encoded_gain[c]), offset = float(gains.encoded_offset[c]);
        for (std::size_t i = 0; i < kLevels; ++i)
            codes[c][i] = u8_from_unit(curve[i] * gain + offset);
    }
    const std::uint8_t *red = codes[0].data(), *green = codes[1].data(), *blue = codes[2].data();
    rows(before, after, t, gains, index,
         [&](int y, const CameraRow& row, std::vector<std::int32_t>& line) {
             expose_row_levels(row, kLevels, line.data());
             SrgbU8* out = frame.row(y);
             const std::int32_t* level = line.data();
             for (int x = 0; x < frame.width(); ++x, level += 3)
                 out[x] = {red[level[0]], green[level[1]], blue[level[2]]};
         });
}

void Camera::expose(const Image<LinearF>& before, const Image<LinearF>& after, double t,
                    const FrameGains& gains, int index, Image<SrgbU16>& frame) const {
    if (!frame.same_size(before))
        frame = Image<SrgbU16>::for_overwrite(before.width(), before.height());
    rows(before, after, t, gains, index,
         [&](int y, const CameraRow& row, std::vector<std::int32_t>&) {
             std::vector<float> line(row.samples);
             expose_row(row, line.data());
             SrgbU16* out = frame.row(y);
             const auto code = [&](float v, std::size_t c) {
                 return u16_from_unit(srgb_from_linear(v) * float(gains.encoded_gain[c]) +
                                      float(gains.encoded_offset[c]));
             };
             for (std::size_t x = 0, i = 0; i < line.size(); ++x, i += 3)
                 out[x] = {code(line[i], 0), code(line[i + 1], 1), code(line[i + 2], 2)};
         });
}

}  // namespace verdigris
