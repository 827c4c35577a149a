// SPDX-License-Identifier: MIT
#include "verdigris/recording/video_container.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <string>
#include <thread>

#include "verdigris/error.h"
#include "verdigris/files/image_file.h"

namespace verdigris {
namespace {

// Demuxers of files that hold video themselves. Left out on purpose: playlists (hls, concat,
// dash), which open other files; tty and subtitles, which make video of any text; pictures.
constexpr const char* kDemuxers =
    "mov,mp4,m4a,3gp,3g2,mj2,matroska,webm,avi,mpegts,mpeg,mpegvideo,h264,hevc,av1,obu,ivf,m4v,"
    "mjpeg,flv,asf,nut,ogg,mxf,yuv4mpegpipe,gif,apng,dv,rm,wtv";

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& sentence) {
    throw Error(ErrorCode::bad_input, sentence, path.string());
}

std::uint64_t big_endian(const unsigned char* p, int n) {
    std::uint64_t v = 0;
    for (int i = 0; i < n; ++i) v = v << 8 | p[i];
    return v;
}

// [ISO14496-12] 4.2: a file of boxes, each a 32-bit length (1: a 64-bit one follows; 0: up to the
// end) and a name. True if it begins like one and holds no box `moov`.
bool is_mp4_without_index(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    in.seekg(0, std::ios::end);
    const std::uint64_t size = std::uint64_t(in.tellg());
    bool mp4 = false;
    for (std::uint64_t at = 0; at + 8 <= size;) {
        std::array<unsigned char, 16> head{};
        in.clear();
        in.seekg(std::streamoff(at));
        in.read(reinterpret_cast<char*>(head.data()), 16);
        if (in.gcount() < 8) break;
        const std::string name(reinterpret_cast<const char*>(head.data()) + 4, 4);
        if (name == "moov") return false;
        mp4 = mp4 || name == "ftyp" || (at == 0 && (name == "mdat" || name == "wide"));
        if (!mp4) return false;
        std::uint64_t length = big_endian(head.data(), 4);
        if (length == 1) length = big_endian(head.data() + 8, 8);
        if (length < 8 || length > size - at) break;  // 0, or cut off: the last box
        at += length;
    }
    return mp4;
}

std::string why_not_video(const std::filesystem::path& path, int error) {
    if (std::filesystem::file_size(path) == 0) return "the file is empty";
    if (is_mp4_without_index(path)) {
        return "the file is incomplete: its index is missing (moov atom); it was probably cut off "
               "while being recorded or copied, so copy it again or repair it";
    }
    if (error == AVERROR_INVALIDDATA || error == AVERROR(EINVAL)) {
        return "is not a video that can be read (MP4, MOV, MKV, WebM, AVI, MPEG-TS ...)";
    }
    return "cannot be opened as a video (" + libav::words(error) + ")";
}

constexpr const char* kEncrypted = "is encrypted; remove the copy protection first";

bool holds_encrypted_packets(AVFormatContext* format) {
    const libav::PacketPtr packet = libav::new_packet();
    bool found = false;
    while (!found && av_read_frame(format, packet.get()) >= 0) {
        found = is_encrypted(*packet);
        av_packet_unref(packet.get());
    }
    return found;
}

}  // namespace

