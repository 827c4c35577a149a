// SPDX-License-Identifier: MIT
// Reads photographs in order, a few ahead in parallel. Internal.
#pragma once

#include <deque>
#include <exception>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "verdigris/recording/recording.h"

namespace verdigris {

/// What readers of one folder share: files in the order of time, and what all become.
struct PhotoSequence {
    std::vector<std::filesystem::path> files;
    std::vector<double> times;
    FrameFormat format;  ///< interleaved RGB of the widest sample type in the folder
    int threads = 0;     ///< as RecordingOptions::decode_threads
};

class PhotoReader : public FrameReader {
  public:
    explicit PhotoReader(std::shared_ptr<const PhotoSequence> photos)
        : photos_(std::move(photos)) {}

    bool next(Frame& frame) override;
    void seek(int index) override;
    const DecodeReport& report() const override { return report_; }

  private:
    struct Decoded {
        int index = 0;
        Frame frame;
        std::string broken;          // why it was skipped
        std::exception_ptr failure;  // why nothing can go on
    };
    void read_ahead();
    Decoded decode(int index) const;

    std::shared_ptr<const PhotoSequence> photos_;
    std::deque<Decoded> ahead_;  // frames position_, position_ + 1, ...
    int position_ = 0;
    int depth_ = 1;  // how many to decode at once: doubles while frames are asked for in order
    DecodeReport report_;
};

}  // namespace verdigris
