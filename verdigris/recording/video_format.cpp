// SPDX-License-Identifier: MIT
#include "verdigris/recording/video_format.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "verdigris/error.h"

extern "C" {
#include <libavutil/display.h>
}

namespace verdigris {
namespace {

struct Matrix {
    const char* name;
    double kr, kb;
};
constexpr Matrix kBt709{"BT.709", 0.2126, 0.0722};       // [BT709]
constexpr Matrix kBt601{"BT.601", 0.299, 0.114};         // [BT601]
constexpr Matrix kBt2020{"BT.2020", 0.2627, 0.0593};     // [BT2020], not constant luminance
constexpr Matrix kFcc{"FCC", 0.30, 0.11};                // [H273] table 4, value 4
constexpr Matrix kSmpte240{"SMPTE 240M", 0.212, 0.087};  // [H273] table 4, value 7

Matrix matrix_of(AVColorSpace space, const std::filesystem::path& path) {
    switch (space) {
        case AVCOL_SPC_BT709:
            return kBt709;
        case AVCOL_SPC_BT470BG:
        case AVCOL_SPC_SMPTE170M:
            return kBt601;
        case AVCOL_SPC_BT2020_NCL:
            return kBt2020;
        case AVCOL_SPC_FCC:
            return kFcc;
        case AVCOL_SPC_SMPTE240M:
            return kSmpte240;
        default:
            break;
    }
    const char* name = av_color_space_name(space);
    throw Error(ErrorCode::bad_input,
                std::string("uses the color matrix '") + (name ? name : "unknown") +
                    "', which cannot be read; transcode it to BT.709",
                path.string());
}

Matrix assumed_matrix(const std::string& name, int lines) {
    // chosen, as players do: HD is BT.709, smaller is BT.601 [BT709] [BT601].
    if (name.empty()) return lines >= 720 ? kBt709 : kBt601;
    if (name == "bt709") return kBt709;
    if (name == "bt601") return kBt601;
    if (name == "bt2020") return kBt2020;
    throw Error(ErrorCode::usage,
                "there is no color matrix '" + name + "' to assume; take bt709, bt601 or bt2020");
}

bool assumed_full(const std::string& name, bool usual) {
    if (name.empty()) return usual;
    if (name == "full" || name == "limited") return name == "full";
    throw Error(ErrorCode::usage,
                "there is no color range '" + name + "' to assume; take limited or full");
}

bool is_old_full_range_layout(int pixel_format) {
    switch (pixel_format) {
        case AV_PIX_FMT_YUVJ411P:
        case AV_PIX_FMT_YUVJ420P:
        case AV_PIX_FMT_YUVJ422P:
        case AV_PIX_FMT_YUVJ440P:
        case AV_PIX_FMT_YUVJ444P:
            return true;
        default:
            return false;
    }
}

void read_transfer(const AVFrame& frame, VideoFormat& out) {
    switch (frame.color_trc) {
        case AVCOL_TRC_LINEAR:
            out.format.transfer = Transfer::linear;
            break;
        case AVCOL_TRC_GAMMA22:
            out.format.transfer = Transfer::gamma22;
            break;
        case AVCOL_TRC_GAMMA28:
            out.format.transfer = Transfer::gamma28;
            break;
        case AVCOL_TRC_SMPTE2084:
            out.format.transfer = Transfer::pq;
            break;
        case AVCOL_TRC_ARIB_STD_B67:
            out.format.transfer = Transfer::hlg;
            break;
        case AVCOL_TRC_LOG:
        case AVCOL_TRC_LOG_SQRT:
        case AVCOL_TRC_SMPTE428:
            out.notes.push_back({"unknown_transfer", Severity::caution,
                                 std::string("its transfer curve '") +
                                     av_color_transfer_name(frame.color_trc) +
                                     "' is not known here; code values are shown as they are"});
            break;
        default:
            break;  // the BT.709 family, sRGB, unspecified: shown as coded
    }
}

void read_primaries(const AVFrame& frame, VideoFormat& out) {
    switch (frame.color_primaries) {
        case AVCOL_PRI_BT470BG:
            out.format.primaries = Primaries::bt601_625;
            break;
        case AVCOL_PRI_SMPTE170M:
        case AVCOL_PRI_SMPTE240M:
            out.format.primaries = Primaries::bt601_525;
            break;
        case AVCOL_PRI_BT2020:
            out.format.primaries = Primaries::bt2020;
            break;
        case AVCOL_PRI_SMPTE431:
        case AVCOL_PRI_SMPTE432:
            out.format.primaries = Primaries::display_p3;
            break;
        case AVCOL_PRI_BT709:
        case AVCOL_PRI_UNSPECIFIED:
        case AVCOL_PRI_RESERVED0:
        case AVCOL_PRI_RESERVED:
            break;
        default:
            out.notes.push_back({"unknown_primaries", Severity::caution,
                                 std::string("its primaries '") +
                                     av_color_primaries_name(frame.color_primaries) +
                                     "' are not known here; BT.709 is taken instead"});
    }
}

// Where the chroma samples lie, in luma pixels from the first luma sample [H273] figure 1.
void read_siting(const AVFrame& frame, bool jpeg, FrameFormat& format) {
    const double right = (1 << format.chroma_shift_x) - 1;
    const double bottom = (1 << format.chroma_shift_y) - 1;
    format.chroma_x = 0;
    format.chroma_y = bottom / 2;
    switch (frame.chroma_location) {
        case AVCHROMA_LOC_CENTER:
            format.chroma_x = right / 2;
            break;
        case AVCHROMA_LOC_TOPLEFT:
            format.chroma_y = 0;
            break;
        case AVCHROMA_LOC_TOP:
            format.chroma_x = right / 2;
            format.chroma_y = 0;
            break;
        case AVCHROMA_LOC_BOTTOMLEFT:
            format.chroma_y = bottom;
            break;
        case AVCHROMA_LOC_BOTTOM:
            format.chroma_x = right / 2;
            format.chroma_y = bottom;
            break;
        case AVCHROMA_LOC_LEFT:
            break;
        default:  // left in MPEG-2 and all since, centered in JPEG [JFIF]
            if (jpeg) format.chroma_x = right / 2;
    }
}

// p' = p M with y down: a turn clockwise by t has a = cos t, b = sin t, c = -sin t, d = cos t;
// mirroring top to bottom before it flips the signs of c and d only.
Turn read_turn(const AVStream& stream, VideoFormat& out) {
    Turn turn;
    std::size_t size = 0;
    const std::uint8_t* data = av_stream_get_side_data(&stream, AV_PKT_DATA_DISPLAYMATRIX, &size);
    if (!data || size < 9 * sizeof(std::int32_t)) return turn;
    const std::int32_t* m = reinterpret_cast<const std::int32_t*>(data);
    const double a = m[0], b = m[1], c = m[3], d = m[4];
    if (a * d - b * c == 0) return turn;
    const double degrees = std::atan2(b, a) * 180 / std::numbers::pi;
    const long quarter = std::lround(degrees / 90);
    if (std::abs(degrees - 90.0 * double(quarter)) > 1) {
        out.notes.push_back({"odd_rotation", Severity::caution,
                             "it is to be shown turned by " + std::to_string(std::lround(degrees)) +
                                 " degrees, which is no quarter turn and is left out"});
        return turn;
    }
    turn.rotation = int((quarter % 4 + 4) % 4) * 90;
    turn.mirrored = a * d - b * c < 0;
    if (turn.mirrored) {
        out.notes.push_back(
            {"mirrored", Severity::info, "it is stored mirrored and shown the right way round"});
    }
    return turn;
}

// Rows are handed on from the bottom up: chroma is then sited from the other end.
void mirror_siting(FrameFormat& format) {
    const int step = 1 << format.chroma_shift_y;
    const int rows = (format.coded_height + step - 1) >> format.chroma_shift_y;
    format.chroma_y = format.coded_height - 1 - ((rows - 1) * step + format.chroma_y);
}

std::string describe(const FrameFormat& format, const std::string& matrix, bool guessed) {
    std::string text = matrix + (format.full_range ? " full range, " : " limited range, ") +
                       std::to_string(format.bits) + " bit";
    constexpr const char* kCurves[] = {"",     ", linear", ", gamma 2.2", ", gamma 2.8",
                                       ", PQ", ", HLG"};
    text += kCurves[std::size_t(format.transfer)];
    if (format.primaries == Primaries::bt2020 && matrix != "BT.2020") text += ", BT.2020 primaries";
    if (format.primaries == Primaries::display_p3) text += ", P3 primaries";
    return guessed ? text + " (assumed)" : text;
}

}  // namespace

const AVPixFmtDescriptor* readable_layout(int pixel_format) {
    const AVPixFmtDescriptor* layout = av_pix_fmt_desc_get(AVPixelFormat(pixel_format));
    constexpr std::uint64_t kNotReadable = AV_PIX_FMT_FLAG_PAL | AV_PIX_FMT_FLAG_BITSTREAM |
                                           AV_PIX_FMT_FLAG_HWACCEL | AV_PIX_FMT_FLAG_BAYER |
                                           AV_PIX_FMT_FLAG_FLOAT;
    if (!layout || layout->flags & kNotReadable) return nullptr;
    if (pixel_format == AV_PIX_FMT_XYZ12LE || pixel_format == AV_PIX_FMT_XYZ12BE) return nullptr;
    if (layout->comp[0].depth < 8 || layout->comp[0].depth > 16) return nullptr;
    for (int c = 1; c < std::min<int>(layout->nb_components, 3); ++c) {
        if (layout->comp[c].depth != layout->comp[0].depth) return nullptr;
    }
    return layout;
}

VideoFormat read_video_format(const AVFrame& frame, const AVStream& stream,
                              const RecordingOptions& options, const std::filesystem::path& path) {
    const AVPixFmtDescriptor* layout = readable_layout(frame.format);
    if (!layout) {
        const char* name = av_get_pix_fmt_name(AVPixelFormat(frame.format));
        throw Error(ErrorCode::bad_input,
                    std::string("has the pixel layout '") + (name ? name : "unknown") +
                        "', which cannot be read; transcode it to yuv420p or rgb24",
                    path.string());
    }
    VideoFormat out;
    FrameFormat& format = out.format;
    const bool rgb = layout->flags & AV_PIX_FMT_FLAG_RGB;
    const bool jpeg = stream.codecpar->codec_id == AV_CODEC_ID_MJPEG;
    format.model =
        rgb ? PixelModel::rgb : (layout->nb_components < 3 ? PixelModel::gray : PixelModel::yuv);
    format.bits = layout->comp[0].depth;
    format.type = format.bits > 8 ? SampleType::u16 : SampleType::u8;
    format.coded_width = frame.width;
    format.coded_height = frame.height;

    // A wrong assumption of the caller's is a wrong call even where it is not needed.
    const Matrix guess = assumed_matrix(options.assume_matrix, frame.height);
    const bool full_guess =
        assumed_full(options.assume_range, rgb || jpeg || is_old_full_range_layout(frame.format));
    std::string matrix_name = rgb ? "RGB" : "gray";
    bool guessed = false;
    if (format.model == PixelModel::yuv) {
        format.chroma_shift_x = layout->log2_chroma_w;
        format.chroma_shift_y = layout->log2_chroma_h;
        read_siting(frame, jpeg, format);
        guessed = frame.colorspace == AVCOL_SPC_UNSPECIFIED ||
                  frame.colorspace == AVCOL_SPC_RESERVED || frame.colorspace == AVCOL_SPC_RGB;
        const Matrix matrix = guessed ? guess : matrix_of(frame.colorspace, path);
        format.kr = matrix.kr;
        format.kb = matrix.kb;
        matrix_name = matrix.name;
    } else {
        format.chroma_y = 0;
    }
    const bool range_known =
        frame.color_range != AVCOL_RANGE_UNSPECIFIED || is_old_full_range_layout(frame.format);
    if (!range_known) {
        format.full_range = full_guess;
        guessed = guessed || !(rgb || jpeg);
    } else {
        format.full_range =
            frame.color_range == AVCOL_RANGE_JPEG || is_old_full_range_layout(frame.format);
    }
    read_transfer(frame, out);
    read_primaries(frame, out);
    out.turn = read_turn(stream, out);
    format.rotation = out.turn.rotation;
    if (out.turn.mirrored) mirror_siting(format);

    out.description = describe(format, matrix_name, guessed);
    if (guessed) {
        out.notes.push_back(
            {"assumed_color", Severity::info,
             "the file does not say in full how its colors are coded: " + matrix_name +
                 (format.full_range ? ", full" : ", limited") + " range is assumed"});
    }
    if (layout->flags & AV_PIX_FMT_FLAG_ALPHA) {
        out.notes.push_back({"alpha", Severity::info, "its transparency is ignored"});
    }
    const AVFieldOrder order = stream.codecpar->field_order;
    if (order != AV_FIELD_UNKNOWN && order != AV_FIELD_PROGRESSIVE) {
        out.notes.push_back({"interlaced", Severity::caution,
                             "it is interlaced: each frame mixes two moments, which blurs motion "
                             "but not slow change"});
    }
    const AVRational shape = stream.codecpar->sample_aspect_ratio;
    if (shape.num > 0 && shape.den > 0 && shape.num != shape.den) {
        out.notes.push_back({"pixel_shape", Severity::caution,
                             "its pixels are not square (" + std::to_string(shape.num) + ":" +
                                 std::to_string(shape.den) +
                                 ") and are kept as coded: the specimen looks squeezed; convert "
                                 "the recording to square pixels first"});
    }
    return out;
}

}  // namespace verdigris
