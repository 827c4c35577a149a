// SPDX-License-Identifier: MIT
#include "verdigris/recording/video_output.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include "verdigris/error.h"

namespace verdigris {
namespace {

// The parameter became const with FFmpeg 7.
#if LIBAVFORMAT_VERSION_MAJOR >= 61
using Bytes = const std::uint8_t*;
#else
using Bytes = std::uint8_t*;
#endif

// chosen: large enough that the calls do not count.
constexpr int kBuffer = 1 << 18;

}  // namespace

VideoOutput::VideoOutput(const std::filesystem::path& target, const char* muxer) : file_(target) {
    libav::be_silent();
    auto* buffer = static_cast<unsigned char*>(av_malloc(kBuffer));
    if (!buffer) throw std::bad_alloc();
    const auto pass_on = [](void* opaque, Bytes bytes, int count) {
        return self(opaque).write(std::as_bytes(std::span(bytes, std::size_t(count))));
    };
    io_.reset(avio_alloc_context(buffer, kBuffer, 1, this, nullptr, pass_on, &VideoOutput::seek));
    if (!io_) {
        av_free(buffer);
        throw std::bad_alloc();
    }
    AVFormatContext* format = nullptr;
    const int made = avformat_alloc_output_context2(&format, nullptr, muxer, nullptr);
    format_.reset(format);
    check(made);
    format_->pb = io_.get();
    // Without BITEXACT the name and version of the library would be written.
    format_->flags |= AVFMT_FLAG_CUSTOM_IO | AVFMT_FLAG_BITEXACT;
    // Where the muxer of MP4 reads back what it wrote, to move the index to the front.
    format_->url = av_strdup(("file:" + file_.temporary().string()).c_str());
    if (!format_->url) throw std::bad_alloc();
}

int VideoOutput::write(std::span<const std::byte> bytes) {
    if (failure_) return AVERROR(EIO);
    try {
        // Beyond the end, where the muxer of MP4 goes to make room for its index in a short file.
        if (position_ > size_) {
            const std::vector<std::byte> gap(std::size_t(position_ - size_));
            file_.write(gap);
            size_ = position_;
        }
        // What lies before the end is overwritten, the rest appended.
        const std::size_t inside =
            std::size_t(std::min(size_ - position_, std::int64_t(bytes.size())));
        if (inside > 0) file_.rewrite(std::size_t(position_), bytes.first(inside));
        if (inside < bytes.size()) file_.write(bytes.subspan(inside));
    } catch (...) {
        failure_ = std::current_exception();
        return AVERROR(EIO);
    }
    position_ += std::int64_t(bytes.size());
    size_ = std::max(size_, position_);
    return int(bytes.size());
}

std::int64_t VideoOutput::seek(void* opaque, std::int64_t offset, int whence) {
    VideoOutput& me = self(opaque);
    if (whence & AVSEEK_SIZE) return me.size_;
    whence &= ~AVSEEK_FORCE;
    if (whence == SEEK_CUR) offset += me.position_;
    if (whence == SEEK_END) offset += me.size_;
    if (offset < 0) return AVERROR(EINVAL);
    return me.position_ = offset;
}

int VideoOutput::check(int result) {
    if (failure_) std::rethrow_exception(failure_);
    if (result < 0) {
        throw Error(ErrorCode::failed, "cannot be written: " + libav::words(result),
                    target().string());
    }
    return result;
}

void VideoOutput::commit() {
    check(av_write_trailer(format_.get()));
    avio_flush(io_.get());
    check(io_->error);
    file_.commit();
}

}  // namespace verdigris
