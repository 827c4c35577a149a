// SPDX-License-Identifier: MIT
#include "verdigris/simulate/truth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>

#include "verdigris/files/atomic_file.h"
#include "verdigris/files/csv.h"
#include "verdigris/files/image_file.h"
#include "verdigris/files/testing.h"

namespace verdigris {
namespace {

SimulationSpec small() {
    SimulationSpec spec = preset_spec("patina");
    spec.seed = 9;
    spec.grid = 20;
    spec.frames.width = 60;
    spec.frames.height = 40;
    spec.frames.count = 30;
    spec.frames.units = 5.5;
    return spec;
}

TEST(Truth, EverythingInTheIndexIsThereAndIsWhatTheSimulationHad) {
    ScratchFolder folder;
    const SimulationSpec spec = small();
    TruthWriter truth(spec, folder / "truth");
    Image<double> last;
    std::size_t states = 0;
    const SimulationResult result =
        simulate(spec, {.frame8 = {}, .frame16 = {}, .state = [&](const Specimen& s) {
                            truth.add(s);
                            last = s.film_nm().clone();
                            ++states;
                        }});
    EXPECT_FALSE(std::filesystem::exists(folder / "truth" / "truth.json"));
    truth.commit(result, "plate.mp4");
    const auto index = nlohmann::json::parse(read_text(folder / "truth" / "truth.json"));
    EXPECT_EQ(index["recording"], "plate.mp4");
    EXPECT_EQ(index["seed"], 9);
    for (const auto& entry : index["arrays"]) {
        const std::string name = entry["file"];
        const auto path = folder / "truth" / name;
        ASSERT_TRUE(std::filesystem::exists(path)) << name;
        if (!name.ends_with(".npy")) continue;
        EXPECT_EQ(NpyFile(path).shape(), entry["shape"].get<std::vector<std::size_t>>()) << name;
    }
    EXPECT_EQ(states, 7u);  // 0 to 5, and the end at 5.5
    const NpyFile film(folder / "truth" / "cells" / "film_nm.npy");
    const auto values = film.values<float>();
    for (std::size_t i = 0; i < last.pixel_count(); ++i)
        EXPECT_EQ(values[values.size() - last.pixel_count() + i], float(last.pixels()[i]));
    const CsvTable gains = read_csv(folder / "truth" / "gains.csv");
    ASSERT_EQ(gains.rows.size(), 30u);
    EXPECT_NEAR(std::stod(gains.rows[10][std::size_t(gains.column("unit"))]),
                frame_unit(spec.frames, 10), 1e-6);
}

TEST(Truth, WithoutCommitNothingIsLeft) {
    ScratchFolder folder;
    {
        TruthWriter truth(small(), folder / "truth");
        simulate(small(),
                 {.frame8 = {}, .frame16 = {}, .state = [&](const Specimen& s) { truth.add(s); }});
    }
    EXPECT_EQ(entry_count(folder.path()), 0);
}

}  // namespace
}  // namespace verdigris
