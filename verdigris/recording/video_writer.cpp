// SPDX-License-Identifier: MIT
#include "verdigris/recording/video_writer.h"

#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>

#include "verdigris/error.h"
#include "verdigris/pixels/parallel_rows.h"
#include "verdigris/recording/video_output.h"
#include "verdigris/recording/writer_checks.h"
#include "verdigris/recording/yuv420_from_srgb.h"

extern "C" {
#include <libavcodec/bsf.h>
#include <libavutil/mathematics.h>
}

namespace verdigris {
namespace {

// chosen: never the machine's cores, because x264 codes otherwise with another number of threads;
// four keep a desktop busy enough, and on more memory the gain is small.
constexpr int kThreads = 4;
// chosen: how far apart key frames lie, which is how far a player has to decode to show any frame.
constexpr int kKeyFrames = 60;

struct FreeBsf {
    void operator()(AVBSFContext* p) const { av_bsf_free(&p); }
};
struct Settings {
    AVDictionary* list = nullptr;
    ~Settings() { av_dict_free(&list); }
    void set(const char* key, const std::string& value) {
        if (av_dict_set(&list, key, value.c_str(), 0) < 0) throw std::bad_alloc();
    }
};

// Whatever the locale.
std::string number(double v) {
    std::array<char, 32> text{};
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), v).ptr};
}

class VideoWriter final : public RecordingWriter {
  public:
    VideoWriter(const std::filesystem::path& target, const WriterOptions& options,
                VideoCoding coding, const AVCodec& encoder);

    void add(ImageView<const SrgbU8> frame) override {
        begin_frame(frame.width(), frame.height(), 8);
        if (coding_ == VideoCoding::h264) {
            yuv420_from_srgb(frame, {picture_->data[0], picture_->data[1], picture_->data[2],
                                     picture_->linesize[0], picture_->linesize[1]});
        } else {
            fill_bgr0(frame);
        }
        send(picture_.get());
    }
    void add(ImageView<const SrgbU16> frame) override {
        begin_frame(frame.width(), frame.height(), 16);
        for (int y = 0; y < frame.height(); ++y) {
            std::memcpy(picture_->data[0] + y * std::ptrdiff_t(picture_->linesize[0]), frame.row(y),
                        std::size_t(frame.width()) * sizeof(SrgbU16));
        }
        send(picture_.get());
    }
    void commit() override;

  private:
    void open_encoder(const AVCodec& encoder);
    void open_stream();
    void make_picture();
    void begin_frame(int width, int height, int bits);
    void fill_bgr0(ImageView<const SrgbU8> frame);
    void send(const AVFrame* picture);
    void take_packets();
    TargetKind kind() const {
        return coding_ == VideoCoding::h264 ? TargetKind::mp4 : TargetKind::mkv;
    }
    void mux(AVPacket* packet);

    WriterOptions options_;
    VideoCoding coding_;
    VideoOutput output_;
    libav::CodecPtr codec_;
    std::unique_ptr<AVBSFContext, FreeBsf> filter_;
    AVStream* stream_ = nullptr;
    libav::FramePtr picture_ = libav::new_frame();
    libav::PacketPtr packet_ = libav::new_packet();
    int frames_ = 0;
    bool committed_ = false;
};

VideoWriter::VideoWriter(const std::filesystem::path& target, const WriterOptions& options,
                         VideoCoding coding, const AVCodec& encoder)
    : options_(options),
      coding_(coding),
      output_(target, coding == VideoCoding::h264 ? "mp4" : "matroska") {
    open_encoder(encoder);
    open_stream();
    make_picture();
}

