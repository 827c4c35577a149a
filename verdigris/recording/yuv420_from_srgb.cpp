// SPDX-License-Identifier: MIT
#include "verdigris/recording/yuv420_from_srgb.h"

#include <cassert>
#include <vector>

#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

// Fixed point with 15 bits behind the point: products of 16-bit numbers, which every processor
// makes eight at a time. Three rounded weights put a code off by 255 x 3 / 2 / 2^15 = 0.012 at
// most.
constexpr int kPoint = 15;

constexpr std::int16_t fixed(double v) {
    const double scaled = v * (1 << kPoint);
    return std::int16_t(scaled < 0 ? scaled - 0.5 : scaled + 0.5);
}

// [BT709] 3.2 to 3.4: Y = kr R + kg G + kb B; Cb = (B - Y) / (2 (1 - kb)); Cr likewise. 8-bit
// codes: 16 + 219 Y, 128 + 224 C.
constexpr double kKr = 0.2126, kKb = 0.0722;
constexpr double kLuma = 219.0 / 255, kChroma = 224.0 / 255;

struct Weights {
    std::int16_t r, g, b;
};
// Green takes the rounding of the others: white is 235 and gray has no chroma, exactly.
constexpr Weights luma_weights() {
    const std::int16_t r = fixed(kLuma * kKr), b = fixed(kLuma * kKb);
    return {r, std::int16_t(fixed(kLuma) - r - b), b};
}
constexpr Weights cb_weights() {
    const std::int16_t r = fixed(-kChroma * kKr / (2 * (1 - kKb))), b = fixed(kChroma / 2);
    return {r, std::int16_t(-r - b), b};
}
constexpr Weights cr_weights() {
    const std::int16_t r = fixed(kChroma / 2), b = fixed(-kChroma * kKb / (2 * (1 - kKr)));
    return {r, std::int16_t(-r - b), b};
}

// A row with its colors apart: what the compiler can make vectors of.
struct Apart {
    explicit Apart(int width)
        : r(std::size_t(width)), g(std::size_t(width)), b(std::size_t(width)) {}
    std::vector<std::uint8_t> r, g, b;
};

void take_apart(const SrgbU8* row, int width, Apart& out) {
    std::uint8_t *r = out.r.data(), *g = out.g.data(), *b = out.b.data();
    for (int x = 0; x < width; ++x) {
        r[x] = row[x].r;
        g[x] = row[x].g;
        b[x] = row[x].b;
    }
}

void luma_row(const Apart& row, int width, std::uint8_t* y) {
    constexpr Weights w = luma_weights();
    constexpr std::int32_t offset = (16 << kPoint) + (1 << (kPoint - 1));
    const std::uint8_t *r = row.r.data(), *g = row.g.data(), *b = row.b.data();
    for (int x = 0; x < width; ++x) {
        y[x] = std::uint8_t((w.r * r[x] + w.g * g[x] + w.b * b[x] + offset) >> kPoint);
    }
}

// Sums of 8 weights around each second column of two rows.
void chroma_sums(const std::vector<std::uint8_t>& above, const std::vector<std::uint8_t>& below,
                 int width, std::vector<std::int16_t>& both, std::int16_t* sums) {
    both[0] = std::int16_t(above[0] + below[0]);  // the edge goes on
    for (int x = 0; x < width; ++x) {
        both[std::size_t(x) + 1] = std::int16_t(above[std::size_t(x)] + below[std::size_t(x)]);
    }
    const std::int16_t* column = both.data();
    for (int x = 0; x < width / 2; ++x, column += 2) {
        sums[x] = std::int16_t(column[0] + 2 * column[1] + column[2]);
    }
}

void chroma_row(const std::int16_t* r, const std::int16_t* g, const std::int16_t* b, int width,
                Weights w, std::uint8_t* out) {
    constexpr int kShift = kPoint + 3;
    constexpr std::int32_t offset = (128 << kShift) + (1 << (kShift - 1));
    for (int x = 0; x < width; ++x) {
        out[x] = std::uint8_t((w.r * r[x] + w.g * g[x] + w.b * b[x] + offset) >> kShift);
    }
}

}  // namespace

void yuv420_from_srgb(ImageView<const SrgbU8> image, const Yuv420Planes& out) {
    assert(image.width() % 2 == 0 && image.height() % 2 == 0);
    const int width = image.width();
    parallel_rows(image.height() / 2, 32, [&](RowRun run) {
        Apart above(width), below(width);
        std::vector<std::int16_t> both(std::size_t(width) + 1);
        const std::size_t half = std::size_t(width / 2);
        std::vector<std::int16_t> r(half), g(half), b(half);
        for (int row = run.begin; row < run.end; ++row) {
            take_apart(image.row(2 * row), width, above);
            take_apart(image.row(2 * row + 1), width, below);
            luma_row(above, width, out.y + 2 * row * out.y_stride);
            luma_row(below, width, out.y + (2 * row + 1) * out.y_stride);
            chroma_sums(above.r, below.r, width, both, r.data());
            chroma_sums(above.g, below.g, width, both, g.data());
            chroma_sums(above.b, below.b, width, both, b.data());
            const std::ptrdiff_t to = row * out.chroma_stride;
            chroma_row(r.data(), g.data(), b.data(), width / 2, cb_weights(), out.cb + to);
            chroma_row(r.data(), g.data(), b.data(), width / 2, cr_weights(), out.cr + to);
        }
    });
}

}  // namespace verdigris
