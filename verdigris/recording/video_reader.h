// SPDX-License-Identifier: MIT
// Decodes the frames of a video in showing order. Internal (FFmpeg types).
//
// Damage: a frame that a decoder reports as broken is left out, and so is all that builds on it,
// up to the next key frame; a picture with holes filled from elsewhere would pass for the surface.
// Frame threads report an error too late to say which frame it was, so the group of frames in
// which one turns up is decoded again on one thread, and the rest of the file too. There, a frame
// is held back until all that it may build on has left the decoder without a mark of damage.
#pragma once

#include <atomic>
#include <deque>
#include <filesystem>
#include <memory>
#include <string>

#include "verdigris/recording/recording.h"
#include "verdigris/recording/video_format.h"
#include "verdigris/recording/video_packets.h"

namespace verdigris {

/// All that readers of one video share.
struct VideoDescription {
    std::filesystem::path path;
    VideoIndex index;
    VideoFormat color;
    libav::FramePtr first;  ///< the first frame: what all others are held against; null at first
    int threads = 0;        ///< as RecordingOptions::decode_threads
    bool strict = true;     ///< false: its decoder finds fault with every frame, so is not asked to
};

class VideoReader : public FrameReader {
  public:
    explicit VideoReader(std::shared_ptr<const VideoDescription> video);

    bool next(Frame& frame) override;
    void seek(int index) override;
    const DecodeReport& report() const override { return report_; }

    /// next() without planes: for looking at the first frame before `color` is known.
    libav::FramePtr next_picture(int& index);

  private:
    struct Held {
        libav::FramePtr picture;
        int index;
    };
    libav::FramePtr next_in_order(int& index);
    void open(Decoding how);
    bool is_damaged(const AVFrame& picture);
    libav::FramePtr take_held(int& index, bool all);
    void hold(libav::FramePtr picture);
    bool is_left_out(int index) const;
    void resume();
    void feed();
    void send();
    void drain();
    void restart(int key);
    void failed(int packet, const std::string& words);
    void leave_out(int packet, const std::string& words);
    void count_lost(int begin, int end);
    void check_like_first(const AVFrame& picture, int index) const;

    std::shared_ptr<const VideoDescription> video_;
    VideoPackets packets_;
    std::atomic<int> complaints_{0};  // of codec_, see libav.h
    libav::CodecPtr codec_;
    libav::PacketPtr packet_;
    bool careful_;          // no frame threads: an error belongs to the packet sent last
    bool waiting_ = false;  // packet_ is sent as soon as the decoder has been drained
    bool at_end_ = false;
    int errors_in_a_row_ = 0;
    int position_ = 0;  // the frame that next() should give
    int counted_ = 0;   // frames out of the decoder, where the showing order is not known
    std::deque<Held> held_;
    int last_out_ = -1;  // the last frame, in showing order, that left the decoder
    int key_ = 0;        // the packet at which decoding began
    int last_sent_ = -1;
    int broken_ = 0, whole_ = 0;  // packets [broken_, whole_) are damaged or build on damage
    std::string first_damage_;
    DecodeReport report_;
};

}  // namespace verdigris
