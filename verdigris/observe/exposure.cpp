// SPDX-License-Identifier: MIT
#include "verdigris/observe/exposure.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "verdigris/observe/noise.h"

namespace verdigris {
namespace {

constexpr double kTukey = 4.685;  // 95 % efficiency under a Gaussian [Holland1977]
// chosen: a third of the pixels has to agree. A specimen that fills more than half of the frame and
// changes unevenly then does not pass for the light.
constexpr std::size_t kAgree = 3;
constexpr double kSigmaOverThird = 1 / 0.430727;  // derived: a third of a Gaussian lies within this
constexpr int kIterations = 5;                    // chosen: the weights settle in three
constexpr std::size_t kMaxPixels = 5000;          // chosen: of 1 % noise, the gain is exact to 2e-4
constexpr double kLeastShare = 20;                // chosen: a twentieth must be fit to measure on
constexpr float kDark = 0.03f;                    // chosen: below 8 of 255 a ratio is mostly noise

double median_of(std::vector<float>& values) {
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return double(*middle);
}

// The middle of the shortest interval that holds a third of the values: where most of them agree
// best, which need not be where their median is.
double shortest_third(std::vector<float>& values) {
    std::sort(values.begin(), values.end());
    const std::size_t third = std::max<std::size_t>(values.size() / kAgree, 1);
    std::size_t best = 0;
    for (std::size_t i = 0; i + third < values.size(); ++i) {
        if (values[i + third] - values[i] < values[best + third] - values[best]) best = i;
    }
    return double(values[best + third / 2]);
}

double channel_gain(const std::vector<float>& reference, const std::vector<float>& image) {
    std::vector<float> scratch;
    for (std::size_t i = 0; i < image.size(); ++i) scratch.push_back(image[i] / reference[i]);
    double gain = shortest_third(scratch);
    for (int iteration = 0; iteration < kIterations; ++iteration) {
        scratch.clear();
        for (std::size_t i = 0; i < image.size(); ++i) {
            scratch.push_back(float(std::fabs(double(image[i]) - gain * double(reference[i]))));
        }
        const auto third = scratch.begin() + std::ptrdiff_t(scratch.size() / kAgree);
        std::nth_element(scratch.begin(), third, scratch.end());
        // An eighth of an 8-bit step keeps the scale positive on pictures without noise.
        const double scale = std::max(kSigmaOverThird * double(*third), 5e-4);
        double over = 0, under = 0;
        for (std::size_t i = 0; i < image.size(); ++i) {
            const double r = double(reference[i]);
            const double u = (double(image[i]) - gain * r) / (kTukey * scale);
            if (std::fabs(u) >= 1) continue;
            const double weight = (1 - u * u) * (1 - u * u);
            over += weight * double(image[i]) * r;
            under += weight * r * r;
        }
        if (!(under > 0)) break;
        gain = over / under;
    }
    return gain > 0 ? gain : 1;
}

// chosen: 16 x 16 samples; the median of 256 ratios of 3 % noise is good to 0.25 %.
constexpr int kLattice = 16;
// chosen: a step of 3 % is seen by eye, and 8 times the usual step is no auto-exposure drift.
constexpr double kVisibleStep = 0.03, kUnusual = 8;

template <class T>
void read_lattice(const Plane& plane, double black, std::vector<float>& out) {
    for (int j = 0; j < kLattice; ++j) {
        const int y = int((2 * j + 1) * std::int64_t(plane.height) / (2 * kLattice));
        const T* row = reinterpret_cast<const T*>(plane.data + y * plane.stride_bytes);
        for (int i = 0; i < kLattice; ++i) {
            const int x = int((2 * i + 1) * std::int64_t(plane.width) / (2 * kLattice));
            double sum = 0;
            for (int c = 0; c < plane.channels; ++c) sum += double(row[x * plane.channels + c]);
            out.push_back(float(sum / plane.channels - black));
        }
    }
}

}  // namespace

std::optional<Gain> robust_gain(const Image<SrgbF>& reference, const Image<SrgbF>& image,
                                const Mask& where) {
    std::vector<std::size_t> chosen;
    std::size_t asked = 0;
    for (std::size_t i = 0; i < image.pixel_count(); ++i) {
        if (!where.empty() && where.pixels()[i] != kInside) continue;
        ++asked;
        if (is_clipped(reference.pixels()[i]) || is_clipped(image.pixels()[i])) continue;
        chosen.push_back(i);
    }
    const std::size_t stride = chosen.size() / kMaxPixels + 1;
    std::array<double, 3> gain{};
    const std::array<float SrgbF::*, 3> channels{&SrgbF::r, &SrgbF::g, &SrgbF::b};
    for (std::size_t c = 0; c < 3; ++c) {
        std::vector<float> a, b;
        for (std::size_t i = 0; i < chosen.size(); i += stride) {
            const float before = reference.pixels()[chosen[i]].*channels[c];
            if (!(before > kDark)) continue;
            a.push_back(before);
            b.push_back(image.pixels()[chosen[i]].*channels[c]);
        }
        // A black or overexposed backdrop has a few noisy pixels that seem fit to measure on.
        if (a.size() < 16 || kLeastShare * double(a.size() * stride) < double(asked)) {
            return std::nullopt;
        }
        gain[c] = channel_gain(a, b);
    }
    return Gain{gain[0], gain[1], gain[2]};
}

SrgbF apart_from(SrgbF v, const Gain& gain) {
    return {float(double(v.r) / gain.r), float(double(v.g) / gain.g), float(double(v.b) / gain.b)};
}

void JumpWatch::add(const Frame& frame) {
    const Plane& plane = frame.planes.plane[0];
    const bool limited = format_.model != PixelModel::rgb && !format_.full_range;
    const double step = double(1 << std::max(format_.bits - 8, 0));
    const double black = limited ? 16 * step : 0;
    // What white is above black: 219 steps of limited-range video [BT709], not 255.
    const double scale = plane.type == SampleType::f32 ? 1
                         : limited                     ? 219 * step
                                                       : double((1 << format_.bits) - 1);
    now_.clear();
    switch (plane.type) {
        case SampleType::u8:
            read_lattice<std::uint8_t>(plane, black, now_);
            break;
        case SampleType::u16:
            read_lattice<std::uint16_t>(plane, black, now_);
            break;
        case SampleType::f32:
            read_lattice<float>(plane, black, now_);
            break;
    }
    if (last_.size() == now_.size()) {
        const float low = float(double(kDark) * scale), high = float(double(kSaturated) * scale);
        ratios_.clear();
        for (std::size_t i = 0; i < now_.size(); ++i) {
            if (last_[i] > low && last_[i] < high && now_[i] > 0) {
                ratios_.push_back(now_[i] / last_[i]);
            }
        }
        if (ratios_.size() >= 64) steps_.push_back({frame.index, std::log(median_of(ratios_))});
    }
    last_.swap(now_);
}

std::optional<Status> JumpWatch::finding() const {
    if (steps_.size() < 3) return std::nullopt;
    std::vector<float> sizes;
    const Step* largest = &steps_.front();
    for (const Step& step : steps_) {
        sizes.push_back(float(std::fabs(step.log_gain)));
        if (std::fabs(step.log_gain) > std::fabs(largest->log_gain)) largest = &step;
    }
    const double typical = median_of(sizes);
    const double size = std::fabs(largest->log_gain);
    if (size < kVisibleStep || size < kUnusual * typical) return std::nullopt;
    const std::string text = fmt::format(
        "the whole picture gets {:.0f} % {} at once at frame {}; lock exposure and white balance, "
        "or leave that part out",
        100 * std::fabs(std::expm1(largest->log_gain)),
        largest->log_gain > 0 ? "brighter" : "darker", largest->frame);
    return Status{"exposure_jump", Severity::caution, text};
}

}  // namespace verdigris
