// SPDX-License-Identifier: MIT
#include "verdigris/deliver/manifest.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "verdigris/deliver/testing.h"
#include "verdigris/deliver/uncertainty_map.h"

namespace verdigris {
namespace {

using Json = nlohmann::ordered_json;

TEST(Manifest, SaysEverythingInAStableOrder) {
    const ScratchFolder folder;
    MadeDelivery made;
    made.delivery.facts = {{"source", R"({"name": "clip.mp4", "sha256": "00ff"})"},
                           {"options", R"({"zeta": 1, "alpha": [true, null]})"},
                           {"noise", R"({"sigma": 0.004, "tau": 0.01})"},
                           {"files", R"("not yours")"}};
    write_file(folder / "a.txt", std::string_view("abc"));
    write_file(folder / "sub" / "empty.bin", std::string_view(""));
    write_manifest(made.delivery, {"a.txt", folder / "sub" / "empty.bin"},
                   folder / "manifest.json");
    const std::string text = read_text(folder / "manifest.json");
    const Json manifest = Json::parse(text);
    std::vector<std::string> keys;
    for (const auto& [key, value] : manifest.items()) keys.push_back(key);
    EXPECT_EQ(keys, (std::vector<std::string>{"format", "version", "source", "options", "title",
                                              "stem", "forecaster", "explanation", "context",
                                              "units_observed", "unit", "horizons", "uncertainty",
                                              "guards", "origins", "noise", "files"}));
    EXPECT_EQ(manifest["format"], "verdigris-manifest/1");
    EXPECT_EQ(manifest["options"].dump(), R"({"zeta":1,"alpha":[true,null]})");
    EXPECT_EQ(manifest["noise"]["sigma"], 0.004);
    EXPECT_EQ(manifest["guards"][0]["severity"], "caution");
    EXPECT_TRUE(manifest["uncertainty"].is_null());  // this forecaster states none
    EXPECT_EQ(manifest["origins"].size(), map_origins(made.forecast).size());
    // FIPS 180-2's example, and the hash of nothing.
    EXPECT_EQ(manifest["files"][0].dump(),
              R"({"path":"a.txt","bytes":3,"sha256":)"
              R"("ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"})");
    EXPECT_EQ(manifest["files"][1].dump(),
              R"({"path":"sub/empty.bin","bytes":0,"sha256":)"
              R"("e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"})");
    write_manifest(made.delivery, {"a.txt", folder / "sub" / "empty.bin"}, folder / "again.json");
    EXPECT_EQ(read_text(folder / "again.json"), text);
    EXPECT_EQ(text.find(folder.path().string()), std::string::npos);
}

TEST(Manifest, SaysWhatTheMapOfUncertaintyIsDrawnTo) {
    const ScratchFolder folder;
    MadeDelivery made;
    made.forecast.spread.own = made.forecast.trajectory.base.clone();
    made.forecast.spread.nodes = {{20, 1e-4, 4e-4}};
    write_manifest(made.delivery, {}, folder / "manifest.json");
    const Json manifest = Json::parse(read_text(folder / "manifest.json"));
    EXPECT_EQ(manifest["uncertainty"].size(), 2u);
    EXPECT_EQ(manifest["uncertainty_full_codes"], uncertainty_full_codes(made.delivery));
    EXPECT_GE(manifest["uncertainty_full_codes"], 1);
}

TEST(Manifest, TauStandsInForAnUnknownNoise) {
    const ScratchFolder folder;
    const MadeDelivery made;
    write_manifest(made.delivery, {}, folder / "manifest.json");
    const Json manifest = Json::parse(read_text(folder / "manifest.json"));
    EXPECT_EQ(manifest["noise"].dump(), R"({"tau":0.01})");
    EXPECT_TRUE(manifest["files"].is_array());
}

TEST(Manifest, RefusesWhatIsNotThereOrNotJson) {
    const ScratchFolder folder;
    MadeDelivery made;
    EXPECT_THROW(write_manifest(made.delivery, {"gone.png"}, folder / "manifest.json"), Error);
    made.delivery.facts = {{"options", "{broken"}};
    EXPECT_THROW(write_manifest(made.delivery, {}, folder / "manifest.json"), Error);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    made.delivery.facts.clear();
    made.delivery.title = "</script>\"\n\xFF";
    EXPECT_NO_THROW(write_manifest(made.delivery, {}, folder / "manifest.json"));
    EXPECT_EQ(Json::parse(read_text(folder / "manifest.json"))["title"],
              "</script>\"\n\xEF\xBF\xBD");
}

}  // namespace
}  // namespace verdigris
