// SPDX-License-Identifier: MIT
// A still picture under a camera that drifts, as samples whose truth is known. For tests.
#pragma once

#include <cmath>
#include <functional>
#include <utility>

#include "verdigris/observe/drift_correction.h"
#include "verdigris/observe/testing/made_scene.h"

namespace verdigris::testing {

/// A copper plate that darkens by half before a neutral backdrop with a slight gradient.
struct DriftingScene {
    int width = 96, height = 64, samples = 400;
    double backdrop = 0.45, gradient = 0.04, noise = 0, darkening = 0.2;

    bool on_plate(int x, int y) const { return x >= 30 && x < 66 && y >= 18 && y < 48; }
    Mask specimen() const {
        Mask mask(width, height);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) mask(x, y) = on_plate(x, y) ? kInside : 0;
        }
        return mask;
    }
    SrgbF undrifted(int x, int y, int t) const {
        if (on_plate(x, y)) {
            const double left = 1 - darkening * t / samples;
            const double texture = 0.04 * std::sin(0.7 * x + 0.4 * y);
            return {float(0.65 * left + texture), float(0.42 * left + texture),
                    float(0.30 * left + texture)};
        }
        const double v =
            backdrop + gradient * (double(x) / width - 0.5) + 0.5 * gradient * std::sin(0.3 * y);
        return {float(v), float(v), float(v)};
    }
};

/// Any samples, made when they are read.
class FunctionStore final : public SampleStore {
  public:
    using Pixel = std::function<SrgbF(int x, int y, int t)>;
    FunctionStore(int width, int height, int count, Pixel pixel)
        : width_(width), height_(height), count_(count), pixel_(std::move(pixel)) {}
    int count() const override { return count_; }
    int width() const override { return width_; }
    int height() const override { return height_; }
    Image<SrgbF> image(int index) const override {
        Image<SrgbF> out(width_, height_);
        for (int y = 0; y < height_; ++y) {
            for (int x = 0; x < width_; ++x) out(x, y) = pixel_(x, y, index);
        }
        return out;
    }

  private:
    int width_, height_, count_;
    Pixel pixel_;
};

/// The scene seen through gain(t) x + offset(t) per channel, with the scene's noise.
inline std::shared_ptr<const SampleStore> seen_through(
    const DriftingScene& scene, const std::function<ChannelMap(int t)>& camera) {
    return std::make_shared<FunctionStore>(
        scene.width, scene.height, scene.samples, [scene, camera](int x, int y, int t) {
            const SrgbF c = scene.undrifted(x, y, t);
            const ChannelMap m = camera(t);
            const auto key = (std::uint64_t(t) * 4096 + std::uint64_t(y)) * 4096 + std::uint64_t(x);
            const auto channel = [&](std::size_t i, float v) {
                const double e = scene.noise > 0 ? scene.noise * gaussian(3 * key + i) : 0;
                return float(m.gain[i] * double(v) + m.offset[i] + e);
            };
            return SrgbF{channel(0, c.r), channel(1, c.g), channel(2, c.b)};
        });
}

}  // namespace verdigris::testing
