// SPDX-License-Identifier: MIT
#include "verdigris/evaluate/near_copy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "verdigris/error.h"
#include "verdigris/evaluate/evaluate.h"
#include "verdigris/evaluate/testing.h"

namespace verdigris {
namespace {

using testing::normal;

/// Grain of a plate at a place of the frame, both in [0, 1]: spots of about a 30th of the frame.
double spots(std::uint64_t seed, double u, double v) {
    const double x = u * 60, y = v * 60;
    const auto value = [&](double i, double j) {
        return normal((seed * 1000 + std::uint64_t(j + 100)) * 1000 + std::uint64_t(i + 100));
    };
    const double i = std::floor(x), j = std::floor(y), a = x - i, b = y - j;
    return (1 - b) * ((1 - a) * value(i, j) + a * value(i + 1, j)) +
           b * ((1 - a) * value(i, j + 1) + a * value(i + 1, j + 1));
}

/// What a camera with a frame of 200 x 100 makes of it: `crop` at `size` x `size` samples. A plate
/// in the middle, a backdrop with a pattern of its own that every recording of this rig shows.
Observation seen(std::uint64_t plate, Rect crop, int size, double sigma = 0,
                 std::uint64_t noise = 0) {
    const auto place = [=](int x, int y) {
        return std::pair(crop.x + crop.width * (x + 0.5) / size,
                         crop.y + crop.height * (y + 0.5) / size);
    };
    const auto on_plate = [=](int x, int y) {
        const auto [u, v] = place(x, y);
        return u > 50 && u < 150 && v > 10 && v < 90;
    };
    Observation o = testing::observed("", size, size, 30, [=](int x, int y, int t) {
        const auto [u, v] = place(x, y);
        const double grain = 0.02 * spots(on_plate(x, y) ? plate : 99, u / 200, v / 100);
        // Brighter on the left, and darker with time: light, shape and age, which all plates share.
        double level = (on_plate(x, y) ? 0.6 : 0.2) - 0.001 * u - 0.003 * t + grain;
        if (sigma > 0) {
            level +=
                sigma * normal(((noise * 64 + std::uint64_t(t)) * 512 + std::uint64_t(y)) * 512 +
                               std::uint64_t(x));
        }
        return SrgbF{float(level), float(0.7 * level), float(0.6 * level)};
    });
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) o.specimen(x, y) = on_plate(x, y) ? kInside : 0;
    }
    o.crop.rect = crop;
    o.crop.frame_width = 200;
    o.crop.frame_height = 100;
    return o;
}

constexpr Rect kFrame{0, 0, 200, 100};

double likeness(const Observation& a, const Observation& b) {
    return surface_likeness(surface_print(a, {0, a.store->count()}),
                            surface_print(b, {0, b.store->count()}));
}

TEST(NearCopy, ARecordingIsItsOwnCopy) {
    EXPECT_NEAR(likeness(seen(1, kFrame, 128), seen(1, kFrame, 128)), 1, 1e-9);
}

TEST(NearCopy, AnotherSizeNoiseAndCropAreStillACopy) {
    const Observation original = seen(1, kFrame, 128, 0.003, 1);
    EXPECT_GT(likeness(original, seen(1, kFrame, 64, 0.006, 2)), 0.8);
    EXPECT_GT(likeness(original, seen(1, {40, 5, 120, 90}, 128, 0.003, 3)), 0.8);
    EXPECT_GT(likeness(seen(1, {30, 0, 100, 100}, 128), seen(1, {80, 8, 110, 80}, 128)), 0.8);
    // Twice the frame, in pixels, is the same frame.
    Observation twice = seen(1, kFrame, 128);
    twice.crop.rect = {0, 0, 400, 200};
    twice.crop.frame_width = 400;
    twice.crop.frame_height = 200;
    EXPECT_GT(likeness(original, twice), 0.8);
}

TEST(NearCopy, AnotherPlateInTheSameRigIsNot) {
    for (std::uint64_t other = 2; other < 12; ++other) {
        EXPECT_LT(likeness(seen(1, kFrame, 128, 0.003, 1), seen(other, kFrame, 128, 0.003, 2)),
                  0.35)
            << other;
    }
    // The backdrop's pattern alone would say that it is.
    Observation a = seen(1, kFrame, 128), b = seen(2, kFrame, 128);
    for (Observation* o : {&a, &b}) {
        for (auto& m : o->specimen.pixels()) m = std::uint8_t(kInside - m);
    }
    EXPECT_GT(likeness(a, b), 0.9);
}

TEST(NearCopy, TooLittleToTellIsNoCopy) {
    EXPECT_EQ(likeness(seen(1, kFrame, 40), seen(1, kFrame, 40)), 0);
    EXPECT_EQ(likeness(seen(1, {0, 0, 60, 100}, 128), seen(1, {140, 0, 60, 100}, 128)), 0);
}

TEST(NearCopy, IsRefusedByAnEvaluationAndFoundByAnAudit) {
    EvaluationProtocol p = short_recording_protocol(1);
    p.delta_e = false;
    std::vector<Observation> list;
    list.push_back(seen(1, kFrame, 64, 0.001, 1));
    list.push_back(seen(1, kFrame, 72, 0.001, 2));
    list[0].source_name = "plate";
    list[1].source_name = "smaller";
    list[0].source_sha256 = "a";
    list[1].source_sha256 = "b";
    try {
        evaluate(p, list, {});
        FAIL() << "not refused";
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::refused);
        EXPECT_NE(e.sentence().find("plate and smaller show one specimen"), std::string::npos)
            << e.sentence();
    }
    list[1] = seen(2, kFrame, 72, 0.001, 2);
    list[1].source_name = "other";
    Evaluation fine = evaluate(p, list, {});
    EXPECT_TRUE(audit(fine.record).empty());
    fine.record.recordings[1].surface = fine.record.recordings[0].surface;
    const Statuses found = audit(fine.record);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].id, "near_copy_of_recording");
}

}  // namespace
}  // namespace verdigris
