// SPDX-License-Identifier: MIT
#include "verdigris/simulate/specimen.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

double sum_of(const Image<double>& image) {
    return std::accumulate(image.pixels().begin(), image.pixels().end(), 0.0);
}

SimulationSpec plain() {
    SimulationSpec spec;
    spec.grid = 24;
    spec.susceptibility.spread = 0;
    return spec;
}

TEST(Specimen, SusceptibilityIsPositiveWithMeanOne) {
    for (const std::string& name : preset_names()) {
        SimulationSpec spec = preset_spec(name);
        spec.grid = 48;
        const Image<double> rho = susceptibility_field(spec, specimen_grid(spec));
        EXPECT_NEAR(sum_of(rho) / double(rho.pixel_count()), 1, 1e-9) << name;
        EXPECT_GT(*std::min_element(rho.pixels().begin(), rho.pixels().end()), 0) << name;
    }
}

TEST(Specimen, SpreadIsTheDeviationOfTheLogarithm) {
    SimulationSpec spec = plain();
    spec.susceptibility.spread = 0.4;
    spec.susceptibility.fine_share = 0;  // two patterns may correlate by chance; one cannot
    const Image<double> rho = susceptibility_field(spec, specimen_grid(spec));
    double sum = 0, squares = 0;
    for (const double v : rho.pixels()) sum += std::log(v), squares += std::log(v) * std::log(v);
    const double n = double(rho.pixel_count()), mean = sum / n;
    EXPECT_NEAR(std::sqrt(squares / n - mean * mean), 0.4, 1e-9);
}

TEST(Specimen, AClosedFilmGrowsByTheClosedForm) {
    for (const double start : {1.0, 4.0, 12.0, 40.0}) {  // every regime, and crossings
        SimulationSpec spec = plain();
        spec.oxide.initial_nm = start;
        spec.oxide.growth.parabolic_rate = 8;
        Specimen specimen(spec);
        specimen.advance_to(60);
        const GrowthLaw law(spec.oxide.growth);
        const double expected = law.grow(start, 60);
        for (const double nm : specimen.film_nm().pixels()) ASSERT_NEAR(nm, expected, 1e-7);
    }
}

TEST(Specimen, SusceptibilityAndPaceScaleTheExposure) {
    SimulationSpec spec = plain();
    spec.susceptibility.spread = 0.3;
    spec.environment.noise = 0.3;
    spec.oxide.initial_nm = 6;
    spec.oxide.growth.parabolic_rate = 3;
    Specimen specimen(spec);
    specimen.advance_to(40);
    const GrowthLaw law(spec.oxide.growth);
    const double pace = specimen.environment().exposure(0, 40);
    EXPECT_NE(pace, 40);
    for (std::size_t i = 0; i < specimen.film_nm().pixel_count(); i += 7) {
        const double rho = specimen.susceptibility().pixels()[i];
        EXPECT_NEAR(specimen.film_nm().pixels()[i], law.grow(6, pace * rho), 1e-6);
    }
}

TEST(Specimen, FilmsNeverGetThinner) {
    for (const std::string& name : preset_names()) {
        SimulationSpec spec = preset_spec(name);
        spec.grid = 24;
        Specimen specimen(spec);
        std::vector<double> film(specimen.film_nm().pixel_count(), 0.0), green = film;
        for (double unit = 0; unit < 98; unit += 7.3) {
            specimen.advance_to(unit);
            for (std::size_t i = 0; i < film.size(); ++i) {
                ASSERT_GE(specimen.film_nm().pixels()[i], film[i]) << name;
                ASSERT_GE(specimen.patina_um().pixels()[i], green[i]) << name;
                ASSERT_GE(specimen.coverage().pixels()[i], 0) << name;
                ASSERT_LE(specimen.coverage().pixels()[i], 1) << name;
                film[i] = specimen.film_nm().pixels()[i];
                green[i] = specimen.patina_um().pixels()[i];
            }
        }
    }
}

TEST(Coverage, WithoutDiffusionItIsTheLogisticCurve) {
    const CellGrid grid = cell_grid(1, 1, 8);
    Image<double> theta(8, 8), scratch(8, 8), rho(8, 8);
    std::fill(theta.pixels().begin(), theta.pixels().end(), 0.02);
    std::fill(rho.pixels().begin(), rho.pixels().end(), 1.0);
    for (int i = 0; i < 400; ++i) spread_coverage(theta, scratch, rho, grid, 0, 0.12, 0.1);
    const double expected = 1 / (1 + (1 / 0.02 - 1) * std::exp(-0.12 * 40));
    for (const double v : theta.pixels()) EXPECT_NEAR(v, expected, 0.004);
}

