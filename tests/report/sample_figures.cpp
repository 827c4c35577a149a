// SPDX-License-Identifier: MIT
#include "sample_figures.h"

#include <cmath>
#include <limits>
#include <string>

namespace verdigris {
namespace {

// A repeatable wiggle in -1..1 that looks like noise.
double wiggle(double seed) {
    return std::sin(seed * 12.9898) * std::cos(seed * 78.233);
}

Figure horizons() {
    FigurePanel panel;
    panel.x.label = "Horizon (accelerated units)";
    panel.y = {"Masked MSE", AxisScale::log10};
    panel.y.format = {NumberStyle::significant, 3};
    double growth = 0.9;
    for (const char* name : {"affinergb", "affine, per channel", "single gain"}) {
        FigureSeries line{name, SeriesKind::line, {}}, band{name, SeriesKind::band, {}};
        for (double h = 1; h <= 85; h += h < 10 ? 1 : 5) {
            const double y = 2e-4 * std::pow(h, growth);
            line.points.push_back({h, y});
            band.points.push_back({h, y, Bounds{y * 0.8, y * 1.25}});
        }
        panel.series.push_back(band);
        panel.series.push_back(line);
        growth += 0.25;
    }
    panel.references = {{"persistence", 4.2e-3}};
    return {"horizons",
            "Error by horizon",
            "Masked MSE by horizon; bands: 95 % block bootstrap.",
            {panel}};
}

Figure blocks() {
    FigurePanel panel;
    panel.x.categories = {"block 1", "block 2", "block 3", "block 4", "block 5", "block 6"};
    panel.y = {"Gain over persistence"};
    panel.y.format = {NumberStyle::percent, 1, true};
    double seed = 1;
    for (const char* name : {"affinergb", "affine, per channel", "single gain"}) {
        FigureSeries points{name, SeriesKind::points, {}};
        for (int block = 0; block < 6; ++block, seed += 1) {
            const double y = 0.08 * wiggle(seed) + 0.03;
            points.points.push_back({double(block), y, Bounds{y - 0.02, y + 0.03}});
        }
        panel.series.push_back(points);
    }
    panel.references = {{"persistence (0 %)", 0}};
    return {"blocks", "Gain by block", "Gain over persistence in each independent block.", {panel}};
}

Figure drift() {
    FigurePanel movement;
    movement.title = "Movement of the mean color";
    movement.x.label = "Frame";
    movement.y.label = "Change of luma";
    FigureSeries specimen{"specimen", SeriesKind::line, {}};
    FigureSeries reference{"reference region", SeriesKind::line, {}, true};
    for (int frame = 0; frame < 980; frame += 4) {
        const double light = 0.01 * std::sin(frame / 130.0) + 0.001 * wiggle(frame);
        const double nan = std::numeric_limits<double>::quiet_NaN();
        specimen.points.push_back({double(frame), frame == 400 ? nan : light - frame * 1e-4});
        reference.points.push_back({double(frame), light});
    }
    movement.series = {specimen, reference};
    FigurePanel gains;
    gains.title = "Gain before and after the correction";
    gains.x.categories = {"none", "gain", "offset", "gain and offset"};
    gains.y.label = "Gain over persistence";
    gains.y.format = {NumberStyle::percent, 1, true};
    FigureSeries bars{"affinergb", SeriesKind::bars, {}},
        other{"single gain", SeriesKind::bars, {}};
    for (int i = 0; i < 4; ++i) {
        bars.points.push_back(
            {double(i), 0.064 - 0.01 * i, Bounds{0.03 - 0.01 * i, 0.1 - 0.01 * i}});
        other.points.push_back({double(i), -0.02 + 0.01 * i, Bounds{-0.05, 0.01 + 0.01 * i}});
    }
    gains.series = {bars, other};
    gains.references = {{"persistence (0 %)", 0}};
    return {"drift", "Drift of the camera", "Left: movement. Right: gains.", {movement, gains}};
}

Figure crowd() {
    FigurePanel panel;
    panel.x.label = "Horizon (accelerated units)";
    panel.y.label = "ΔE₀₀ < 2 & it's \"fine\"";
    for (int i = 0; i < 11; ++i) {
        FigureSeries line{
            "affine order " + std::to_string(i % 3) + " 'ridge' <" + std::to_string(i) + ">",
            SeriesKind::line,
            {}};
        for (int h = 1; h <= 40; ++h) line.points.push_back({double(h), 0.1 * h * (1 + 0.1 * i)});
        panel.series.push_back(line);
    }
    FigurePanel last = panel;
    last.title = "only one, on long names";
    last.x = {};
    last.x.categories = {"copper_chamber_2023.mp4", "copper_air_outdoor.mp4", "short"};
    last.series = {
        {"affine order 0 'ridge' <0>", SeriesKind::points, {{0, 1.0}, {1, 2.5}, {2, 0.5}}}};
    FigurePanel narrow = panel;
    narrow.title = "less than a decade";
    narrow.y.scale = AxisScale::log10;
    narrow.series.resize(2);
    for (FigureSeries& s : narrow.series) {
        for (FigurePoint& p : s.points) p.y = 2 + p.y / 2;
    }
    panel.title = "many";
    return {"crowd", "A crowd", "Eleven curves with long names.", {panel, last, narrow}};
}

}  // namespace

std::vector<Figure> sample_figures() {
    return {horizons(), blocks(), drift(), crowd()};
}

}  // namespace verdigris