void VideoWriter::open_encoder(const AVCodec& encoder) {
    codec_.reset(avcodec_alloc_context3(&encoder));
    if (!codec_) throw std::bad_alloc();
    const AVRational rate = av_d2q(options_.fps, 1'000'000);
    codec_->width = options_.width;
    codec_->height = options_.height;
    codec_->framerate = rate;
    codec_->time_base = av_inv_q(rate);
    codec_->sample_aspect_ratio = {1, 1};
    codec_->thread_count = kThreads;
    codec_->flags |= AV_CODEC_FLAG_BITEXACT;
    if (output_.format().oformat->flags & AVFMT_GLOBALHEADER) {
        codec_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    }
    codec_->color_primaries = AVCOL_PRI_BT709;
    Settings settings;
    if (coding_ == VideoCoding::h264) {
        codec_->pix_fmt = AV_PIX_FMT_YUV420P;
        codec_->color_range = AVCOL_RANGE_MPEG;
        codec_->colorspace = AVCOL_SPC_BT709;
        // Shown as coded by all players, like sRGB; what HD video always says.
        codec_->color_trc = AVCOL_TRC_BT709;
        codec_->chroma_sample_location = AVCHROMA_LOC_LEFT;
        codec_->gop_size = kKeyFrames;
        codec_->thread_type = FF_THREAD_FRAME;
        settings.set("preset", options_.preset);
        settings.set("crf", number(options_.crf));
        // Noise must survive, also that of the last frame that anybody refers to: no B-frames and
        // no macroblock tree, which code coarsely what no other frame builds on. qcomp=1: nor does
        // the quality depend on the frame rate or on how much noise there is. cpu-independent: else
        // x264 picks approximations that differ between makers of processors.
        codec_->max_b_frames = 0;
        settings.set("x264-params", "mbtree=0:qcomp=1:cpu-independent=1");
    } else {
        codec_->pix_fmt = options_.bits == 16 ? AV_PIX_FMT_RGB48 : AV_PIX_FMT_BGR0;
        codec_->bits_per_raw_sample = options_.bits;
        codec_->color_range = AVCOL_RANGE_JPEG;
        codec_->colorspace = AVCOL_SPC_RGB;
        codec_->color_trc = AVCOL_TRC_IEC61966_2_1;
        codec_->level = 3;
        codec_->gop_size = 1;  // each frame on its own: any of them is found and survives alone
        // What threads share out; part of the bytes, so never the cores. FFmpeg's encoder takes no
        // single slice for more than this, and no slice without pixels.
        codec_->slices = options_.width <= 352 && options_.height <= 288 ? 1 : kThreads;
        codec_->thread_type = FF_THREAD_SLICE;
        settings.set("slicecrc", "1");
    }
    if (const int result = avcodec_open2(codec_.get(), &encoder, &settings.list); result < 0) {
        throw Error(ErrorCode::usage,
                    std::string("the encoder ") + encoder.name + " does not accept frames of " +
                        std::to_string(options_.width) + " x " + std::to_string(options_.height) +
                        " pixels (" + libav::words(result) + ")",
                    output_.target().string());
    }
}

void VideoWriter::open_stream() {
    stream_ = avformat_new_stream(&output_.format(), nullptr);
    if (!stream_) throw std::bad_alloc();
    output_.check(avcodec_parameters_from_context(stream_->codecpar, codec_.get()));
    if (coding_ == VideoCoding::h264) {
        // x264 writes its version and settings into the video, as a message to the user (SEI).
        AVBSFContext* filter = nullptr;
        output_.check(av_bsf_list_parse_str("filter_units=remove_types=6", &filter));
        filter_.reset(filter);
        output_.check(avcodec_parameters_copy(filter->par_in, stream_->codecpar));
        filter->time_base_in = codec_->time_base;
        output_.check(av_bsf_init(filter));
        output_.check(avcodec_parameters_copy(stream_->codecpar, filter->par_out));
    }
    stream_->time_base = codec_->time_base;
    stream_->avg_frame_rate = codec_->framerate;
    stream_->sample_aspect_ratio = {1, 1};
    Settings settings;
    // The index first, so that a browser can show the video while it loads.
    if (coding_ == VideoCoding::h264) settings.set("movflags", "+faststart");
    output_.check(avformat_write_header(&output_.format(), &settings.list));
}

