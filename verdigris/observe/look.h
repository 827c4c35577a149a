// SPDX-License-Identifier: MIT
// A look at up to 64 frames, small, before the recording is streamed: enough to find the specimen
// and to judge the light.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "verdigris/color/pixel_types.h"
#include "verdigris/observe/observe.h"
#include "verdigris/pixels/image.h"
#include "verdigris/progress.h"
#include "verdigris/recording/recording.h"

namespace verdigris {

/// chosen: the medians of the first and last four and a robust scale need no more.
inline constexpr int kMaxLooks = 64;
/// Long side of a look. chosen: the specimen's outline to 1/480 of the frame.
inline constexpr int kLookSide = 480;

struct Look {
    std::vector<Image<SrgbF>> frames;  ///< of one size, long side <= kLookSide, in order
    std::vector<int> index;            ///< which frame each one is
    int frame_width = 0, frame_height = 0;
    int decodable = 0;  ///< frames of the recording up to the last one that decodes
};

/// Which frames to look at. Photographs: evenly spaced. Videos: a jump costs half a group of
/// pictures, so few places are looked at, four frames in a row at the first and the last, such
/// that the look stays near 4 % of the decoding.
std::vector<int> look_indices(RecordingKind kind, int frames);

/// Called with each frame looked at, at full size.
using LookVisitor = std::function<void(const Frame& frame, const Image<SrgbF>& shown)>;

/// Throws Error{bad_input} naming the recording if no frame decodes.
Look look_at(const Recording& recording, const Progress& progress, const LookVisitor& visit = {});

/// `count` of [0, of), evenly spaced from the first to the last.
std::vector<int> evenly(int of, int count);
/// The picture at the size of a look.
Image<SrgbF> look_sized(const Image<SrgbF>& shown);

}  // namespace verdigris
