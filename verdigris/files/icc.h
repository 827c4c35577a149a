// SPDX-License-Identifier: MIT
// An embedded ICC profile, and the way from it to encoded sRGB. Used inside this room only.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

class IccProfile {
  public:
    explicit IccProfile(std::span<const std::byte> data);
    ~IccProfile();
    IccProfile(const IccProfile&) = delete;
    IccProfile& operator=(const IccProfile&) = delete;

    /// "Display P3"; "unnamed" if it does not say.
    const std::string& name() const { return name_; }
    /// False: damaged, or not made for pictures of this kind (a CMYK profile in an RGB file).
    bool usable_for(bool gray) const;
    /// The profile means what sRGB means, to within one 8-bit code value everywhere.
    bool is_srgb() const;

    /// Relative colorimetric, rows in parallel. For a gray profile the first channel counts.
    Image<SrgbU16> srgb_from(ImageView<const SrgbU8> image) const;
    Image<SrgbU16> srgb_from(ImageView<const SrgbU16> image) const;

  private:
    struct State;
    std::unique_ptr<State> state_;
    std::string name_;
};

}  // namespace verdigris
