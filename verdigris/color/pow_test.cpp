// SPDX-License-Identifier: MIT
// fast_log2 and fast_exp2 against the standard library, on every instruction set of this machine.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "verdigris/color/pow_test.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
// After foreach_target, which includes this file again for each target.
#include "verdigris/color/pow-inl.h"

HWY_BEFORE_NAMESPACE();
namespace verdigris {
namespace HWY_NAMESPACE {

/// out[i] = in[i]^e; `count` is a multiple of 64.
void powers(const float* in, std::size_t count, float e, float* out) {
    const hn::ScalableTag<float> d;
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        const auto log = fast_log2(d, hn::LoadU(d, in + i));
        hn::StoreU(fast_exp2(d, hn::Mul(hn::Set(d, e), log)), d, out + i);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace verdigris
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace verdigris {
namespace {

HWY_EXPORT(powers);

TEST(Pow, MatchesTheStandardLibrary) {
    std::vector<float> x;
    for (int i = 1; i <= 64 * 512; ++i) x.push_back(float(i) / (64 * 512));
    for (int i = 0; i < 64 * 16; ++i) x.push_back(std::pow(10.0f, -20.0f * float(i) / (64 * 16)));
    std::vector<float> y(x.size());
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        for (float e : {0.75f, 0.85f, 1.25f, 0.6375f, 2.0f, 1.0f}) {
            HWY_DYNAMIC_DISPATCH(powers)(x.data(), x.size(), e, y.data());
            double worst = 0, worst_small = 0;
            for (std::size_t i = 0; i < x.size(); ++i) {
                const double exact = std::pow(double(x[i]), double(e));
                if (exact < 1e-37) continue;  // below what fast_exp2 goes to
                const double error = std::abs(double(y[i]) / exact - 1);
                (x[i] > 1e-3f ? worst : worst_small) =
                    std::max(x[i] > 1e-3f ? worst : worst_small, error);
            }
            EXPECT_LT(worst, 1e-6) << e << " " << hwy::TargetName(target);
            // A float holds log2(x) of a tiny x to 4e-6 only, and times e that is the error.
            EXPECT_LT(worst_small, 1e-5) << e << " " << hwy::TargetName(target);
        }
        const std::vector<float> ones(64, 1.0f);
        HWY_DYNAMIC_DISPATCH(powers)(ones.data(), 64, 0.85f, y.data());
        EXPECT_EQ(y[0], 1.0f) << hwy::TargetName(target);
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace
}  // namespace verdigris
#endif  // HWY_ONCE
