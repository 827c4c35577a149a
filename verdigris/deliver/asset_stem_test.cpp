// SPDX-License-Identifier: MIT
#include "verdigris/deliver/asset_stem.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "verdigris/forecast/forecast_io.h"

namespace verdigris {
namespace {

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
bool is_lower(char c) {
    return c >= 'a' && c <= 'z';
}
bool is_upper(char c) {
    return c >= 'A' && c <= 'Z';
}

// [._-]1\d{3}\.png at the end: what is taken for a UDIM tile.
bool looks_like_udim(const std::string& file) {
    const std::size_t n = file.size();
    return n >= 9 && file.ends_with(".png") && is_digit(file[n - 5]) && is_digit(file[n - 6]) &&
           is_digit(file[n - 7]) && file[n - 8] == '1' &&
           std::string("._-").find(file[n - 9]) != std::string::npos;
}

// Node Wrangler again, step by step as its own source does it: which socket does a file name go
// to? The first in its order whose words meet.
std::string socket_of(std::string name) {
    static const std::vector<std::pair<std::string, std::string>> kSockets = {
        {"Displacement", "displacement displace disp dsp height heightmap"},
        {"Base Color", "diffuse diff albedo base col color basecolor"},
        {"Subsurface", "sss subsurface"},
        {"Metallic", "metallic metalness metal mtl"},
        {"Specular", "specularity specular spec spc"},
        {"Roughness", "roughness rough rgh"},
        {"Gloss", "gloss glossy glossiness glossyness"},
        {"Bump", "bump bmp"},
        {"Normal", "normal nor nrm nrml norm"},
        {"Transmission", "transmission transparency"},
        {"Emission", "emission emissive emit"},
        {"Alpha", "alpha opacity"},
        {"Ambient Occlusion", "ao ambient occlusion"}};
    name = name.substr(0, name.rfind('.'));
    name.erase(std::remove_if(name.begin(), name.end(), is_digit), name.end());
    for (std::size_t i = 1; i < name.size(); ++i) {
        if (is_lower(name[i - 1]) && is_upper(name[i])) name.insert(i++, " ");
    }
    for (char separator : std::string("_.-#")) {
        std::replace(name.begin(), name.end(), separator, ' ');
    }
    for (char& c : name) c = is_upper(c) ? char(c + 32) : c;
    std::istringstream words(name);
    std::set<std::string> in_name;
    for (std::string word; words >> word;) in_name.insert(word);
    for (const auto& [socket, tags] : kSockets) {
        std::istringstream list(tags);
        for (std::string tag; list >> tag;) {
            if (in_name.count(tag)) return socket;
        }
    }
    return "";
}

const std::vector<std::string> kNasty = {"copper_patinating",
                                         "Metal_Base_AO_01",
                                         "col",
                                         "\xE6\x97\xA5\xE6\x9C\xAC",
                                         "1001",
                                         "",
                                         "A O",
                                         "N-Or",
                                         "Me1tal",
                                         "metal2",
                                         "BaseColor",
                                         "base color",
                                         "Rough.Spec.Bump",
                                         "a1o",
                                         "IMG_20260301_1001",
                                         "clip.1001.mp4",
                                         "../../etc/passwd",
                                         "x\ny",
                                         "con",
                                         "COM1",
                                         "-rf",
                                         "Gr\xC3\xBCnspan \xC3\x84g\xC3\xA4is",
                                         "\xFF\xFE\x80",
                                         "ALLCAPSMETAL",
                                         "heightMap",
                                         "d i f f",
                                         "</script>",
                                         std::string(5000, 'a'),
                                         "spec_MTL_9",
                                         "alpha-emit#opacity",
                                         "NRM",
                                         "nrM",
                                         "aO"};

TEST(AssetStem, KnownAnswers) {
    EXPECT_EQ(asset_stem("copper_patinating"), "CopperPatinating");
    EXPECT_EQ(asset_stem("Metal_Base_AO_01"), "Specimen01");
    EXPECT_EQ(asset_stem("col"), "Specimen");
    EXPECT_EQ(asset_stem("\xE6\x97\xA5\xE6\x9C\xAC"), "Specimen");
    EXPECT_EQ(asset_stem("1001"), "Specimen1001");
    EXPECT_EQ(asset_stem(""), "Specimen");
    EXPECT_EQ(asset_stem("CuPlate07"), "CuPlate07");
    EXPECT_EQ(asset_stem("Gr\xC3\xBCnspan"), "Grunspan");
    EXPECT_EQ(asset_stem("con"), "SpecimenCon");
}

TEST(AssetStem, IsAnIdentifierOfBoundedLength) {
    for (const std::string& name : kNasty) {
        const std::string stem = asset_stem(name);
        EXPECT_TRUE(is_lower(stem[0]) || is_upper(stem[0])) << name << " -> " << stem;
        EXPECT_TRUE(std::all_of(stem.begin(), stem.end(),
                                [](char c) { return is_digit(c) || is_lower(c) || is_upper(c); }))
            << name << " -> " << stem;
        EXPECT_LE(stem.size(), 56u) << name;
        EXPECT_EQ(asset_stem(stem), stem) << name;
    }
}

TEST(AssetStem, EveryFileNameIsSortedToItsMap) {
    const std::map<std::string, std::string> maps = {{"Color", "Base Color"},
                                                     {"NormalGL", "Normal"},
                                                     {"NormalDX", "Normal"},
                                                     {"Roughness", "Roughness"},
                                                     {"Metalness", "Metallic"},
                                                     {"Displacement", "Displacement"},
                                                     {"ORM", ""}};
    for (const std::string& name : kNasty) {
        for (double horizon : {0.0, 5.0, 7.5, 1001.0}) {
            for (const char* size : {"", "_2K"}) {
                for (const auto& [map, socket] : maps) {
                    const std::string file =
                        asset_stem(name) + "_" + horizon_label(horizon) + size + "_" + map + ".png";
                    EXPECT_EQ(socket_of(file), socket) << file;
                    EXPECT_FALSE(looks_like_udim(file)) << file;
                }
            }
        }
    }
}

TEST(AssetStem, TheCheckItselfFindsBadNames) {
    EXPECT_EQ(socket_of("Metal_Color.png"), "Base Color");
    EXPECT_EQ(socket_of("Base_Roughness.png"), "Base Color");
    EXPECT_EQ(socket_of("WallTexture_diff_2k.002.png"), "Base Color");
    EXPECT_TRUE(looks_like_udim("Plate_1001.png"));
    EXPECT_FALSE(looks_like_udim("Plate_u1001.png"));
}

TEST(NodeWranglerWords, SplitsAsItDoes) {
    EXPECT_EQ(node_wrangler_words("WallTexture_diff_2k"),
              (std::vector<std::string>{"wall", "texture", "diff", "k"}));
    EXPECT_EQ(node_wrangler_words("Me1Tal#AO"), (std::vector<std::string>{"me", "tal", "ao"}));
}

}  // namespace
}  // namespace verdigris