TEST(Coverage, DiffusionKeepsTheAmountAndWidensABump) {
    const CellGrid grid = cell_grid(1, 1, 64);
    Image<double> theta(64, 64), scratch(64, 64), rho(64, 64);
    const auto variance = [&] {
        double s = 0, sx = 0, sxx = 0;
        for (int y = 0; y < 64; ++y) {
            for (int x = 0; x < 64; ++x) {
                s += theta(x, y);
                sx += theta(x, y) * grid.x(x);
                sxx += theta(x, y) * grid.x(x) * grid.x(x);
            }
        }
        return sxx / s - sx / s * (sx / s);
    };
    theta(32, 32) = 1;
    const double before = variance();
    constexpr double kDiffusion = 2e-4;
    for (int i = 0; i < 100; ++i) spread_coverage(theta, scratch, rho, grid, kDiffusion, 0, 0.1);
    EXPECT_NEAR(sum_of(theta), 1, 1e-12);
    EXPECT_NEAR(variance() - before, 2 * kDiffusion * 10, 1e-7);
}

TEST(Coverage, AnyDiffusionIsStable) {
    const CellGrid grid = cell_grid(1, 1, 32);
    Image<double> theta(32, 32), scratch(32, 32), rho(32, 32);
    for (int i = 0; i < 1024; ++i) theta.pixels()[std::size_t(i)] = (i % 3 == 0) ? 1.0 : 0.0;
    const double mean = sum_of(theta) / 1024;
    // A thousand times what one explicit step would bear.
    const double fierce = 250 * grid.cell * grid.cell / 0.1;
    double spread = 1;
    for (int i = 0; i < 4; ++i) {
        spread_coverage(theta, scratch, rho, grid, fierce, 0, 0.1);
        const auto [least, most] =
            std::minmax_element(theta.pixels().begin(), theta.pixels().end());
        EXPECT_LE(*most - *least, spread + 1e-12);
        spread = *most - *least;
    }
    for (const double v : theta.pixels()) EXPECT_NEAR(v, mean, 1e-6);
}

TEST(Coverage, NucleiArriveAtTheirRateWhereRhoIsHigh) {
    SimulationSpec spec = preset_spec("spotted");
    spec.nucleation.seeds = 40;
    const CellGrid grid = specimen_grid(spec);
    const Image<double> rho = susceptibility_field(spec, grid);
    const auto nuclei = draw_nuclei(spec, grid, rho);
    // Thinned by min(rho, 4) / 4 of four times the rate.
    double mean = 0;
    for (const double v : rho.pixels()) mean += std::min(v, 4.0);
    mean /= double(rho.pixel_count());
    const double expected = 40 * spec.frames.units * grid.width * grid.height * mean;
    EXPECT_NEAR(double(nuclei.size()), expected, 4 * std::sqrt(expected));
    double on_nuclei = 0, last = 0;
    for (const Nucleus& n : nuclei) {
        EXPECT_GE(n.unit, last);
        last = n.unit;
        on_nuclei += rho(std::min(int(n.x / grid.cell), grid.columns - 1),
                         std::min(int(n.y / grid.cell), grid.rows - 1));
    }
    double squares = 0;
    for (const double v : rho.pixels()) squares += v * v;
    // Points drawn with density rho see rho with mean <rho^2>.
    EXPECT_NEAR(on_nuclei / double(nuclei.size()), squares / double(rho.pixel_count()), 0.05);
}

TEST(Specimen, GreenGrowsOnlyWhereItIsWetAndTheOxideIsThick) {
    SimulationSpec spec = plain();
    spec.susceptibility.spread = 0.5;
    spec.oxide.initial_nm = 100;
    spec.oxide.growth.parabolic_rate = 300;
    spec.patina.growth = {.rate = 0.1, .onset_nm = 180};
    Specimen specimen(spec);
    specimen.advance_to(60);
    int green = 0, bare = 0;
    for (std::size_t i = 0; i < specimen.film_nm().pixel_count(); ++i) {
        const bool thick = specimen.film_nm().pixels()[i] > 180;
        EXPECT_EQ(specimen.patina_um().pixels()[i] > 0, thick);
        (thick ? green : bare)++;
    }
    EXPECT_GT(green, 10);
    EXPECT_GT(bare, 10);
}

TEST(Specimen, StepsOfACallerDoNotMatter) {
    SimulationSpec spec = preset_spec("spotted");
    spec.grid = 32;
    Specimen once(spec), often(spec);
    once.advance_to(30);
    for (double unit = 0; unit < 30; unit += 0.1) often.advance_to(unit);
    often.advance_to(30);
    for (std::size_t i = 0; i < once.film_nm().pixel_count(); ++i)
        ASSERT_NEAR(once.film_nm().pixels()[i], often.film_nm().pixels()[i], 1e-9);
}

TEST(Specimen, TheSameAtAnyThreadCount) {
    SimulationSpec spec = preset_spec("patina");
    spec.grid = 40;
    std::vector<Image<LinearF>> colors;
    for (const int threads : {1, 3}) {
        set_thread_count(threads);
        Specimen specimen(spec);
        specimen.advance_to(50);
        colors.push_back(specimen.color());
    }
    set_thread_count(0);
    EXPECT_TRUE(std::equal(colors[0].pixels().begin(), colors[0].pixels().end(),
                           colors[1].pixels().begin()));
}

}  // namespace
}  // namespace verdigris
