// SPDX-License-Identifier: MIT
#include "verdigris/recording/video_reader.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "verdigris/error.h"
#include "verdigris/recording/frame_planes.h"

namespace verdigris {

VideoReader::VideoReader(std::shared_ptr<const VideoDescription> video)
    : video_(std::move(video)),
      packets_(video_->path, video_->index),
      packet_(libav::new_packet()) {
    open(video_->strict ? Decoding::fast : Decoding::lenient);
    careful_ = !video_->strict || only_marks_damage(packets_.container());
}

void VideoReader::open(Decoding how) {
    codec_ = open_decoder(packets_.container(), how, video_->threads, video_->path);
    codec_->opaque = &complaints_;
}

bool VideoReader::next(Frame& frame) {
    int index = -1;
    libav::FramePtr picture = next_picture(index);
    if (!picture) return false;
    check_like_first(*picture, index);
    FramePlanes planes =
        planes_of_frame(std::move(picture), video_->color.format, video_->color.turn.mirrored);
    frame.index = index;
    frame.seconds = video_->index.times[std::size_t(index)];
    frame.planes = planes.planes;
    frame.owner = std::move(planes.owner);
    return true;
}

libav::FramePtr VideoReader::next_picture(int& index) {
    libav::FramePtr picture = next_in_order(index);
    const int found = picture ? index : video_->index.frame_count();
    count_lost(position_, found);
    position_ = picture ? found + 1 : found;
    if (picture) ++report_.decoded;
    return picture;
}

void VideoReader::seek(int index) {
    index = std::clamp(index, 0, video_->index.frame_count());
    if (index == video_->index.frame_count()) {
        at_end_ = true;
    } else {
        const int key = video_->index.key_for_frame(index);
        // Ahead within what is being decoded anyway: the frames between are dropped on the way.
        const bool on_the_way = !at_end_ && index >= position_ && key <= packets_.next();
        if (!on_the_way) restart(key);
    }
    position_ = index;
}

void VideoReader::restart(int key) {
    avcodec_flush_buffers(codec_.get());
    if (waiting_) av_packet_unref(packet_.get());
    packets_.seek(key);
    key_ = whole_ = broken_ = key;
    counted_ = std::max(video_->index.packets[std::size_t(key)].frame, 0);
    waiting_ = at_end_ = false;
    errors_in_a_row_ = 0;
    held_.clear();
    last_out_ = -1;
}

bool VideoReader::is_left_out(int index) const {
    const int packet = video_->index.packet_of_frame[std::size_t(index)];
    return packet >= broken_ && packet < whole_;
}

// The next whole frame at or after position_, or null at the end.
libav::FramePtr VideoReader::next_in_order(int& index) {
    while (true) {
        if (libav::FramePtr picture = take_held(index, at_end_)) return picture;
        if (at_end_) return nullptr;
        libav::FramePtr picture = libav::new_frame();
        const int got = avcodec_receive_frame(codec_.get(), picture.get());
        if (got == AVERROR(EAGAIN)) {
            feed();
        } else if (got == AVERROR_EOF || errors_in_a_row_ > 100) {
            // chosen: 100; a decoder that cannot be drained must not hold us for ever.
            if (libav::FramePtr last = take_held(index, true)) return last;
            resume();
        } else if (got < 0) {
            ++errors_in_a_row_;
            failed(std::max(last_sent_, 0), libav::words(got));
        } else {
            errors_in_a_row_ = 0;
            hold(std::move(picture));
        }
    }
}

// Takes in what the decoder gave, unless it is damaged.
void VideoReader::hold(libav::FramePtr picture) {
    const VideoIndex& all = video_->index;
    const int index = all.knows_showing_order ? int(picture->pts) : counted_++;
    if (picture->pts == AV_NOPTS_VALUE || index < 0 || index >= all.frame_count()) return;
    last_out_ = std::max(last_out_, index);
    if (index < position_ || is_left_out(index)) return;
    if (video_->strict && is_damaged(*picture)) {
        failed(all.packet_of_frame[std::size_t(index)], "parts of it are missing");
        return;
    }
    held_.push_back({std::move(picture), index});
}

// Between frame threads marks get lost, now this one, now that. A complaint is enough there to
// look again carefully, where marks are true: the same frames come out on any number of threads.
bool VideoReader::is_damaged(const AVFrame& picture) {
    if (!careful_) return complaints_ > 0;
    // FFV1 mentions a wrong checksum and hands the frame on unmarked.
    const bool complained = complaints_.exchange(0) > 0;
    return picture.flags & AV_FRAME_FLAG_CORRUPT || picture.decode_error_flags ||
           (complained && codec_->codec_id == AV_CODEC_ID_FFV1);
}

// The first held frame, if nothing that it builds on can turn out to be damaged any more.
libav::FramePtr VideoReader::take_held(int& index, bool all) {
    while (!held_.empty()) {
        Held& first = held_.front();
        const int packet = video_->index.packet_of_frame[std::size_t(first.index)];
        const bool left_out = is_left_out(first.index) || first.index < position_;
        const bool settled = video_->index.packets[std::size_t(packet)].settled <= last_out_;
        if (!left_out && !settled && careful_ && !all) return nullptr;
        libav::FramePtr picture = std::move(first.picture);
        index = first.index;
        held_.pop_front();
        if (!left_out) return picture;
    }
    return nullptr;
}

// The decoder is empty: goes on after damage, or ends.
void VideoReader::resume() {
    errors_in_a_row_ = 0;
    if (!waiting_) {
        at_end_ = true;
        return;
    }
    avcodec_flush_buffers(codec_.get());
    waiting_ = false;
    key_ = packets_.next() - 1;
    counted_ = std::max(video_->index.packets[std::size_t(key_)].frame, 0);
    send();
}

// Sends the next packet that is worth decoding, or asks for the frames still held back.
void VideoReader::feed() {
    const VideoIndex& all = video_->index;
    while (packets_.read(*packet_)) {
        const int number = packets_.next() - 1;
        const VideoPacket& entry = all.packets[std::size_t(number)];
        if (number == whole_ && number > key_) {  // the first whole group after damage
            waiting_ = true;
            drain();
            return;
        }
        // Frames shown before the key frame at which decoding began build on what is not there.
        const bool leads =
            number > key_ && entry.frame >= 0 && entry.frame < all.packets[std::size_t(key_)].frame;
        const bool skip = number < whole_ || leads;
        if (!skip && !entry.cut) {
            send();
            return;
        }
        if (!skip) leave_out(number, {});
        av_packet_unref(packet_.get());
    }
    drain();
}

void VideoReader::send() {
    last_sent_ = packets_.next() - 1;
    const int sent = avcodec_send_packet(codec_.get(), packet_.get());
    av_packet_unref(packet_.get());
    if (sent < 0) failed(last_sent_, libav::words(sent));
}

void VideoReader::drain() {
    avcodec_send_packet(codec_.get(), nullptr);
}

void VideoReader::failed(int packet, const std::string& words) {
    if (careful_) {
        leave_out(packet, words);
        return;
    }
    careful_ = true;
    open(Decoding::careful);
    complaints_ = 0;
    restart(video_->index.key_for_frame(std::min(position_, video_->index.frame_count() - 1)));
}

void VideoReader::leave_out(int packet, const std::string& words) {
    const VideoIndex& all = video_->index;
    const VideoPacket& entry = all.packets[std::size_t(packet)];
    if (!entry.disposable) {
        // Frames leave the decoder late, so news of older damage may follow that of newer.
        const int whole = all.next_key(packet);
        broken_ = broken_ < whole_ && packet < whole_ ? std::min(broken_, packet) : packet;
        whole_ = std::max(whole_, whole);
    }
    if (!first_damage_.empty() || entry.frame < 0) return;
    const std::string frame = "frame " + std::to_string(entry.frame);
    if (entry.cut && packet + 1 == int(all.packets.size())) {
        first_damage_ = "the file ends in the middle of " + frame;
    } else {
        first_damage_ = frame + " is damaged" + (words.empty() ? "" : " (" + words + ")");
    }
}

void VideoReader::count_lost(int begin, int end) {
    if (begin >= end) return;
    report_.lost += end - begin;
    if (report_.first_lost < 0 || begin < report_.first_lost) report_.first_lost = begin;
    report_.reason = !first_damage_.empty()
                         ? first_damage_
                         : "frame " + std::to_string(report_.first_lost) + " holds no picture";
    if (report_.lost > 1) {
        report_.reason +=
            "; " + std::to_string(report_.lost - 1) + " more are damaged or build on a damaged one";
    }
}

// Going on with frames coded in another way would look like a change of the specimen.
void VideoReader::check_like_first(const AVFrame& picture, int index) const {
    const AVFrame& first = *video_->first;
    const auto differ = [](int a, int b, int unspecified) {
        return a != b && a != unspecified && b != unspecified;
    };
    std::string what;
    if (picture.width != first.width || picture.height != first.height) {
        what = "is " + std::to_string(picture.width) + " x " + std::to_string(picture.height) +
               " pixels, but the recording began with " + std::to_string(first.width) + " x " +
               std::to_string(first.height);
    } else if (picture.format != first.format ||
               differ(picture.color_range, first.color_range, AVCOL_RANGE_UNSPECIFIED) ||
               differ(picture.colorspace, first.colorspace, AVCOL_SPC_UNSPECIFIED) ||
               differ(picture.color_trc, first.color_trc, AVCOL_TRC_UNSPECIFIED)) {
        what = "codes its colors in another way than the first frame";
    }
    if (what.empty()) return;
    throw Error(ErrorCode::bad_input, what + "; cut the recording there",
                video_->path.string() + ", frame " + std::to_string(index));
}

}  // namespace verdigris