void VideoWriter::make_picture() {
    picture_->format = codec_->pix_fmt;
    picture_->width = options_.width;
    picture_->height = options_.height;
    picture_->color_range = codec_->color_range;
    picture_->colorspace = codec_->colorspace;
    picture_->color_primaries = codec_->color_primaries;
    picture_->color_trc = codec_->color_trc;
    picture_->chroma_location = codec_->chroma_sample_location;
    if (av_frame_get_buffer(picture_.get(), 0) < 0) throw std::bad_alloc();
}

void VideoWriter::begin_frame(int width, int height, int bits) {
    if (committed_) throw std::logic_error("RecordingWriter::add after commit");
    check_frame(output_.target(), options_, frames_, {width, height, bits});
    output_.check(0);
    if (av_frame_make_writable(picture_.get()) < 0) throw std::bad_alloc();
    picture_->pts = frames_;
}

void VideoWriter::fill_bgr0(ImageView<const SrgbU8> frame) {
    parallel_rows(frame.height(), 64, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            const SrgbU8* from = frame.row(y);
            std::uint8_t* to = picture_->data[0] + y * std::ptrdiff_t(picture_->linesize[0]);
            for (int x = 0; x < frame.width(); ++x, to += 4) {
                to[0] = from[x].b;
                to[1] = from[x].g;
                to[2] = from[x].r;
                to[3] = 0;
            }
        }
    });
}

void VideoWriter::send(const AVFrame* picture) {
    output_.check(avcodec_send_frame(codec_.get(), picture));
    if (picture) ++frames_;
    take_packets();
}

void VideoWriter::take_packets() {
    while (true) {
        const int result = avcodec_receive_packet(codec_.get(), packet_.get());
        if (result == AVERROR(EAGAIN) || result == AVERROR_EOF) return;
        output_.check(result);
        packet_->duration = 1;  // in frames; else the last one has none
        if (!filter_) {
            mux(packet_.get());
            continue;
        }
        output_.check(av_bsf_send_packet(filter_.get(), packet_.get()));
        int filtered = 0;
        while ((filtered = av_bsf_receive_packet(filter_.get(), packet_.get())) >= 0) {
            mux(packet_.get());
        }
        if (filtered != AVERROR(EAGAIN) && filtered != AVERROR_EOF) output_.check(filtered);
    }
}

void VideoWriter::mux(AVPacket* packet) {
    av_packet_rescale_ts(packet, codec_->time_base, stream_->time_base);
    packet->stream_index = stream_->index;
    output_.check(av_interleaved_write_frame(&output_.format(), packet));
}

void VideoWriter::commit() {
    if (committed_) throw std::logic_error("RecordingWriter::commit twice");
    check_any_frame(output_.target(), frames_);
    send(nullptr);
    check_existing(output_.target(), options_.replace, kind());
    output_.commit();
    committed_ = true;
}

}  // namespace

const AVCodec& find_encoder(const char* name, const std::string& instead,
                            const std::filesystem::path& target) {
    if (const AVCodec* encoder = avcodec_find_encoder_by_name(name)) return *encoder;
    throw Error(ErrorCode::failed,
                std::string("cannot be written: this FFmpeg was built without the encoder ") +
                    name + "; write " + instead + " instead",
                target.string());
}

std::unique_ptr<RecordingWriter> write_video(const std::filesystem::path& target,
                                             const WriterOptions& options, VideoCoding coding) {
    // Before anything is written.
    const AVCodec& encoder = coding == VideoCoding::h264
                                 ? find_encoder("libx264", "a .mkv or a folder", target)
                                 : find_encoder("ffv1", "a folder", target);
    return std::make_unique<VideoWriter>(target, options, coding, encoder);
}

}  // namespace verdigris
