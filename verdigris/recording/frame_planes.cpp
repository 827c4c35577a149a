// SPDX-License-Identifier: MIT
#include "verdigris/recording/frame_planes.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "verdigris/recording/video_format.h"

extern "C" {
#include <libavutil/pixdesc.h>
}

namespace verdigris {
namespace {

int sample_bytes(const FrameFormat& format) {
    return format.type == SampleType::u16 ? 2 : 1;
}

bool native_order(const AVPixFmtDescriptor& layout, const FrameFormat& format) {
    const bool big = layout.flags & AV_PIX_FMT_FLAG_BE;
    return sample_bytes(format) == 1 || big == (std::endian::native == std::endian::big);
}

// The samples of a component lie one behind the other, ready to be read.
bool is_plane(const AVComponentDescriptor& component, const FrameFormat& format) {
    return component.step == sample_bytes(format) && component.offset == 0 && component.shift == 0;
}

bool is_interleaved_rgb(const AVPixFmtDescriptor& layout, const FrameFormat& format) {
    if (format.model != PixelModel::rgb || layout.nb_components != 3) return false;
    for (int c = 0; c < 3; ++c) {
        const AVComponentDescriptor& component = layout.comp[c];
        if (component.plane != 0 || component.step != 3 * sample_bytes(format) ||
            component.offset != c * sample_bytes(format) || component.shift != 0) {
            return false;
        }
    }
    return true;
}

template <class T>
void gather_row(const std::uint8_t* in, const AVComponentDescriptor& component, bool swap, int n,
                T* out) {
    const unsigned mask = (1u << component.depth) - 1;
    for (int i = 0; i < n; ++i, in += component.step) {
        unsigned v = in[0];
        if constexpr (sizeof(T) == 2) {
            v = std::endian::native == std::endian::little ? in[0] | unsigned(in[1]) << 8
                                                           : unsigned(in[0]) << 8 | in[1];
            if (swap) v = (v >> 8 | v << 8) & 0xffff;
        }
        out[i] = T(v >> component.shift & mask);
    }
}

struct Extent {
    int width, height;
};
Extent extent_of(const FrameFormat& format, int component) {
    if (component == 0 || format.model != PixelModel::yuv) {
        return {format.coded_width, format.coded_height};
    }
    return {-(-format.coded_width >> format.chroma_shift_x),
            -(-format.coded_height >> format.chroma_shift_y)};
}

void mirror(Plane& plane) {
    plane.data += (plane.height - 1) * plane.stride_bytes;
    plane.stride_bytes = -plane.stride_bytes;
}

// Any other order of red, green and blue as R G B R G B ..., which is how all RGB is handed on.
template <class T>
void interleave(const AVFrame& frame, const AVPixFmtDescriptor& layout, const FrameFormat& format,
                T* to) {
    const int n = format.coded_width;
    const bool swap = !native_order(layout, format);
    std::vector<T> row(static_cast<std::size_t>(n));
    for (int y = 0; y < format.coded_height; ++y, to += std::ptrdiff_t(3) * n) {
        for (int c = 0; c < 3; ++c) {
            const AVComponentDescriptor& component = layout.comp[c];
            const std::uint8_t* in = frame.data[component.plane] +
                                     std::ptrdiff_t(y) * frame.linesize[component.plane] +
                                     component.offset;
            gather_row(in, component, swap, n, row.data());
            for (int x = 0; x < n; ++x) to[3 * x + c] = row[std::size_t(x)];
        }
    }
}

FramePlanes interleaved(const AVFrame& frame, const AVPixFmtDescriptor& layout,
                        const FrameFormat& format) {
    const std::ptrdiff_t stride = std::ptrdiff_t(3) * format.coded_width * sample_bytes(format);
    const std::shared_ptr<std::byte[]> store(
        new std::byte[std::size_t(stride) * std::size_t(format.coded_height)]);
    if (format.type == SampleType::u16) {
        interleave(frame, layout, format, reinterpret_cast<std::uint16_t*>(store.get()));
    } else {
        interleave(frame, layout, format, reinterpret_cast<std::uint8_t*>(store.get()));
    }
    FramePlanes out;
    out.planes.count = 1;
    out.planes.plane[0] = {store.get(),         stride, format.coded_width,
                           format.coded_height, 3,      format.type};
    out.owner = store;
    return out;
}

Plane gathered(const AVFrame& frame, const AVPixFmtDescriptor& layout, int c,
               const FrameFormat& format, std::byte* to) {
    const AVComponentDescriptor& component = layout.comp[c];
    const Extent extent = extent_of(format, c);
    const bool swap = !native_order(layout, format);
    const std::ptrdiff_t stride = std::ptrdiff_t(extent.width) * sample_bytes(format);
    for (int y = 0; y < extent.height; ++y) {
        const std::uint8_t* in = frame.data[component.plane] +
                                 std::ptrdiff_t(y) * frame.linesize[component.plane] +
                                 component.offset;
        std::byte* out = to + y * stride;
        if (format.type == SampleType::u16) {
            gather_row(in, component, swap, extent.width, reinterpret_cast<std::uint16_t*>(out));
        } else {
            gather_row(in, component, false, extent.width, reinterpret_cast<std::uint8_t*>(out));
        }
    }
    return {to, stride, extent.width, extent.height, 1, format.type};
}

}  // namespace

FramePlanes planes_of_frame(libav::FramePtr frame, const FrameFormat& format, bool mirrored) {
    const AVPixFmtDescriptor& layout = *readable_layout(frame->format);
    FramePlanes out;
    const auto in_place = [&](int plane, int c, int channels) {
        const Extent extent = extent_of(format, c);
        return Plane{reinterpret_cast<const std::byte*>(frame->data[plane]),
                     frame->linesize[plane],
                     extent.width,
                     extent.height,
                     channels,
                     format.type};
    };
    const int components = format.model == PixelModel::gray ? 1 : 3;
    bool zero_copy = native_order(layout, format);
    if (zero_copy && is_interleaved_rgb(layout, format)) {
        out.planes.count = 1;
        out.planes.plane[0] = in_place(0, 0, 3);
    } else if (format.model == PixelModel::rgb) {
        out = interleaved(*frame, layout, format);
    } else {
        out.planes.count = components;
        for (int c = 0; c < components; ++c) {
            zero_copy = zero_copy && is_plane(layout.comp[c], format);
        }
        std::size_t bytes = 0;
        for (int c = 0; c < components && !zero_copy; ++c) {
            const Extent extent = extent_of(format, c);
            bytes += std::size_t(extent.width) * std::size_t(extent.height) *
                     std::size_t(sample_bytes(format));
        }
        std::shared_ptr<std::byte[]> store;
        if (!zero_copy) store = std::shared_ptr<std::byte[]>(new std::byte[bytes]);
        std::byte* to = store.get();
        for (int c = 0; c < components; ++c) {
            Plane& plane = out.planes.plane[std::size_t(c)];
            if (zero_copy) {
                plane = in_place(layout.comp[c].plane, c, 1);
            } else {
                plane = gathered(*frame, layout, c, format, to);
                to += plane.stride_bytes * plane.height;
            }
        }
        if (!zero_copy) out.owner = std::move(store);
    }
    if (!out.owner) out.owner = std::shared_ptr<AVFrame>(frame.release(), libav::FreeFrame{});
    if (mirrored) {
        for (int p = 0; p < out.planes.count; ++p) mirror(out.planes.plane[std::size_t(p)]);
    }
    return out;
}

}  // namespace verdigris
