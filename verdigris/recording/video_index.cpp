// SPDX-License-Identifier: MIT
#include "verdigris/recording/video_index.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace verdigris {

bool is_frame_packet(const VideoContainer& container, const AVPacket& packet) {
    return packet.stream_index == container.stream->index && packet.size > 0;
}

std::int64_t stamp_of(const AVPacket& packet) {
    return packet.pts != AV_NOPTS_VALUE ? packet.pts : packet.dts;
}

int VideoIndex::key_for_frame(int frame) const {
    if (!knows_showing_order) return 0;
    for (int p = packet_of_frame[std::size_t(frame)]; p > 0; --p) {
        // A key frame shown later than `frame` does not do: what precedes it in showing order may
        // build on the group before.
        if (packets[std::size_t(p)].key && packets[std::size_t(p)].frame <= frame) return p;
    }
    return 0;
}

int VideoIndex::next_key(int packet) const {
    int p = packet + 1;
    while (p < int(packets.size()) && !packets[std::size_t(p)].key) ++p;
    return std::min(p, int(packets.size()));
}

VideoIndex index_packets(VideoContainer& container) {
    VideoIndex index;
    bool all_pts = true, any_time = false;
    std::vector<std::int64_t> coded_at;
    const libav::PacketPtr packet = libav::new_packet();
    while (av_read_frame(container.format.get(), packet.get()) >= 0) {
        if (is_frame_packet(container, *packet)) {
            VideoPacket entry;
            entry.stamp = entry.pts = stamp_of(*packet);
            coded_at.push_back(packet->dts);
            entry.pos = packet->pos;
            entry.key = packet->flags & AV_PKT_FLAG_KEY;
            entry.disposable = packet->flags & AV_PKT_FLAG_DISPOSABLE;
            entry.cut = packet->flags & AV_PKT_FLAG_CORRUPT;
            entry.frame = packet->flags & AV_PKT_FLAG_DISCARD ? -1 : 0;  // outside the edit list
            all_pts = all_pts && packet->pts != AV_NOPTS_VALUE;
            any_time = any_time || entry.pts != AV_NOPTS_VALUE;
            index.encrypted = index.encrypted || is_encrypted(*packet);
            index.packets.push_back(entry);
        }
        av_packet_unref(packet.get());
    }
    index.promised = std::max<std::int64_t>(container.stream->nb_frames,
                                            avformat_index_get_entries_count(container.stream));
    index.has_times = any_time;
    index.knows_showing_order = all_pts || container.codec().video_delay == 0;

    for (std::size_t i = 0; i < index.packets.size(); ++i) {
        if (!index.knows_showing_order) index.packets[i].pts = coded_at[i];
        // A stray packet without any time is shown with its predecessor.
        if (index.packets[i].pts == AV_NOPTS_VALUE) {
            index.packets[i].pts = i && any_time ? index.packets[i - 1].pts : std::int64_t(i);
        }
        if (index.packets[i].frame >= 0) index.packet_of_frame.push_back(int(i));
    }
    std::stable_sort(index.packet_of_frame.begin(), index.packet_of_frame.end(), [&](int a, int b) {
        return index.packets[std::size_t(a)].pts < index.packets[std::size_t(b)].pts;
    });
    AVRational base = container.stream->time_base;
    if (!any_time) {
        const AVRational rate = container.stream->avg_frame_rate;
        base = rate.num > 0 && rate.den > 0 ? av_inv_q(rate) : AVRational{1, 1};
    }
    index.tick_seconds = av_q2d(base);
    for (std::size_t f = 0; f < index.packet_of_frame.size(); ++f) {
        VideoPacket& entry = index.packets[std::size_t(index.packet_of_frame[f])];
        entry.frame = int(f);
        const std::int64_t first = index.packets[std::size_t(index.packet_of_frame[0])].pts;
        index.times.push_back(double(entry.pts - first) * index.tick_seconds);
    }
    int last = -1;
    for (VideoPacket& entry : index.packets) entry.settled = last = std::max(last, entry.frame);
    return index;
}

}  // namespace verdigris
