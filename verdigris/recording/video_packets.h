// SPDX-License-Identifier: MIT
// The packets of a video in the order of the file, each known by its number in the index; can
// begin again at any key packet. Internal (FFmpeg types).
#pragma once

#include <filesystem>

#include "verdigris/recording/video_container.h"
#include "verdigris/recording/video_index.h"

namespace verdigris {

class VideoPackets {
  public:
    /// `index` is of the same file and outlives this object.
    VideoPackets(std::filesystem::path path, const VideoIndex& index);

    /// The next packet; false at the end. Its time stamp is the number of the frame it holds, so
    /// that whatever the decoder does, a decoded frame says which one it is.
    bool read(AVPacket& packet);
    /// The number of the packet that read() gives next.
    int next() const { return next_; }
    /// Makes `packet`, a key packet or 0, the next one. What the container lands on is looked up
    /// in the index; where that fails, the file is read again from its start.
    void seek(int packet);

    const VideoContainer& container() const { return container_; }

  private:
    bool read_raw(AVPacket& packet);
    bool try_seek(int target, int landmark);
    int number_of(const AVPacket& packet) const;

    std::filesystem::path path_;
    const VideoIndex& index_;
    VideoContainer container_;
    libav::PacketPtr held_;  // read while looking where a seek landed
    int next_ = 0;
    bool ended_ = false;
};

}  // namespace verdigris