VideoContainer open_container(const std::filesystem::path& path) {
    libav::be_silent();
    VideoContainer container;
    AVDictionary* options = nullptr;
    av_dict_set(&options, "format_whitelist", kDemuxers, 0);
    av_dict_set(&options, "protocol_whitelist", "file", 0);
    AVFormatContext* format = nullptr;
    // "file:" so that a colon in the name is not taken for a protocol.
    const std::string url = "file:" + path.string();
    const int opened = avformat_open_input(&format, url.c_str(), nullptr, &options);
    av_dict_free(&options);
    if (opened < 0) refuse(path, why_not_video(path, opened));
    container.format.reset(format);

    const int read = avformat_find_stream_info(format, nullptr);
    if (read < 0) refuse(path, why_not_video(path, read));
    const int best = av_find_best_stream(format, AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
    if (best < 0 || format->streams[best]->disposition & AV_DISPOSITION_ATTACHED_PIC) {
        if (is_mp4_without_index(path)) refuse(path, why_not_video(path, best));
        const bool sound = av_find_best_stream(format, AVMEDIA_TYPE_AUDIO, -1, -1, nullptr, 0) >= 0;
        refuse(path, sound ? "holds sound but no video" : "holds no video");
    }
    container.stream = format->streams[best];
    for (unsigned i = 0; i < format->nb_streams; ++i) {
        format->streams[i]->discard = int(i) == best ? AVDISCARD_DEFAULT : AVDISCARD_ALL;
    }
    const AVCodecParameters& codec = container.codec();
    if (codec.width <= 0 || codec.height <= 0) {
        if (holds_encrypted_packets(format)) refuse(path, kEncrypted);
        refuse(path, "announces a video, but no picture of it can be found");
    }
    if (std::int64_t(codec.width) * codec.height > kMaxImagePixels) {
        refuse(path, "has frames of " + std::to_string(codec.width) + " x " +
                         std::to_string(codec.height) + " pixels, more than can be handled (2^28)");
    }
    return container;
}

bool is_encrypted(const AVPacket& packet) {
    return av_packet_get_side_data(&packet, AV_PKT_DATA_ENCRYPTION_INFO, nullptr) != nullptr;
}

void refuse_encrypted(const std::filesystem::path& path) {
    refuse(path, kEncrypted);
}

bool only_marks_damage(const VideoContainer& container) {
    switch (container.codec().codec_id) {
        case AV_CODEC_ID_H264:
        case AV_CODEC_ID_HEVC:
        case AV_CODEC_ID_VP8:
        case AV_CODEC_ID_VP9:
        case AV_CODEC_ID_AV1:
        case AV_CODEC_ID_MJPEG:
        case AV_CODEC_ID_FFV1:
        case AV_CODEC_ID_PRORES:
        case AV_CODEC_ID_DNXHD:
            return false;
        default:
            // FFmpeg's H.263 family (MPEG-4 part 2 among them) must not be asked to give up: it
            // then fails an assertion of its own and ends the process (5.1, decode.c, buf[0]).
            return true;
    }
}

libav::CodecPtr open_decoder(const VideoContainer& container, Decoding how, int threads,
                             const std::filesystem::path& path) {
    const AVCodecParameters& parameters = container.codec();
    const AVCodec* decoder = avcodec_find_decoder(parameters.codec_id);
    if (!decoder) {
        refuse(path, std::string("is coded as ") + avcodec_get_name(parameters.codec_id) +
                         ", for which no decoder is installed");
    }
    libav::CodecPtr codec(avcodec_alloc_context3(decoder));
    if (!codec) throw std::bad_alloc();
    if (avcodec_parameters_to_context(codec.get(), &parameters) < 0) throw std::bad_alloc();
    // chosen: at most 16, beyond which FFmpeg itself warns: each thread holds frames of its own.
    const int cores = std::clamp(int(std::thread::hardware_concurrency()), 1, 16);
    codec->thread_count = how == Decoding::careful ? 1 : threads > 0 ? threads : cores;
    codec->thread_type = FF_THREAD_SLICE;
    const bool marks = only_marks_damage(container);
    if (how == Decoding::lenient || !marks) codec->thread_type |= FF_THREAD_FRAME;
    if (how != Decoding::lenient) {
        codec->err_recognition = AV_EF_CRCCHECK;
        // H.264 gives up also on a reference that is only missing because decoding began at an
        // open group; carefully, its marks are enough and tell the two apart.
        const bool h264_carefully =
            how == Decoding::careful && parameters.codec_id == AV_CODEC_ID_H264;
        if (!marks && !h264_carefully) codec->err_recognition |= AV_EF_EXPLODE;
    }
    // Crops exactly: without it the left edge is rounded to what SIMD likes.
    codec->flags |= AV_CODEC_FLAG_UNALIGNED;
    if (const int error = avcodec_open2(codec.get(), decoder, nullptr); error < 0) {
        refuse(path, std::string("the ") + decoder->name + " decoder does not accept it (" +
                         libav::words(error) + ")");
    }
    return codec;
}

}  // namespace verdigris
