// SPDX-License-Identifier: MIT
#include "verdigris/recording/coded_row.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "verdigris/recording/code_scale.h"

namespace verdigris {
namespace {

float unit(float v) {
    return v > 0 ? std::min(v, 1.0f) : 0.0f;  // NaN compares false: 0
}

// `n` samples from x on, which may reach over the ends of the row: there the last sample repeats.
template <class T>
void load_samples(const Plane& plane, int x, int y, int n, float* out) {
    const T* row = reinterpret_cast<const T*>(plane.data + y * plane.stride_bytes);
    const int last = plane.width - 1;
    const int head = std::clamp(-x, 0, n), body = std::clamp(last + 1 - x, head, n);
    for (int i = 0; i < head; ++i) out[i] = float(row[0]);
    for (int i = head; i < body; ++i) out[i] = float(row[x + i]);
    for (int i = body; i < n; ++i) out[i] = float(row[last]);
}

void load(const Plane& plane, int x, int y, int n, float* out) {
    y = std::clamp(y, 0, plane.height - 1);
    switch (plane.type) {
        case SampleType::u8:
            load_samples<std::uint8_t>(plane, x, y, n, out);
            break;
        case SampleType::u16:
            load_samples<std::uint16_t>(plane, x, y, n, out);
            break;
        case SampleType::f32:
            load_samples<float>(plane, x, y, n, out);
            break;
    }
}

template <class T>
void load_interleaved(const Plane& plane, int x, int y, int n, float offset, float gain,
                      SrgbF* out) {
    const T* in = reinterpret_cast<const T*>(plane.data + y * plane.stride_bytes) +
                  std::ptrdiff_t(x) * plane.channels;
    for (int i = 0; i < n; ++i, in += plane.channels) {
        out[i] = {unit((float(in[0]) - offset) * gain), unit((float(in[1]) - offset) * gain),
                  unit((float(in[2]) - offset) * gain)};
    }
}

}  // namespace

CodedRow::CodedRow(const PlaneSet& part, Rect coded, const FrameFormat& format)
    : part_(part), coded_(coded), format_(format) {
    const CodeScale scale(format);
    offset_ = float(scale.offset), gain_ = float(scale.gain);
    chroma_offset_ = float(scale.chroma_offset), chroma_gain_ = float(scale.chroma_gain);
    red_cr_ = float(scale.red_cr), blue_cb_ = float(scale.blue_cb);
    green_cb_ = float(scale.green_cb), green_cr_ = float(scale.green_cr);
}

void CodedRow::read(int x, int y, int n, SrgbF* out) {
    if (n <= 0) return;
    luma_.resize(std::size_t(n));
    cb_.resize(std::size_t(n));
    cr_.resize(std::size_t(n));
    switch (format_.model) {
        case PixelModel::yuv:
            read_yuv(x, y, n, out);
            break;
        case PixelModel::rgb:
            read_rgb(x, y, n, out);
            break;
        case PixelModel::gray:
            read_gray(x, y, n, out);
            break;
    }
}

void CodedRow::read_yuv(int x, int y, int n, SrgbF* out) {
    load(part_.plane[0], x - coded_.x, y - coded_.y, n, luma_.data());
    read_chroma(part_.plane[1], x, y, n, cb_.data());
    read_chroma(part_.plane[2], x, y, n, cr_.data());
    const float *lumas = luma_.data(), *cbs = cb_.data(), *crs = cr_.data();
    for (int i = 0; i < n; ++i) {
        const float luma = (lumas[i] - offset_) * gain_;
        const float cb = (cbs[i] - chroma_offset_) * chroma_gain_;
        const float cr = (crs[i] - chroma_offset_) * chroma_gain_;
        out[i] = {unit(luma + red_cr_ * cr), unit(luma + green_cb_ * cb + green_cr_ * cr),
                  unit(luma + blue_cb_ * cb)};
    }
}

// Linear in both directions between the chroma samples around, each at its true siting.
void CodedRow::read_chroma(const Plane& plane, int x, int y, int n, float* out) {
    const int shift_x = format_.chroma_shift_x, step_x = 1 << shift_x;
    const int shift_y = format_.chroma_shift_y, step_y = 1 << shift_y;
    const int left = coded_.x >> shift_x, top = coded_.y >> shift_y;
    const auto column = [&](int luma_x) {
        return int(std::floor((luma_x - format_.chroma_x) / step_x));
    };
    const int first = column(x), count = column(x + n - 1) + 2 - first;
    const double place = (y - format_.chroma_y) / step_y;
    const int row = int(std::floor(place));
    const float below = float(place - row);

    above_.resize(std::size_t(count));
    load(plane, first - left, row - top, count, above_.data());
    float* samples = above_.data();
    if (below > 0) {
        below_.resize(std::size_t(count));
        load(plane, first - left, row + 1 - top, count, below_.data());
        const float* other = below_.data();
        for (int i = 0; i < count; ++i) samples[i] += (other[i] - samples[i]) * below;
    }
    if (shift_x == 0 && format_.chroma_x == 0) {
        std::copy_n(samples, n, out);
        return;
    }
    // The weight depends on the place within a chroma step only: one loop for each such phase.
    for (int phase = 0; phase < step_x; ++phase) {
        const double offset = (phase - format_.chroma_x) / step_x;
        const int start = ((phase - x) % step_x + step_x) % step_x;  // first such pixel
        const float right = float(offset - std::floor(offset));
        const float* in = samples + (column(x + start) - first);
        for (int i = start, k = 0; i < n; i += step_x, ++k) {
            out[i] = in[k] + (in[k + 1] - in[k]) * right;
        }
    }
}

void CodedRow::read_rgb(int x, int y, int n, SrgbF* out) {
    const int left = x - coded_.x, top = y - coded_.y;
    if (part_.count == 1) {
        switch (part_.plane[0].type) {
            case SampleType::u8:
                return load_interleaved<std::uint8_t>(part_.plane[0], left, top, n, offset_, gain_,
                                                      out);
            case SampleType::u16:
                return load_interleaved<std::uint16_t>(part_.plane[0], left, top, n, offset_, gain_,
                                                       out);
            case SampleType::f32:
                return load_interleaved<float>(part_.plane[0], left, top, n, offset_, gain_, out);
        }
    }
    load(part_.plane[0], left, top, n, luma_.data());
    load(part_.plane[1], left, top, n, cb_.data());
    load(part_.plane[2], left, top, n, cr_.data());
    for (std::size_t i = 0; i < std::size_t(n); ++i) {
        out[i] = {unit((luma_[i] - offset_) * gain_), unit((cb_[i] - offset_) * gain_),
                  unit((cr_[i] - offset_) * gain_)};
    }
}

void CodedRow::read_gray(int x, int y, int n, SrgbF* out) {
    load(part_.plane[0], x - coded_.x, y - coded_.y, n, luma_.data());
    for (std::size_t i = 0; i < std::size_t(n); ++i) {
        const float v = unit((luma_[i] - offset_) * gain_);
        out[i] = {v, v, v};
    }
}

}  // namespace verdigris
