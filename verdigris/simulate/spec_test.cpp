// SPDX-License-Identifier: MIT
#include "verdigris/simulate/spec.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "verdigris/error.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/files/testing.h"
#include "verdigris/simulate/effort.h"
#include "verdigris/simulate/spec_fields.h"
#include "verdigris/simulate/spec_file.h"

namespace verdigris {
namespace {

class SpecFile : public testing::Test {
  protected:
    SimulationSpec read(const std::string& text, const std::string& fallback = "uniform") {
        write_file(folder_.path() / "my.toml", text);
        return read_spec(folder_.path() / "my.toml", fallback);
    }
    /// The sentence, from "my.toml" on.
    std::string refused(const std::string& text) {
        try {
            read(text);
        } catch (const Error& e) {
            EXPECT_EQ(e.code(), ErrorCode::bad_input) << e.what();
            const std::string what = e.what();
            EXPECT_EQ(what.find('\n'), std::string::npos) << what;
            return what.substr(what.find("my.toml"));
        }
        return "nothing was refused";
    }
    ScratchFolder folder_;
};

TEST(Spec, EveryPresetIsAllowed) {
    for (const std::string& name : preset_names()) {
        EXPECT_NO_THROW(check_spec(preset_spec(name))) << name;
        EXPECT_NO_THROW(check_spec(full_size(preset_spec(name)))) << name;
        EXPECT_EQ(preset_spec(name).preset, name);
    }
    EXPECT_THROW(preset_spec("mars"), Error);
}

TEST(Spec, FullSizeIsWhatThePapersCamerasRecorded) {
    const FrameSpec chamber = full_size(preset_spec("chamber")).frames;
    EXPECT_EQ(chamber.width, 1920);
    EXPECT_EQ(chamber.height, 1080);
    EXPECT_EQ(chamber.count / chamber.fps, 601);
    const FrameSpec air = full_size(preset_spec("air")).frames;
    EXPECT_EQ(air.width, 720);
    EXPECT_EQ(air.height, 1280);
    EXPECT_EQ(air.count / air.fps, 482);
}

TEST(Spec, KeysAreUniqueAndExplained) {
    SimulationSpec spec;
    std::set<std::string> names;
    for (const SpecField& field : spec_fields(spec)) {
        EXPECT_TRUE(names.insert(field.name()).second) << field.name();
        EXPECT_TRUE(complaint(field).empty()) << complaint(field);
        EXPECT_LE(field.least, field.most) << field.name();
    }
    EXPECT_GT(names.size(), 70u);
}

TEST_F(SpecFile, TheResolvedSpecReadsBackAsTheSameSpec) {
    for (const std::string& name : preset_names()) {
        SimulationSpec spec = preset_spec(name);
        spec.seed = 123456789012345;
        spec.oxide.growth.parabolic_rate = 0.1 + 0.2;  // not a round number
        spec.camera.drift_gain = {1.03, 0.97, 1};
        const std::string text = spec_text(spec);
        EXPECT_EQ(spec_text(read(text, "chamber")), text) << name;
    }
}

TEST_F(SpecFile, KeysOfTheFileGoOverThePreset) {
    const SimulationSpec spec = read(
        "preset = \"air\"\nseed = 3\n[oxide]\ninitial_nm = 8\nthin_film = "
        "\"inverse_logarithmic\"\n[scene]\nmount = false\n");
    EXPECT_EQ(spec.seed, 3u);
    EXPECT_EQ(spec.oxide.initial_nm, 8);
    EXPECT_EQ(spec.oxide.growth.thin_film, ThinFilmLaw::inverse_logarithmic);
    EXPECT_FALSE(spec.scene.mount);
    EXPECT_EQ(spec.frames.width, preset_spec("air").frames.width);
    EXPECT_EQ(read("seed = 1\n", "spotted").nucleation.initial, 0);
}

TEST_F(SpecFile, ABadSpecIsRefusedNamingKeyLineAndRange) {
    EXPECT_EQ(refused("seed = 1\n\n[oxide]\ninitial_nm = -3\n"),
              "my.toml, line 4: oxide.initial_nm is -3; allowed are 0 to 5000");
    EXPECT_EQ(refused("[oxide]\ninitial_nm = nan\n"),
              "my.toml, line 2: oxide.initial_nm is nan; allowed are 0 to 5000");
    EXPECT_NE(refused("[oxide]\ninitial_mm = 3\n")
                  .find("line 2: there is no key in [oxide] 'initial_mm' (did you mean "
                        "'initial_nm'?); allowed are initial_nm, "),
              std::string::npos);
    EXPECT_NE(refused("[oxyde]\ninitial_nm = 3\n")
                  .find("line 1: there is no section 'oxyde' (did you mean 'oxide'?)"),
              std::string::npos);
    EXPECT_NE(refused("sede = 3\n").find("line 1: there is no key 'sede' (did you mean 'seed'?)"),
              std::string::npos);
    EXPECT_EQ(refused("[scene]\nmount = 1\n"),
              "my.toml, line 2: scene.mount is 1; allowed are true and false");
    EXPECT_EQ(refused("[frames]\ncount = 1.5\n"),
              "my.toml, line 2: frames.count is 1.5; allowed are whole numbers from 2 to 1000000");
    EXPECT_EQ(refused("[frames]\ncount = 99999999999\n"),
              "my.toml, line 2: frames.count is 99999999999; allowed are whole numbers from 2 to "
              "1000000");
    EXPECT_EQ(refused("seed = -1\n").substr(0, 27), "my.toml, line 1: seed is -1");
    EXPECT_EQ(refused("[susceptibility]\npattern = \"stripes\"\n"),
              "my.toml, line 2: susceptibility.pattern is 'stripes'; allowed are \"gaussian\" and "
              "\"reaction_diffusion\"");
    EXPECT_EQ(refused("[camera]\ndrift_gain = [1, 2]\n"),
              "my.toml, line 2: camera.drift_gain is a list of 2; allowed are three numbers, each "
              "0.01 to 100");
    EXPECT_NE(refused("[camera]\ndrift_gain = [1, 2, 300]\n").find("each 0.01 to 100"),
              std::string::npos);
    EXPECT_NE(refused("preset = \"mars\"\n").find("line 1: preset is 'mars'; allowed are"),
              std::string::npos);
    EXPECT_NE(refused("[oxide\n").find("line 1: is not TOML"), std::string::npos);
    EXPECT_NE(refused("seed = [1, 2]\n").find("seed is a list"), std::string::npos);
    EXPECT_NE(
        refused("oxide = 3\n").find("line 1: oxide is no value; allowed is a section, [oxide]"),
        std::string::npos);
    EXPECT_NE(
        refused("[camera]\nbits = 12\n").find("line 2: camera.bits is 12; allowed are 8 and 16"),
        std::string::npos);
    EXPECT_NE(refused("[oxide]\nfresh_nm = 200\n").find("line 2: oxide.fresh_nm is 200"),
              std::string::npos);
    EXPECT_NE(refused("[scene]\nwidth = 0.05\nheight = 8\n").find("up to 20 times"),
              std::string::npos);
}

TEST_F(SpecFile, HostileFilesGetASentenceToo) {
    std::string dots = "a";
    for (int i = 0; i < 50000; ++i) dots += ".a";
    EXPECT_NE(refused(dots + " = 1\n").find("line 1: is not a spec"), std::string::npos);
    EXPECT_LT(
        refused("preset = \"air\"\n[oxide]\nthin_film = \"" + std::string(100000, 'x') + "\"\n")
            .size(),
        300u);
    const std::string escaped = refused("[oxide]\n\"\\u001b[31mred\" = 1\n");
    EXPECT_EQ(escaped.find('\x1b'), std::string::npos) << escaped;
    EXPECT_LT(refused(std::string(200000, 'k') + " = 1\n").size(), 1500u);
    std::string nested = "seed = ";
    for (int i = 0; i < 5000; ++i) nested += "[";
    EXPECT_NE(refused(nested).find("is not TOML"), std::string::npos);
}

TEST(Spec, TheEffortOfAPresetIsMinutesAndOfAnExtremeOneIsSaid) {
    for (const std::string& name : preset_names()) {
        const Effort effort = estimated_effort(preset_spec(name));
        EXPECT_LT(effort.hours, 0.1) << name;
        EXPECT_LT(effort.gigabytes, 0.5) << name;
        EXPECT_LT(estimated_effort(full_size(preset_spec(name))).hours, 4) << name;
    }
    SimulationSpec spec = preset_spec("spotted");
    spec.grid = 1024;
    spec.nucleation.diffusion = 0.01;
    const Effort effort = estimated_effort(spec);
    EXPECT_GT(effort.hours, 1);
    EXPECT_EQ(effort.mostly, "grid with nucleation.diffusion and nucleation.growth");
}

TEST_F(SpecFile, AnOpticalTableIsReadWhereTheSpecNamesIt) {
    std::string rows = "wavelength_nm,n,k\n";
    for (int nm = 370; nm <= 790; nm += 10) rows += std::to_string(nm) + ",0.2,3.5\n";
    write_file(folder_.path() / "silver.csv", rows);
    const SimulationSpec spec = read("[oxide]\nmetal_table = \"silver.csv\"\n");
    EXPECT_EQ(spec.oxide.metal_table, folder_.path() / "silver.csv");
    // The resolved spec means the same table wherever it is written.
    std::filesystem::create_directory(folder_ / "elsewhere");
    write_file(folder_ / "elsewhere" / "resolved.toml", spec_text(spec));
    EXPECT_EQ(read_spec(folder_ / "elsewhere" / "resolved.toml", "air").oxide.metal_table,
              spec.oxide.metal_table);
    EXPECT_NE(refused("[oxide]\nmetal_table = \"gold.csv\"\n")
                  .find("line 2: oxide.metal_table cannot be used: "),
              std::string::npos);
    write_file(folder_.path() / "short.csv", std::string("wavelength_nm,n,k\n400,1,1\n500,1,1\n"));
    EXPECT_NE(refused("[oxide]\n\nmetal_table = \"short.csv\"\n").find("line 3: oxide.metal_table"),
              std::string::npos);
    write_file(folder_.path() / "text.csv", std::string("a letter, not a table\n"));
    EXPECT_NE(refused("[oxide]\nmetal_table = \"text.csv\"\n").find("line 2: oxide.metal_table"),
              std::string::npos);
}

}  // namespace
}  // namespace verdigris
