// SPDX-License-Identifier: MIT
// What the tests of this room share: a made delivery whose truth is known, and readers that share
// no code with the writers.
#pragma once

#include <gtest/gtest.h>
#include <libdeflate.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "verdigris/deliver/deliver.h"
#include "verdigris/files/files.h"
#include "verdigris/files/testing.h"

namespace verdigris {

/// Everything a Delivery points to. Not movable: the delivery holds addresses.
struct MadeDelivery {
    Forecast forecast;
    MaterialRecipe recipe;
    Mask specimen;
    Delivery delivery;

    /// A copper-colored picture with texture, a drift that darkens and greens the middle, a
    /// backdrop of one pixel around it and one clipped pixel.
    explicit MadeDelivery(int width = 40, int height = 24, double drift = 1) {
        Image<SrgbF> base(width, height), rate(width, height);
        specimen = Mask(width, height);
        recipe.active = Mask(width, height);
        recipe.dead_zone = Image<float>(width, height);
        recipe.luma_fill = Image<float>(width, height);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const float grain = 0.06f * std::sin(0.9f * float(x)) * std::cos(0.7f * float(y)) +
                                    0.03f * std::sin(2.3f * float(x + 2 * y));
                base(x, y) = {0.62f + grain, 0.42f + grain, 0.33f + grain};
                const bool inside = x > 0 && y > 0 && x < width - 1 && y < height - 1;
                specimen(x, y) = inside ? kInside : 0;
                recipe.active(x, y) = inside ? kInside : 0;
                const float amount = inside ? float(drift) * (0.5f + float(x) / float(width)) : 0;
                rate(x, y) = {-0.006f * amount, 0.001f * amount, 0.0005f * amount};
                recipe.dead_zone(x, y) = 0.01f;
                recipe.luma_fill(x, y) = -1;
            }
        }
        recipe.active(width / 2, height / 2) = 0;
        recipe.luma_fill(width / 2, height / 2) = 0.5f;
        recipe.canvas = base.clone();
        recipe.tau = 0.01;
        recipe.normalizer = 0.1;
        recipe.reference_horizon = 20;
        delivery.observed.push_back({-4, base.clone()});
        delivery.observed.push_back({0, base.clone()});
        forecast.forecaster = "affinergb full order 1";
        forecast.explanation = "It predicted the last 3 frames 40 % better than no change.";
        forecast.context_length = 10;
        forecast.trajectory.base = std::move(base);
        forecast.trajectory.rate = std::move(rate);
        forecast.trajectory.law = {1, 10};
        delivery.stem = asset_stem("copper_patinating");
        delivery.title = "copper_patinating";
        delivery.horizons = {5, 20};
        delivery.units_observed = 98.4;
        delivery.forecast = &forecast;
        delivery.recipe = &recipe;
        delivery.specimen = &specimen;
        delivery.guards = {{"long_horizon", Severity::caution, "Beyond 20 units it is untested."}};
    }
    MadeDelivery(const MadeDelivery&) = delete;
    MadeDelivery& operator=(const MadeDelivery&) = delete;
};

struct PngChunk {
    std::string type;
    std::string data;
};

/// The chunks of a PNG as [PNG] 5.3 lays them out.
inline std::vector<PngChunk> png_chunks(std::string_view png) {
    std::vector<PngChunk> chunks;
    std::size_t at = 8;
    while (at + 12 <= png.size()) {
        std::size_t length = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            length = length << 8 | static_cast<unsigned char>(png[at + k]);
        }
        if (length > png.size() - at - 12) break;
        chunks.push_back(
            {std::string(png.substr(at + 4, 4)), std::string(png.substr(at + 8, length))});
        at += 12 + length;
    }
    return chunks;
}

inline bool has_chunk(const std::vector<PngChunk>& chunks, std::string_view type) {
    for (const PngChunk& chunk : chunks) {
        if (chunk.type == type) return true;
    }
    return false;
}

/// Decodes base64 by searching the alphabet; throws on anything else.
inline std::string decoded_base64(std::string_view text) {
    const std::string_view alphabet =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    unsigned bits = 0;
    int count = 0;
    for (char c : text) {
        if (c == '=') break;
        const std::size_t digit = alphabet.find(c);
        if (digit == std::string_view::npos) throw std::runtime_error("not base64");
        bits = bits << 6 | unsigned(digit);
        count += 6;
        if (count >= 8) {
            count -= 8;
            bytes += char(bits >> count & 255);
        }
    }
    return bytes;
}

/// A blob of docs/VIEWER_DATA.md as numbers, row-major, channels interleaved.
inline std::vector<double> decoded_blob(int width, int height, int channels, double scale,
                                        double offset, std::string_view data) {
    const std::string packed = decoded_base64(data);
    const std::size_t row = std::size_t(width) * std::size_t(channels);
    const std::size_t count = row * std::size_t(height);
    std::vector<std::uint8_t> raw(count * 2);
    const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)>
        decompressor(libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
    std::size_t size = 0;
    if (libdeflate_zlib_decompress(decompressor.get(), packed.data(), packed.size(), raw.data(),
                                   raw.size(), &size) != LIBDEFLATE_SUCCESS ||
        size != raw.size()) {
        throw std::runtime_error("the blob does not hold its pixels");
    }
    std::vector<std::uint16_t> codes(count);
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto c = std::size_t(channels);
        std::uint16_t before = 0;
        if (i % row >= c) {
            before = codes[i - c];
        } else if (i >= row) {
            before = codes[i - row];
        }
        codes[i] = std::uint16_t(before + raw[2 * i] + 256 * raw[2 * i + 1]);
        values[i] = offset + scale * codes[i];
    }
    return values;
}

}  // namespace verdigris
