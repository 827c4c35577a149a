// SPDX-License-Identifier: MIT
// Images as tensors and back (internal).
#pragma once

#include <torch/types.h>

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

/// [3, H, W] float32 on the CPU.
torch::Tensor tensor_of(const Image<SrgbF>& image);
/// Of a [3, H, W] tensor, on any device.
Image<SrgbF> image_of(const torch::Tensor& tensor);
/// Of a [H, W] tensor.
Image<float> field_of(const torch::Tensor& tensor);
/// [B, 3, h, w]: areas averaged where it gets smaller, bilinear where it gets larger.
torch::Tensor resized(const torch::Tensor& images, int width, int height);

}  // namespace verdigris
