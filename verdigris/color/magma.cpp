// SPDX-License-Identifier: MIT
#include "verdigris/color/magma.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <opencv2/imgproc.hpp>

#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {

const std::array<SrgbU8, 256>& magma_table() {
    static const std::array<SrgbU8, 256> table = [] {
        cv::Mat ramp(1, 256, CV_8UC1), colors;
        for (int i = 0; i < 256; ++i) ramp.at<std::uint8_t>(0, i) = std::uint8_t(i);
        cv::applyColorMap(ramp, colors, cv::COLORMAP_MAGMA);
        std::array<SrgbU8, 256> made;
        for (int i = 0; i < 256; ++i) {
            const auto bgr = colors.at<cv::Vec3b>(0, i);
            made[std::size_t(i)] = {bgr[2], bgr[1], bgr[0]};
        }
        return made;
    }();
    return table;
}

Image<SrgbU8> magma(const Image<float>& map, double full) {
    const std::array<SrgbU8, 256>& table = magma_table();
    auto picture = Image<SrgbU8>::for_overwrite(map.width(), map.height());
    parallel_rows(map.height(), 32, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            std::transform(map.row(y), map.row(y) + map.width(), picture.row(y), [&](float v) {
                const double share = double(v) / full;
                // Not clamp(): what is no number would stay one, and has no place in a table.
                return table[share > 0 ? std::size_t(std::min(share, 1.0) * 255 + 0.5) : 0];
            });
        }
    });
    return picture;
}

}  // namespace verdigris
