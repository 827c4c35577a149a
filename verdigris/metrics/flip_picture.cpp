// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <opencv2/imgproc.hpp>

#include "verdigris/metrics/flip.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

using ColorTable = std::array<SrgbU8, 256>;

ColorTable magma_table() {
    cv::Mat ramp(1, 256, CV_8UC1), colors;
    for (int i = 0; i < 256; ++i) ramp.at<std::uint8_t>(0, i) = std::uint8_t(i);
    cv::applyColorMap(ramp, colors, cv::COLORMAP_MAGMA);
    ColorTable table;
    for (int i = 0; i < 256; ++i) {
        const auto bgr = colors.at<cv::Vec3b>(0, i);
        table[std::size_t(i)] = {bgr[2], bgr[1], bgr[0]};
    }
    return table;
}

}  // namespace

Image<SrgbU8> flip_picture(const Image<float>& map) {
    const ColorTable table = magma_table();
    Image<SrgbU8> picture = Image<SrgbU8>::for_overwrite(map.width(), map.height());
    parallel_rows(map.height(), 32, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            std::transform(map.row(y), map.row(y) + map.width(), picture.row(y), [&](float e) {
                return table[std::size_t(std::clamp(e, 0.0f, 1.0f) * 255 + 0.5f)];
            });
        }
    });
    return picture;
}

}  // namespace verdigris
