// SPDX-License-Identifier: MIT
#include "verdigris/files/icc.h"

#include <lcms2.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "verdigris/error.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

// Rows per task. chosen: ~100 us of work at 4000 pixels a row.
constexpr int kRowsPerRun = 16;

struct Transform {
    cmsHTRANSFORM handle = nullptr;
    // NOCACHE: the cache of the last color is shared between threads.
    Transform(cmsContext context, cmsHPROFILE from, cmsUInt32Number format, cmsHPROFILE to,
              cmsUInt32Number flags)
        : handle(cmsCreateTransformTHR(context, from, format, to, TYPE_RGB_16,
                                       INTENT_RELATIVE_COLORIMETRIC, flags | cmsFLAGS_NOCACHE)) {
        if (!handle) {
            throw Error(ErrorCode::bad_input, "has an ICC profile that cannot be applied");
        }
    }
    ~Transform() { cmsDeleteTransform(handle); }
    Transform(const Transform&) = delete;
    Transform& operator=(const Transform&) = delete;
};

// Gray is replicated by the codecs: take the first of three channels.
constexpr cmsUInt32Number gray_of_rgb(unsigned bytes) {
    return COLORSPACE_SH(PT_GRAY) | CHANNELS_SH(1) | EXTRA_SH(2) | BYTES_SH(bytes);
}

}  // namespace

struct IccProfile::State {
    // An own context: the default one would call handlers that the application may have set.
    cmsContext context = cmsCreateContext(nullptr, nullptr);
    cmsHPROFILE profile = nullptr, srgb = nullptr;
    cmsUInt32Number space = 0;  // a number: damaged profiles hold values outside of the enum

    explicit State(std::span<const std::byte> data) {
        profile = cmsOpenProfileFromMemTHR(context, data.data(), cmsUInt32Number(data.size()));
        srgb = cmsCreate_sRGBProfileTHR(context);
        if (profile) space = cmsUInt32Number(cmsGetColorSpace(profile));
    }
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {
        if (profile) cmsCloseProfile(profile);
        if (srgb) cmsCloseProfile(srgb);
        cmsDeleteContext(context);
    }

    template <class P>
    Image<SrgbU16> convert(ImageView<const P> image) const {
        constexpr unsigned kBytes = sizeof(P) / 3;
        const cmsUInt32Number format = space == cmsUInt32Number(cmsSigGrayData)
                                           ? gray_of_rgb(kBytes)
                                           : (kBytes == 1 ? TYPE_RGB_8 : TYPE_RGB_16);
        // For 16-bit input lcms would replace the curves by a coarse table; for 8 bit its fast path
        // has 14 bits, more than the input.
        const Transform transform(context, profile, format, srgb,
                                  kBytes == 1 ? 0 : cmsFLAGS_NOOPTIMIZE);
        auto out = Image<SrgbU16>::for_overwrite(image.width(), image.height());
        parallel_rows(image.height(), kRowsPerRun, [&](RowRun run) {
            for (int y = run.begin; y < run.end; ++y) {
                cmsDoTransform(transform.handle, image.row(y), out.row(y),
                               cmsUInt32Number(image.width()));
            }
        });
        return out;
    }
};

IccProfile::IccProfile(std::span<const std::byte> data) : state_(std::make_unique<State>(data)) {
    std::array<char, 128> text{};
    if (state_->profile) {
        cmsGetProfileInfoASCII(state_->profile, cmsInfoDescription, "en", "US", text.data(),
                               cmsUInt32Number(text.size()));
    }
    text.back() = '\0';
    for (const char* c = text.data(); *c; ++c) {
        if (*c >= ' ' && *c <= '~') name_ += *c;
    }
    if (name_.empty()) name_ = "unnamed";
}
IccProfile::~IccProfile() = default;

bool IccProfile::usable_for(bool gray) const {
    if (!state_->profile || !state_->srgb) return false;
    if (state_->space != cmsUInt32Number(cmsSigRgbData) &&
        !(gray && state_->space == cmsUInt32Number(cmsSigGrayData)))
        return false;
    try {
        const SrgbU8 probe{};
        srgb_from(ImageView<const SrgbU8>(&probe, 1, 1, 1));
    } catch (const Error&) {
        return false;
    }
    return true;
}

bool IccProfile::is_srgb() const {
    // A lattice of colors; for a gray profile its diagonal.
    constexpr int kSteps = 9;
    std::vector<SrgbU16> lattice;
    const auto code = [](int i) { return std::uint16_t(i * 65535 / (kSteps - 1)); };
    for (int i = 0; i < kSteps * kSteps * kSteps; ++i) {
        const int r = i % kSteps, g = i / kSteps % kSteps, b = i / kSteps / kSteps;
        if (state_->space == cmsUInt32Number(cmsSigGrayData) && (r != g || g != b)) continue;
        lattice.push_back({code(r), code(g), code(b)});
    }
    const int count = int(lattice.size());
    const auto converted = srgb_from(ImageView<const SrgbU16>(lattice.data(), count, 1, count));
    for (int i = 0; i < count; ++i) {
        const SrgbU16 a = lattice[std::size_t(i)], b = converted(i, 0);
        // chosen: 257 is one 8-bit code value; profiles of the same space differ by rounding.
        if (std::abs(a.r - b.r) > 257 || std::abs(a.g - b.g) > 257 || std::abs(a.b - b.b) > 257) {
            return false;
        }
    }
    return true;
}

Image<SrgbU16> IccProfile::srgb_from(ImageView<const SrgbU8> image) const {
    return state_->convert(image);
}
Image<SrgbU16> IccProfile::srgb_from(ImageView<const SrgbU16> image) const {
    return state_->convert(image);
}

}  // namespace verdigris
