// SPDX-License-Identifier: MIT
// Planes of known codes, for tests.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <vector>

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"
#include "verdigris/recording/frame_format.h"

namespace verdigris::testing {

inline FrameFormat yuv_format(int width, int height, int shift_x, int shift_y, int bits) {
    FrameFormat format;
    format.model = PixelModel::yuv;
    format.bits = bits;
    format.type = bits > 8 ? SampleType::u16 : SampleType::u8;
    format.chroma_shift_x = shift_x;
    format.chroma_shift_y = shift_y;
    format.chroma_x = 0;
    format.chroma_y = shift_y ? 0.5 : 0;
    format.coded_width = width;
    format.coded_height = height;
    return format;
}

/// Owns one plane per component; `means`: f32 samples whatever the format says, as bins hold them.
class MadePlanes {
  public:
    explicit MadePlanes(const FrameFormat& format, bool means = false)
        : MadePlanes(format, means, {0, 0, format.coded_width, format.coded_height}) {}

    PlaneSet set() const {
        PlaneSet out;
        out.count = format_.model == PixelModel::gray ? 1 : 3;
        for (int c = 0; c < out.count; ++c) {
            const std::size_t i = std::size_t(c);
            out.plane[i] = {reinterpret_cast<const std::byte*>(bytes_[i].data()),
                            std::ptrdiff_t(width_[i]) * sample_bytes(),
                            width_[i],
                            height_[i],
                            1,
                            type_};
        }
        return out;
    }
    void set_code(int component, int x, int y, double code) {
        const std::size_t c = std::size_t(component);
        std::uint8_t* to =
            bytes_[c].data() + (std::size_t(y) * std::size_t(width_[c]) + std::size_t(x)) *
                                   std::size_t(sample_bytes());
        if (type_ == SampleType::u8) {
            *to = std::uint8_t(code);
        } else if (type_ == SampleType::u16) {
            const std::uint16_t v = std::uint16_t(code);
            std::memcpy(to, &v, 2);
        } else {
            const float v = float(code);
            std::memcpy(to, &v, 4);
        }
    }
    double code(int component, int x, int y) const {
        const std::size_t c = std::size_t(component);
        const std::uint8_t* from =
            bytes_[c].data() + (std::size_t(y) * std::size_t(width_[c]) + std::size_t(x)) *
                                   std::size_t(sample_bytes());
        if (type_ == SampleType::u8) return *from;
        std::uint16_t integer = 0;
        float real = 0;
        std::memcpy(&integer, from, 2);
        if (type_ == SampleType::u16) return integer;
        std::memcpy(&real, from, 4);
        return real;
    }
    void fill_random(std::mt19937& random) {
        std::uniform_int_distribution<int> pick(0, (1 << format_.bits) - 1);
        each_sample([&](int c, int x, int y) {
            set_code(c, x, y, pick(random) + (type_ == SampleType::f32 ? 0.25 : 0.0));
        });
    }
    /// Only the samples inside `coded`, as observe/ hands them over.
    MadePlanes part(Rect coded) const {
        MadePlanes out(format_, type_ == SampleType::f32, coded);
        out.each_sample([&](int c, int x, int y) {
            const int left = coded.x >> (c ? format_.chroma_shift_x : 0);
            const int top = coded.y >> (c ? format_.chroma_shift_y : 0);
            out.set_code(c, x, y, code(c, left + x, top + y));
        });
        return out;
    }
    MadePlanes as_means() const {
        MadePlanes out(format_, true);
        out.each_sample([&](int c, int x, int y) { out.set_code(c, x, y, code(c, x, y)); });
        return out;
    }

  private:
    MadePlanes(const FrameFormat& format, bool means, Rect coded)
        : format_(format), type_(means ? SampleType::f32 : format.type) {
        for (int c = 0; c < 3; ++c) {
            const int sx = c ? format.chroma_shift_x : 0, sy = c ? format.chroma_shift_y : 0;
            const auto count = [](int begin, int length, int shift) {
                return ((begin + length + (1 << shift) - 1) >> shift) - (begin >> shift);
            };
            const std::size_t i = std::size_t(c);
            width_[i] = count(coded.x, coded.width, sx);
            height_[i] = count(coded.y, coded.height, sy);
            bytes_[i].resize(std::size_t(width_[i]) * std::size_t(height_[i]) *
                             std::size_t(sample_bytes()));
        }
    }
    int sample_bytes() const {
        return type_ == SampleType::u8 ? 1 : type_ == SampleType::u16 ? 2 : 4;
    }
    template <class Visit>
    void each_sample(Visit visit) const {
        for (int c = 0; c < (format_.model == PixelModel::gray ? 1 : 3); ++c)
            for (int y = 0; y < height_[std::size_t(c)]; ++y)
                for (int x = 0; x < width_[std::size_t(c)]; ++x) visit(c, x, y);
    }

    FrameFormat format_;
    SampleType type_;
    std::array<int, 3> width_{}, height_{};
    std::array<std::vector<std::uint8_t>, 3> bytes_;
};

inline MadePlanes solid_codes(const FrameFormat& format, std::array<int, 3> codes) {
    MadePlanes planes(format);
    const PlaneSet set = planes.set();
    for (int c = 0; c < set.count; ++c) {
        const Plane& plane = set.plane[std::size_t(c)];
        for (int y = 0; y < plane.height; ++y)
            for (int x = 0; x < plane.width; ++x) planes.set_code(c, x, y, codes[std::size_t(c)]);
    }
    return planes;
}

/// Y', Cb, Cr codes of a color, straight from the equations of BT.709/601/2020, rounded.
inline std::array<int, 3> codes_of(const FrameFormat& format, SrgbF color) {
    const double luma =
        format.kr * color.r + (1 - format.kr - format.kb) * color.g + format.kb * color.b;
    const double cb = (color.b - luma) / (2 * (1 - format.kb));
    const double cr = (color.r - luma) / (2 * (1 - format.kr));
    const double top = std::exp2(format.bits) - 1, step = std::exp2(format.bits - 8);
    const double middle = 128 * step;
    if (format.full_range) {
        return {int(std::lround(luma * top)), int(std::lround(middle + cb * top)),
                int(std::lround(middle + cr * top))};
    }
    return {int(std::lround((16 + 219 * luma) * step)), int(std::lround((128 + 224 * cb) * step)),
            int(std::lround((128 + 224 * cr) * step))};
}

inline MadePlanes solid_yuv(const FrameFormat& format, SrgbF color) {
    return solid_codes(format, codes_of(format, color));
}

}  // namespace verdigris::testing
