// SPDX-License-Identifier: MIT
#include "verdigris/recording/video_packets.h"

#include <cstddef>
#include <utility>

namespace verdigris {

VideoPackets::VideoPackets(std::filesystem::path path, const VideoIndex& index)
    : path_(std::move(path)), index_(index), container_(open_container(path_)) {}

bool VideoPackets::read_raw(AVPacket& packet) {
    while (av_read_frame(container_.format.get(), &packet) >= 0) {
        if (is_frame_packet(container_, packet)) return true;
        av_packet_unref(&packet);
    }
    return false;
}

bool VideoPackets::read(AVPacket& packet) {
    if (next_ >= int(index_.packets.size()) || ended_) return false;
    if (held_) {
        av_packet_move_ref(&packet, held_.get());
        held_.reset();
    } else if (!read_raw(packet)) {
        ended_ = true;  // the file has become shorter since it was indexed
        return false;
    }
    const int frame = index_.packets[std::size_t(next_)].frame;
    packet.pts = frame >= 0 ? frame : AV_NOPTS_VALUE;
    packet.dts = AV_NOPTS_VALUE;
    ++next_;
    return true;
}

int VideoPackets::number_of(const AVPacket& packet) const {
    // By its place in the file; by its time too where several packets share a place or have none.
    int found = -1, alike = 0;
    for (const bool by_time : {false, true}) {
        alike = 0;
        for (std::size_t i = 0; i < index_.packets.size(); ++i) {
            const VideoPacket& entry = index_.packets[i];
            if (entry.pos != packet.pos || (by_time && entry.stamp != stamp_of(packet))) continue;
            found = int(i);
            ++alike;
        }
        if (alike == 1) return found;
    }
    return -1;
}

// Seeks for the time of packet `landmark` and reads on to `target`.
bool VideoPackets::try_seek(int target, int landmark) {
    const std::int64_t pts = index_.packets[std::size_t(landmark)].stamp;
    if (av_seek_frame(container_.format.get(), container_.stream->index, pts,
                      AVSEEK_FLAG_BACKWARD) < 0) {
        return false;
    }
    libav::PacketPtr packet = libav::new_packet();
    if (!read_raw(*packet)) return false;
    int number = number_of(*packet);
    if (number < 0 || number > target) return false;
    for (; number < target; ++number) {
        av_packet_unref(packet.get());
        if (!read_raw(*packet)) return false;
    }
    held_ = std::move(packet);
    next_ = target;
    ended_ = false;
    return true;
}

void VideoPackets::seek(int target) {
    held_.reset();
    if (index_.has_times && target > 0) {
        if (try_seek(target, target)) return;
        // Containers that search by decoding time may land one group late.
        int before = target - 1;
        while (before > 0 && !index_.packets[std::size_t(before)].key) --before;
        if (try_seek(target, before)) return;
    }
    container_ = {};
    container_ = open_container(path_);
    ended_ = false;
    const libav::PacketPtr packet = libav::new_packet();
    for (next_ = 0; next_ < target; ++next_) {
        if (!read_raw(*packet)) {
            ended_ = true;
            return;
        }
        av_packet_unref(packet.get());
    }
}

}  // namespace verdigris
