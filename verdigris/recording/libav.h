// SPDX-License-Identifier: MIT
// FFmpeg's C handles as owners. Internal: no public header of this room includes it.
#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/dict.h>
#include <libavutil/error.h>
#include <libavutil/log.h>
}

#include <array>
#include <atomic>
#include <cstdarg>
#include <cstring>
#include <memory>
#include <mutex>
#include <new>
#include <string>

namespace verdigris::libav {

struct CloseFormat {
    void operator()(AVFormatContext* p) const { avformat_close_input(&p); }
};
struct FreeCodec {
    void operator()(AVCodecContext* p) const { avcodec_free_context(&p); }
};
struct FreePacket {
    void operator()(AVPacket* p) const { av_packet_free(&p); }
};
struct FreeFrame {
    void operator()(AVFrame* p) const { av_frame_free(&p); }
};
using FormatPtr = std::unique_ptr<AVFormatContext, CloseFormat>;
using CodecPtr = std::unique_ptr<AVCodecContext, FreeCodec>;
using PacketPtr = std::unique_ptr<AVPacket, FreePacket>;
using FramePtr = std::unique_ptr<AVFrame, FreeFrame>;

inline PacketPtr new_packet() {
    PacketPtr packet(av_packet_alloc());
    if (!packet) throw std::bad_alloc();
    return packet;
}

inline FramePtr new_frame() {
    FramePtr frame(av_frame_alloc());
    if (!frame) throw std::bad_alloc();
    return frame;
}

/// FFmpeg's own words for an error number.
inline std::string words(int error) {
    std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
    av_strerror(error, text.data(), text.size());
    return text.data();
}

/// FFmpeg's log, unprinted. What a decoder says of errors is counted in the
/// std::atomic<int> that its `opaque` points to: some damage is only ever mentioned there.
inline void take_log(void* who, int level, const char* text, va_list) {
    // "concealing 20 DC, 20 AC ...": the only trace of some holes, and said as mere information.
    const bool concealed =
        level == AV_LOG_INFO && text && std::strncmp(text, "concealing", 10) == 0;
    if (!who || (level > AV_LOG_ERROR && !concealed)) return;
    if (*static_cast<const AVClass* const*>(who) != avcodec_get_class()) return;
    if (void* count = static_cast<AVCodecContext*>(who)->opaque) {
        ++*static_cast<std::atomic<int>*>(count);
    }
}

/// The library never prints, so neither may the codecs.
inline void be_silent() {
    static std::once_flag once;
    std::call_once(once, [] { av_log_set_callback(take_log); });
}

}  // namespace verdigris::libav
