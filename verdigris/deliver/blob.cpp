// SPDX-License-Identifier: MIT
#include "verdigris/deliver/blob.h"

#include <libdeflate.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <new>
#include <vector>

#include "verdigris/files/base64.h"

namespace verdigris {
namespace {

// chosen: level 6 is where libdeflate's size curve flattens; a viewer is written once.
constexpr int kLevel = 6;
constexpr double kSteps = 65535;

std::vector<std::byte> zlib(std::span<const std::byte> bytes) {
    const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
        libdeflate_alloc_compressor(kLevel), &libdeflate_free_compressor);
    if (!compressor) throw std::bad_alloc();
    std::vector<std::byte> out(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()));
    out.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), out.data(),
                                        out.size()));
    return out;
}

std::uint16_t quantized(float value, Quantization q) {
    if (!(q.scale > 0)) return 0;
    const double steps = (std::isfinite(value) ? double(value) : 0.0) - q.offset;
    return std::uint16_t(std::clamp(std::floor(steps / q.scale + 0.5), 0.0, kSteps));
}

// `values` of one row, interleaved. Each sample is stored as the difference to its left neighbor
// of the same channel, the first to the one above, the very first to 0.
Blob encode(int width, int height, int channels, const std::function<const float*(int)>& row,
            Quantization q) {
    const std::size_t samples = std::size_t(width) * std::size_t(channels);
    std::vector<std::byte> bytes;
    bytes.reserve(samples * std::size_t(height) * 2);
    std::vector<std::uint16_t> first(std::size_t(channels), 0), left(std::size_t(channels), 0);
    for (int y = 0; y < height; ++y) {
        const float* values = row(y);
        left = first;
        for (std::size_t i = 0; i < samples; ++i) {
            const std::size_t channel = i % std::size_t(channels);
            const std::uint16_t code = quantized(values[i], q);
            const auto delta = std::uint16_t(code - left[channel]);
            bytes.push_back(std::byte(delta & 0xFF));
            bytes.push_back(std::byte(delta >> 8));
            left[channel] = code;
            if (i < std::size_t(channels)) first[channel] = code;
        }
    }
    return {channels, q, base64(zlib(bytes))};
}

}  // namespace

Quantization quantization_of(std::span<const float> values) {
    if (values.empty()) return {};
    const auto finite = [](float v) { return std::isfinite(v) ? v : 0.0f; };
    float low = finite(values.front()), high = low;
    for (float value : values) {
        low = std::min(low, finite(value));
        high = std::max(high, finite(value));
    }
    return {(double(high) - double(low)) / kSteps, double(low)};
}

Blob encode_blob(ImageView<const float> image, Quantization quantization) {
    return encode(
        image.width(), image.height(), 1, [&](int y) { return image.row(y); }, quantization);
}

Blob encode_blob(ImageView<const float> image) {
    Image<float> whole = Image<float>::for_overwrite(image.width(), image.height());
    for (int y = 0; y < image.height(); ++y) {
        std::copy(image.row(y), image.row(y) + image.width(), whole.row(y));
    }
    return encode_blob(whole.view(), quantization_of(whole.pixels()));
}

Blob encode_blob(ImageView<const SrgbF> image) {
    const std::size_t samples = std::size_t(image.width()) * 3;
    std::vector<float> values(samples * std::size_t(image.height()));
    for (int y = 0; y < image.height(); ++y) {
        float* out = values.data() + samples * std::size_t(y);
        for (int x = 0; x < image.width(); ++x) {
            const SrgbF c = image(x, y);
            *out++ = c.r;
            *out++ = c.g;
            *out++ = c.b;
        }
    }
    return encode(
        image.width(), image.height(), 3,
        [&](int y) { return values.data() + samples * std::size_t(y); }, quantization_of(values));
}

}  // namespace verdigris
