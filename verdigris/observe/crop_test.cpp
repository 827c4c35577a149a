// SPDX-License-Identifier: MIT
#include "verdigris/observe/crop.h"

#include <gtest/gtest.h>

#include "verdigris/color/convert.h"
#include "verdigris/observe/drift.h"
#include "verdigris/observe/testing/made_scene.h"

namespace verdigris {
namespace {

using testing::MadeScene;

Look look_of(const MadeScene& scene, int frames = 24) {
    Look look;
    look.frame_width = scene.width;
    look.frame_height = scene.height;
    look.decodable = frames;
    for (int i = 0; i < frames; ++i) {
        const Image<SrgbU8> bytes = scene.frame(i, frames);
        Image<SrgbF> image(scene.width, scene.height);
        for (std::size_t p = 0; p < image.pixel_count(); ++p) {
            image.pixels()[p] = srgb_from_u8(bytes.pixels()[p]);
        }
        look.frames.push_back(std::move(image));
        look.index.push_back(i);
    }
    return look;
}

// Of the plate, were it not tilted: the 1..99 % of a tilted plate's coordinates come near it.
Rect box_of(const MadeScene& s) {
    return {int(s.center_x - s.plate_width / 2), int(s.center_y - s.plate_height / 2),
            int(s.plate_width), int(s.plate_height)};
}

double overlap(Rect a, Rect b) {
    const double w = std::min(a.x + a.width, b.x + b.width) - std::max(a.x, b.x);
    const double h = std::min(a.y + a.height, b.y + b.height) - std::max(a.y, b.y);
    const double both = std::max(w, 0.0) * std::max(h, 0.0);
    return both / (double(a.width) * a.height + double(b.width) * b.height - both);
}

void expect_found(const MadeScene& scene, const char* what, int frames = 24) {
    SCOPED_TRACE(what);
    const Look look = look_of(scene, frames);
    const SpecimenFinding finding = find_specimen(look);
    ASSERT_EQ(finding.kind, SpecimenKind::found);
    const Mask truth = scene.truth();
    EXPECT_GE(testing::overlap(finding.mask, truth), 0.9);
    EXPECT_GE(overlap(finding.box, box_of(scene)), 0.9);
    const Rect crop = crop_around(finding.box, look);
    EXPECT_EQ(crop.width, crop.height);
    EXPECT_EQ(crop.width % 2, 0);
    EXPECT_GE(crop.x, 0);
    EXPECT_LE(crop.x + crop.width, scene.width);
    EXPECT_LE(crop.y + crop.height, scene.height);
}

TEST(FindSpecimen, FindsThePlateWhateverTheCameraDoes) {
    MadeScene scene;
    expect_found(scene, "plain");
    scene.tilt_degrees = 5;
    expect_found(scene, "tilted");
    scene.illumination_drift = 0.1;
    expect_found(scene, "tilted, light drifts");
    scene.glint = true;
    expect_found(scene, "tilted, light drifts, glint moves");
    scene.noise = 5.0 / 255;
    expect_found(scene, "and noisy");
    scene.illumination_drift = -0.1;
    scene.tilt_degrees = -5;
    expect_found(scene, "the other way");
    scene.darkening = 0.15;
    scene.noise = 2.0 / 255;
    expect_found(scene, "weak change");
    expect_found(scene, "few looks", 8);
}

TEST(FindSpecimen, FindsAPlateThatCoversMostOfTheFrame) {
    MadeScene scene;
    scene.center_x = 160;
    scene.center_y = 120;
    scene.plate_width = 260;
    scene.plate_height = 200;
    scene.illumination_drift = 0.1;
    const Look look = look_of(scene);
    const SpecimenFinding finding = find_specimen(look);
    EXPECT_GE(testing::overlap(finding.mask, scene.truth()), 0.9);
    const Rect crop = crop_around(finding.box, look);
    EXPECT_EQ(crop.height, 240);  // the square does not fit: the frame's extent
}

TEST(FindSpecimen, SaysWhenTheSpecimenFillsTheFrame) {
    MadeScene scene;
    scene.plate_width = scene.plate_height = 2000;
    const Look look = look_of(scene);
    const SpecimenFinding finding = find_specimen(look);
    EXPECT_EQ(finding.kind, SpecimenKind::fills_frame);
    const CropReport report = crop_report(finding, look);
    EXPECT_TRUE(report.fills_frame);
    EXPECT_EQ(report.rect, (Rect{0, 0, 320, 240}));
    EXPECT_NE(report.sentence.find("fills the frame"), std::string::npos);
}

TEST(FindSpecimen, AStillSceneIsUsedWhole) {
    MadeScene scene;
    scene.darkening = 0;
    const Look look = look_of(scene);
    const SpecimenFinding finding = find_specimen(look);
    EXPECT_EQ(finding.kind, SpecimenKind::still);
    EXPECT_EQ(crop_report(finding, look).rect, (Rect{0, 0, 320, 240}));
}

TEST(FindSpecimen, TwoPlatesAreAskedAbout) {
    MadeScene left, right;
    left.center_x = 80;
    right.center_x = 240;
    left.plate_width = right.plate_width = 80;
    Look look = look_of(left);
    const Look other = look_of(right);
    const Mask truth = right.truth();
    for (std::size_t i = 0; i < look.frames.size(); ++i) {
        for (std::size_t p = 0; p < truth.pixel_count(); ++p) {
            if (truth.pixels()[p] == kInside) {
                look.frames[i].pixels()[p] = other.frames[i].pixels()[p];
            }
        }
    }
    const SpecimenFinding finding = find_specimen(look);
    EXPECT_EQ(finding.kind, SpecimenKind::ambiguous);
    const CropReport report = crop_report(finding, look);
    EXPECT_NE(report.sentence.find("--crop"), std::string::npos);
    EXPECT_NE(report.sentence.find(std::to_string(report.rect.x) + ","), std::string::npos);
}

TEST(FindSpecimen, ASmallOneIsAskedAbout) {
    MadeScene scene;
    scene.plate_width = 36;
    scene.plate_height = 36;  // 1.7 % of the frame
    EXPECT_EQ(find_specimen(look_of(scene)).kind, SpecimenKind::ambiguous);
}

TEST(FindSpecimen, TellsTheGainOfTheUnchangingMajority) {
    MadeScene scene;
    scene.illumination_drift = 0.1;
    const SpecimenFinding finding = find_specimen(look_of(scene, 25));
    ASSERT_EQ(finding.gains.size(), 25u);
    // The first median of four frames sits at progress 1.5 / 24.
    const double start = 1 + 0.1 * std::sin(6.283185307 * 1.5 / 24);
    EXPECT_NEAR(finding.gains[6].level(), 1.1 / start, 0.004);
    EXPECT_NEAR(finding.gains[18].level(), 0.9 / start, 0.004);
    const Drift drift = measure_drift(finding);
    EXPECT_TRUE(drift.known);
    EXPECT_NEAR(drift.exposure, 1 - 0.9 / start, 0.005);
    EXPECT_LT(drift.white_balance, 0.003);
}

TEST(FindSpecimen, BlackAndUniformPicturesAreNoTrouble) {
    for (const float level : {0.0f, 0.5f, 1.0f}) {
        Look look;
        look.frame_width = look.frame_height = 32;
        for (int i = 0; i < 8; ++i) {
            Image<SrgbF> image(32, 32);
            for (auto& c : image.pixels()) c = {level, level, level};
            look.frames.push_back(std::move(image));
            look.index.push_back(i);
        }
        EXPECT_EQ(find_specimen(look).kind, SpecimenKind::still);
    }
}

TEST(CropAround, StaysInsideOddFrames) {
    Look look;
    look.frame_width = 161;
    look.frame_height = 121;
    look.frames.emplace_back(161, 121);
    for (const Rect box :
         {Rect{0, 0, 20, 20}, Rect{140, 100, 20, 20}, Rect{0, 0, 161, 121}, Rect{80, 0, 3, 121}}) {
        const Rect crop = crop_around(box, look);
        EXPECT_GE(crop.x, 0);
        EXPECT_GE(crop.y, 0);
        EXPECT_LE(crop.x + crop.width, 161);
        EXPECT_LE(crop.y + crop.height, 121);
        EXPECT_LE(crop.x, box.x);
        EXPECT_GE(crop.x + crop.width, box.x + box.width);
    }
}

}  // namespace
}  // namespace verdigris
