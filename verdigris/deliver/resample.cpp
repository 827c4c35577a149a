// SPDX-License-Identifier: MIT
#include "verdigris/deliver/resample.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace verdigris {
namespace {

template <class P>
cv::Mat matrix(P* data, int width, int height, std::ptrdiff_t stride, int type) {
    // OpenCV has no read-only matrix; sources are never written.
    return {height, width, type, const_cast<std::remove_const_t<P>*>(data),
            std::size_t(stride) * sizeof(P)};
}

template <class P>
Image<P> resize(ImageView<const P> image, PictureSize extent, int type, int enlarge) {
    Image<P> result = Image<P>::for_overwrite(extent.width, extent.height);
    if (image.empty() || result.empty()) return result;
    const bool smaller = extent.width <= image.width() && extent.height <= image.height();
    cv::Mat out = matrix(result.row(0), extent.width, extent.height, extent.width, type);
    cv::resize(matrix(image.row(0), image.width(), image.height(), image.stride(), type), out,
               out.size(), 0, 0, smaller ? int(cv::INTER_AREA) : enlarge);
    return result;
}

}  // namespace

PictureSize fitted(PictureSize extent, int limit) {
    const int side = std::max(extent.width, extent.height);
    if (side <= limit) return extent;
    const auto scaled = [&](int length) {
        return std::max(1, int(std::lround(double(length) * limit / side)));
    };
    return {scaled(extent.width), scaled(extent.height)};
}

Image<SrgbF> resampled(ImageView<const SrgbF> image, PictureSize extent) {
    Image<SrgbF> result = resize(image, extent, CV_32FC3, cv::INTER_CUBIC);
    if (extent.width > image.width() || extent.height > image.height()) {
        for (SrgbF& c : result.pixels()) {
            c = {std::clamp(c.r, 0.0f, 1.0f), std::clamp(c.g, 0.0f, 1.0f),
                 std::clamp(c.b, 0.0f, 1.0f)};
        }
    }
    return result;
}

Image<float> resampled(ImageView<const float> image, PictureSize extent) {
    return resize(image, extent, CV_32FC1, cv::INTER_LINEAR);
}

}  // namespace verdigris
