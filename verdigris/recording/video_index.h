// SPDX-License-Identifier: MIT
// All packets of a video stream, from one pass without decoding: which frame each one holds and
// when it is shown. Internal.
#pragma once

#include <cstdint>
#include <vector>

#include "verdigris/recording/video_container.h"

namespace verdigris {

/// One packet, in the order of the file (decoding order).
struct VideoPacket {
    std::int64_t stamp = 0;   ///< as the container gives it: when it is shown, else decoded
    std::int64_t pts = 0;     ///< when it is shown, ticks
    std::int64_t pos = -1;    ///< where it lies in the file, -1 if unknown
    int frame = -1;           ///< its place in showing order; -1: decoded, but never shown
    int settled = -1;         ///< the last frame to be shown of all packets up to this one
    bool key = false;         ///< decoding can begin here
    bool disposable = false;  ///< no other frame builds on it
    bool cut = false;         ///< the file ends inside it, or the container knows it is damaged
};

struct VideoIndex {
    std::vector<VideoPacket> packets;
    std::vector<int> packet_of_frame;
    std::vector<double> times;  ///< seconds from the first frame, by frame
    double tick_seconds = 0;    ///< the resolution of the container's clock
    bool has_times = true;      ///< false: no packet has a time stamp
    /// False: frames are shown in another order than coded and some packets do not say when (AVI
    /// with B-frames). Frames are then counted as they leave the decoder, from the start on.
    bool knows_showing_order = true;
    bool encrypted = false;
    std::int64_t promised = 0;  ///< packets that the container's index announces, 0 if none

    int frame_count() const { return int(packet_of_frame.size()); }
    /// The packet to decode from so that `frame` and all after it come out whole.
    int key_for_frame(int frame) const;
    /// The first key packet after `packet`, or the number of packets.
    int next_key(int packet) const;
};

/// Reads `container` from where it stands (the start) to its end.
VideoIndex index_packets(VideoContainer& container);

/// True for a packet of the stream that holds data: AVI marks a repeated frame by an empty packet,
/// which a decoder would take for the end.
bool is_frame_packet(const VideoContainer& container, const AVPacket& packet);
/// VideoPacket::stamp.
std::int64_t stamp_of(const AVPacket& packet);

}  // namespace verdigris
