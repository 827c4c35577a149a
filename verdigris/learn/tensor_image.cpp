// SPDX-License-Identifier: MIT
#include "verdigris/learn/tensor_image.h"

#include <torch/nn/functional/upsampling.h>

#include <cstring>

namespace verdigris {
static_assert(sizeof(SrgbF) == 3 * sizeof(float));

torch::Tensor tensor_of(const Image<SrgbF>& image) {
    torch::Tensor interleaved = torch::empty({image.height(), image.width(), 3});
    std::memcpy(interleaved.data_ptr<float>(), image.row(0), image.byte_count());
    return interleaved.permute({2, 0, 1}).contiguous();
}

Image<SrgbF> image_of(const torch::Tensor& tensor) {
    const torch::Tensor interleaved =
        tensor.to(torch::kCPU, torch::kFloat32).permute({1, 2, 0}).contiguous();
    auto image = Image<SrgbF>::for_overwrite(int(tensor.size(2)), int(tensor.size(1)));
    std::memcpy(static_cast<void*>(image.row(0)), interleaved.data_ptr<float>(),
                image.byte_count());
    return image;
}

Image<float> field_of(const torch::Tensor& tensor) {
    const torch::Tensor rows = tensor.to(torch::kCPU, torch::kFloat32).contiguous();
    auto field = Image<float>::for_overwrite(int(tensor.size(1)), int(tensor.size(0)));
    std::memcpy(field.row(0), rows.data_ptr<float>(), field.byte_count());
    return field;
}

torch::Tensor resized(const torch::Tensor& images, int width, int height) {
    namespace F = torch::nn::functional;
    if (images.size(2) == height && images.size(3) == width) return images;
    const std::vector<std::int64_t> size{height, width};
    const bool smaller = images.size(2) >= height && images.size(3) >= width;
    if (smaller)
        return F::interpolate(images, F::InterpolateFuncOptions().size(size).mode(torch::kArea));
    return F::interpolate(
        images, F::InterpolateFuncOptions().size(size).mode(torch::kBilinear).align_corners(false));
}

}  // namespace verdigris
