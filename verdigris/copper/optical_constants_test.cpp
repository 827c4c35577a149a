// SPDX-License-Identifier: MIT
#include "verdigris/copper/optical_constants.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>

#include "verdigris/files/atomic_file.h"
#include "verdigris/files/testing.h"

namespace verdigris {
namespace {

std::string refusal(const std::string& text) {
    const ScratchFolder folder;
    write_file(folder / "mine.csv", text);
    const Error error = error_of([&] { read_optical_constants(folder / "mine.csv"); });
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    EXPECT_NE(error.where().find("mine.csv"), std::string::npos) << error.what();
    return error.what();
}

bool says(const std::string& message, const std::string& part) {
    return message.find(part) != std::string::npos;
}

TEST(OpticalConstants, BuiltInTablesAreTheFilesOfTheRepository) {
    const std::filesystem::path data = VERDIGRIS_COPPER_DATA;
    const std::pair<const char*, const OpticalConstants&> tables[] = {
        {"copper.csv", copper_constants()},
        {"cuprous_oxide.csv", cuprous_oxide_constants()},
        {"cupric_oxide.csv", cupric_oxide_constants()}};
    for (const auto& [file, table] : tables) {
        const OpticalConstants read = read_optical_constants(data / file);
        ASSERT_EQ(read.rows().size(), table.rows().size());
        EXPECT_EQ(read.rows().size(), 41u);
        for (std::size_t i = 0; i < read.rows().size(); ++i) {
            EXPECT_EQ(read.rows()[i].wavelength_nm, table.rows()[i].wavelength_nm);
            EXPECT_EQ(read.rows()[i].n, table.rows()[i].n);
            EXPECT_EQ(read.rows()[i].k, table.rows()[i].k);
        }
    }
}

TEST(OpticalConstants, BuiltInTablesAreTheSourcesInterpolated) {
    const std::filesystem::path shared = std::filesystem::path(VERDIGRIS_SHARED_DATA) / "optical";
    if (!std::filesystem::exists(shared)) GTEST_SKIP() << "no " << shared;
    const std::pair<const char*, const OpticalConstants&> tables[] = {
        {"nk_Cu_McPeak.csv", copper_constants()},
        {"nk_Cu2O_SOPRA.csv", cuprous_oxide_constants()},
        {"nk_CuO_SOPRA.csv", cupric_oxide_constants()}};
    for (const auto& [file, table] : tables) {
        const OpticalConstants source = read_optical_constants(shared / file);
        for (const auto& row : table.rows()) {
            EXPECT_NEAR(source.at(row.wavelength_nm).real(), row.n, 5.01e-4) << file;
            EXPECT_NEAR(source.at(row.wavelength_nm).imag(), row.k, 5.01e-4) << file;
        }
    }
}

TEST(OpticalConstants, InterpolateLinearlyAndHitTheNodes) {
    const OpticalConstants table("t", {{400, 1, 0}, {500, 2, 1}, {700, 3, 0.5}});
    EXPECT_EQ(table.at(400), std::complex<double>(1, 0));
    EXPECT_EQ(table.at(500), std::complex<double>(2, 1));
    EXPECT_EQ(table.at(700), std::complex<double>(3, 0.5));
    EXPECT_NEAR(table.at(425).real(), 1.25, 1e-15);
    EXPECT_NEAR(table.at(600).imag(), 0.75, 1e-15);
}

TEST(OpticalConstants, NeverExtrapolate) {
    for (double nm : {379.9, 780.1, std::numeric_limits<double>::quiet_NaN()}) {
        const Error error = error_of([&] { copper_constants().at(nm); });
        EXPECT_EQ(error.code(), ErrorCode::bad_input);
        EXPECT_EQ(error.where(), "copper");
        EXPECT_TRUE(says(error.what(), "380 to 780 nm")) << error.what();
    }
}

TEST(OpticalConstants, ATableInMicrometersIsRead) {
    const ScratchFolder folder;
    write_file(folder / "um.csv", "# note\nwavelength_um, n ,k\n0.4,1.5,0\n0.8, 1.4 ,0.1\n");
    const OpticalConstants table = read_optical_constants(folder / "um.csv");
    EXPECT_NEAR(table.at(600).real(), 1.45, 1e-12);
    EXPECT_NEAR(table.at(600).imag(), 0.05, 1e-12);
}

TEST(OpticalConstants, ABadTableIsRefusedWithLineAndRange) {
    const std::string head = "# comment\nwavelength_nm,n,k\n400,1,1\n";
    std::string said = refusal(head + "500,-1,1\n");
    EXPECT_TRUE(says(said, "line 4") && says(said, "n = -1") && says(said, "up to 200")) << said;
    said = refusal(head + "500,1,-0.5\n");
    EXPECT_TRUE(says(said, "line 4") && says(said, "k = -0.5") && says(said, "0 to 200")) << said;
    said = refusal(head + "500,1,nan\n");
    EXPECT_TRUE(says(said, "line 4") && says(said, "k = nan")) << said;
    said = refusal(head + "500,one,1\n");
    EXPECT_TRUE(says(said, "line 4") && says(said, "column n holds \"one\"")) << said;
    said = refusal(head + "390,1,1\n");
    EXPECT_TRUE(says(said, "line 4") && says(said, "390 nm after 400 nm")) << said;
    said = refusal(head + "0.5,1,1\n");
    EXPECT_TRUE(says(said, "line 4") && says(said, "10 to 1000000 nm")) << said;
    EXPECT_TRUE(says(refusal(head), "two are the least"));
    EXPECT_TRUE(says(refusal("nm,n,k\n1,2,3\n"), "wavelength_nm"));
}

}  // namespace
}  // namespace verdigris
