// SPDX-License-Identifier: MIT
// How the samples of a decoded frame are to be read as color. Binning works on the samples as
// coded (averaging is linear, so it commutes with the matrix); color is made once per bin.
#pragma once

#include <array>
#include <cstddef>

namespace verdigris {

enum class SampleType { u8, u16, f32 };
enum class PixelModel { yuv, rgb, gray };

/// How a code value relates to light. display: BT.709, BT.601, sRGB or unspecified; the code
/// values are shown as they are, which is what every player and browser does.
enum class Transfer { display, linear, gamma22, gamma28, pq, hlg };
enum class Primaries { bt709, bt601_525, bt601_625, bt2020, display_p3 };

/// Coded samples -> encoded sRGB.
struct FrameFormat {
    PixelModel model{PixelModel::rgb};
    SampleType type{SampleType::u8};
    int bits = 8;            ///< significant bits: 8, 10, 12, 16; f32 samples are unit scale
    int fraction_bits = 0;   ///< more of them behind the point: means of frames, not frames
    bool full_range = true;  ///< else 16..235 (16..240 for chroma), scaled to `bits`
    double kr = 0.2126, kb = 0.0722;             ///< luma weights of the YUV matrix
    int chroma_shift_x = 0, chroma_shift_y = 0;  ///< 4:2:0 is 1, 1
    double chroma_x = 0, chroma_y = 0.5;  ///< siting of a chroma sample in luma pixels from the
                                          ///< first luma sample: left-sited 4:2:0 is (0, 0.5)
    Transfer transfer{Transfer::display};
    Primaries primaries{Primaries::bt709};
    int coded_width = 0, coded_height = 0;  ///< before rotation
    int rotation = 0;  ///< degrees clockwise to turn the coded frame for showing
};

/// Samples of one plane. For interleaved RGB there is one plane with three channels.
/// YUV has three planes with one channel each, chroma planes subsampled.
struct Plane {
    const std::byte* data = nullptr;
    std::ptrdiff_t stride_bytes = 0;
    int width = 0, height = 0;  ///< in samples per channel
    int channels = 1;
    SampleType type{SampleType::u8};
};

struct PlaneSet {
    std::array<Plane, 3> plane;
    int count = 0;
};

}  // namespace verdigris
