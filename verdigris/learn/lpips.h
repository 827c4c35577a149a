// SPDX-License-Identifier: MIT
// LPIPS v0.1 [Zhang2018]: how different two pictures look to people, by the activations of a
// network that was trained to tell objects apart. Its weights are the user's to bring, as a
// safetensors file; docs/models/metrics.md says how one is made. No weights, no number.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

enum class LpipsNet { alex, vgg, squeeze };  ///< AlexNet, VGG-16, SqueezeNet 1.1
std::string to_string(LpipsNet net);         ///< "alex", "vgg", "squeeze"
/// Throws Error{usage} listing the names.
LpipsNet lpips_net(std::string_view name);

inline constexpr const char* kLpipsVersion = "0.1";

/// The shortest side at which every layer still has something to look at: 31, 16, 17.
int lpips_smallest(LpipsNet net);

class Lpips {
  public:
    /// Reads the weights: tensors under torchvision's names ("features.0.weight") and the heads
    /// "lin0.weight" [1, channels, 1, 1]; metadata `net` and `version`. Throws Error{bad_input}
    /// naming the file and what is wrong: no safetensors file, another version or net, a tensor
    /// that is missing, unknown, of another shape or not finite, a negative weight in a head.
    explicit Lpips(const std::filesystem::path& weights);
    ~Lpips();
    Lpips(Lpips&&) noexcept;
    Lpips& operator=(Lpips&&) noexcept;

    LpipsNet net() const;

    /// 0 for equal pictures; larger is further apart, without an upper end. Both encoded sRGB,
    /// limited to [0, 1], NaN as 0. Symmetric but for rounding. Throws Error{bad_input} if the
    /// sizes differ or a side is below lpips_smallest(). The tenth digit depends on libtorch's
    /// threads (use_cpu_for_networks). Whole layers are held: alex 0.4 GB and squeeze 1.4 GB for
    /// 1920 x 1080, vgg 1.4 GB for a quarter of that. One caller at a time.
    double distance(ImageView<const SrgbF> first, ImageView<const SrgbF> second) const;

  private:
    struct Parts;  // libtorch's side
    std::unique_ptr<Parts> parts_;
};

}  // namespace verdigris
