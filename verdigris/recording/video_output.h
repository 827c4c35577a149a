// SPDX-License-Identifier: MIT
// A video container under construction, on top of AtomicFile. Internal (FFmpeg types).
#pragma once

#include <cstdint>
#include <exception>
#include <filesystem>
#include <memory>
#include <span>

#include "verdigris/files/atomic_file.h"
#include "verdigris/recording/libav.h"

namespace verdigris {

/// A muxer whose bytes go through AtomicFile, so that a full disk keeps its own sentence and
/// nothing half-written is left.
class VideoOutput {
  public:
    /// `muxer`: FFmpeg's name. Throws Error{failed} naming `target`.
    VideoOutput(const std::filesystem::path& target, const char* muxer);
    VideoOutput(const VideoOutput&) = delete;
    VideoOutput& operator=(const VideoOutput&) = delete;

    AVFormatContext& format() { return *format_; }
    const std::filesystem::path& target() const { return file_.target(); }
    /// Passes on a result of FFmpeg's. Throws Error{failed} naming the target if it is an error or
    /// if a write has failed meanwhile, which muxers do not always tell.
    int check(int result);
    /// Writes the end of the container and moves the file to its target.
    void commit();

  private:
    struct FreeIo {
        void operator()(AVIOContext* p) const {
            av_freep(&p->buffer);
            avio_context_free(&p);
        }
    };
    struct FreeFormat {
        void operator()(AVFormatContext* p) const { avformat_free_context(p); }
    };
    static VideoOutput& self(void* opaque) { return *static_cast<VideoOutput*>(opaque); }
    static std::int64_t seek(void* opaque, std::int64_t offset, int whence);
    int write(std::span<const std::byte> bytes);

    AtomicFile file_;
    std::int64_t position_ = 0, size_ = 0;
    std::exception_ptr failure_;  // of a write: FFmpeg's C code lets no exception through
    std::unique_ptr<AVIOContext, FreeIo> io_;
    std::unique_ptr<AVFormatContext, FreeFormat> format_;
};

}  // namespace verdigris
