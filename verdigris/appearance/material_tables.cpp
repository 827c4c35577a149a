// SPDX-License-Identifier: MIT
// The tables and figures of judged materials.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "verdigris/appearance/material_report.h"
#include "verdigris/results/cells.h"

namespace verdigris {
namespace {

constexpr NumberFormat kFlip{NumberStyle::fixed, 4, false}, kSmall{NumberStyle::fixed, 2, false},
    kShare{NumberStyle::percent, 2, false};

TableCell mean_cell(const ErrorTable& table, std::size_t h) {
    return table.empty() ? TableCell() : finite_or_missing(horizon_means(table)[h]);
}

std::string column_id(const char* what, int horizon) {
    return fmt::format("{}_u{}", what, horizon);
}

}  // namespace

Table material_table(const MaterialJudgment& judgment,
                     const std::vector<MaterialDirectionVerdict>& list) {
    Table table;
    table.id = "materials";
    table.title = "Materials beside the true ones";
    table.caption = fmt::format(
        "Mean LDR-FLIP (lower is closer) between pictures of the forecast's material and of the "
        "true future frame's, {:.2f} pixels per degree, at horizons in units; its gain over the "
        "static control, a ratio of means, with the nominal 95 % interval of non-overlapping "
        "blocks where there are {} or more. persistence: the last observed frame, the static "
        "control; canvas: the median of the context; true-finish: no forecast, but the last "
        "frame's color on the true frame's roughness, metallic and normal.",
        judgment.options.pixels_per_degree, kFewBlocks);
    table.group_header = "direction";
    table.columns = {{"forecaster", "Forecaster", Align::left}};
    for (const int horizon : judgment.options.horizons) {
        table.columns.push_back(
            {column_id("flip", horizon), fmt::format("FLIP +{}", horizon), Align::right, kFlip});
        table.columns.push_back({column_id("gain", horizon), fmt::format("gain +{}", horizon),
                                 Align::right, kGain, true});
    }
    for (const MaterialDirectionVerdict& v : list) {
        RowGroup group;
        group.title = v.direction->label;
        for (std::size_t i = 0; i < v.direction->rows.size(); ++i) {
            const MaterialScores& s = v.direction->rows[i];
            TableRow row{TableCell(s.name)};
            for (std::size_t h = 0; h < judgment.options.horizons.size(); ++h) {
                row.push_back(mean_cell(s.flip, h));
                row.push_back(i == 0 ? TableCell() : cell_of(v.rows[i - 1][h].gain));
            }
            group.rows.push_back(std::move(row));
        }
        table.groups.push_back(std::move(group));
    }
    // The best forecast: true-finish is none.
    constexpr std::size_t kFinish = MaterialDirection::kControls - 1;
    for (RowGroup& group : table.groups) {
        for (std::size_t column = 1; column < table.columns.size(); column += 2) {
            double best = std::numeric_limits<double>::infinity();
            for (std::size_t i = 0; i < group.rows.size(); ++i)
                if (i != kFinish) best = std::min(best, group.rows[i][column].value());
            for (std::size_t i = 0; i < group.rows.size(); ++i)
                group.rows[i][column].set_best(i != kFinish &&
                                               group.rows[i][column].value() == best);
        }
    }
    return table;
}

Table material_measure_table(const MaterialJudgment& judgment,
                             const std::vector<MaterialDirectionVerdict>& list) {
    Table table;
    table.id = "materials-measures";
    table.title = "Every measure, and how the forecasts moved";
    table.caption =
        "Of the pictures: FLIP and CIEDE2000 (lower is closer), SSIM (higher), LPIPS (lower). Of "
        "the part of the frames that is shown: squared error; how far the forecast moved from the "
        "last observed frame over how far the true one did; the cosine between the two movements; "
        "pixels with a channel outside [0, 1] and channels outside, before any clamp. Means over "
        "windows.";
    table.note = judgment.options.lpips ? "" : "LPIPS: " + judgment.options.no_lpips;
    table.group_header = "direction";
    table.columns = {{"forecaster", "Forecaster", Align::left},
                     {"horizon", "horizon", Align::right, kCount},
                     {"flip", "FLIP", Align::right, kFlip},
                     {"ssim", "SSIM", Align::right, kFlip},
                     {"delta_e", "CIEDE2000", Align::right, kSmall},
                     {"lpips", "LPIPS", Align::right, kFlip},
                     {"error", "frame MSE", Align::right, kError},
                     {"moved", "moved", Align::right, kSmall},
                     {"agreement", "agreement", Align::right, kSmall},
                     {"outside_pixels", "pixels outside", Align::right, kShare},
                     {"outside_channels", "channels outside", Align::right, kShare}};
    for (const MaterialDirectionVerdict& v : list) {
        const MaterialDirection& d = *v.direction;
        RowGroup group;
        group.title = d.label;
        for (const MaterialScores& s : d.rows) {
            for (std::size_t h = 0; h < judgment.options.horizons.size(); ++h) {
                const double went = horizon_means(s.moved)[h] / horizon_means(d.truth_moved)[h];
                group.rows.push_back(
                    {TableCell(s.name), TableCell(judgment.options.horizons[h]),
                     mean_cell(s.flip, h), mean_cell(s.ssim, h), mean_cell(s.delta_e, h),
                     mean_cell(s.lpips, h), mean_cell(s.error, h), finite_or_missing(went),
                     finite_or_missing(mean_where_finite(s.agreement, h)),
                     mean_cell(s.outside_pixels, h), mean_cell(s.outside_channels, h)});
            }
        }
        table.groups.push_back(std::move(group));
    }
    return table;
}

Table material_fix_table(const MaterialJudgment& judgment,
                         const std::vector<MaterialDirectionVerdict>& list) {
    Table table;
    table.id = "materials-limits";
    table.title = "Do limits on the color help?";
    table.caption =
        "A forecaster whose colors may go anywhere against the same one kept inside the gamut "
        "(-clamped: a pixel's drift stops where a channel would leave [0, 1]) or inside the colors "
        "of the context (-in-range). Gain of the second less gain of the first, on the same "
        "windows: positive where the limit helps.";
    table.group_header = "direction";
    table.columns = {{"free", "Free", Align::left},
                     {"limited", "Limited", Align::left},
                     {"horizon", "horizon", Align::right, kCount},
                     {"flip_free", "FLIP, free", Align::right, kFlip},
                     {"flip_limited", "FLIP, limited", Align::right, kFlip},
                     {"difference", "difference of gains", Align::right, kGain, true}};
    for (const MaterialDirectionVerdict& v : list) {
        RowGroup group;
        group.title = v.direction->label;
        for (const FixVerdict& f : v.fixes)
            group.rows.push_back(
                {TableCell(f.free), TableCell(f.limited),
                 TableCell(judgment.options.horizons[f.horizon]), finite_or_missing(f.flip_free),
                 finite_or_missing(f.flip_limited),
                 std::isfinite(f.difference.value) ? cell_of(f.difference) : TableCell()});
        table.groups.push_back(std::move(group));
    }
    return table;
}

Table material_block_table(const MaterialJudgment& judgment,
                           const std::vector<MaterialDirectionVerdict>& list) {
    Table table;
    table.id = "materials-blocks";
    table.title = "Gains by block";
    table.caption =
        "Gain in FLIP over the static control of each block of windows by itself. Blocks are as "
        "long as a window that ends at the horizon.";
    table.group_header = "direction";
    table.columns = {{"forecaster", "Forecaster", Align::left},
                     {"horizon", "horizon", Align::right, kCount},
                     {"block", "Block", Align::left},
                     {"windows", "windows", Align::right, kCount},
                     {"gain", "gain", Align::right, kGain}};
    for (const MaterialDirectionVerdict& v : list) {
        RowGroup group;
        group.title = v.direction->label;
        for (std::size_t i = 0; i < v.rows.size(); ++i) {
            for (std::size_t h = 0; h < v.rows[i].size(); ++h) {
                for (const BlockGain& b : v.rows[i][h].gain.blocks)
                    group.rows.push_back(
                        {TableCell(v.direction->rows[i + 1].name),
                         TableCell(judgment.options.horizons[h]),
                         TableCell(fmt::format("samples {} to {}", b.first_start, b.last_start)),
                         TableCell(b.windows), finite_or_missing(b.value)});
            }
        }
        table.groups.push_back(std::move(group));
    }
    return table;
}

Table material_windows(const MaterialJudgment& judgment) {
    Table table;
    table.id = "windows_materials";
    table.title = "Materials per window and horizon";
    table.columns = {{"direction", "direction", Align::left},
                     {"forecaster", "forecaster", Align::left},
                     {"start", "first sample", Align::right, kCount},
                     {"horizon", "horizon", Align::right, kCount},
                     {"flip", "FLIP"},
                     {"ssim", "SSIM"},
                     {"delta_e", "CIEDE2000"},
                     {"lpips", "LPIPS"},
                     {"error", "frame MSE"},
                     {"moved", "moved"},
                     {"truth_moved", "truth moved"},
                     {"agreement", "agreement"},
                     {"outside_pixels", "pixels outside"},
                     {"outside_channels", "channels outside"}};
    RowGroup group;
    for (const MaterialDirection& d : judgment.directions) {
        for (const MaterialScores& s : d.rows) {
            for (int w = 0; w < s.flip.windows; ++w) {
                for (int h = 0; h < s.flip.horizons; ++h) {
                    group.rows.push_back(
                        {TableCell(d.label), TableCell(s.name), TableCell(d.starts[std::size_t(w)]),
                         TableCell(judgment.options.horizons[std::size_t(h)]),
                         TableCell(s.flip.at(w, h)), TableCell(s.ssim.at(w, h)),
                         TableCell(s.delta_e.at(w, h)),
                         s.lpips.empty() ? TableCell() : TableCell(s.lpips.at(w, h)),
                         TableCell(s.error.at(w, h)), TableCell(s.moved.at(w, h)),
                         TableCell(d.truth_moved.at(w, h)), finite_or_missing(s.agreement.at(w, h)),
                         TableCell(s.outside_pixels.at(w, h)),
                         TableCell(s.outside_channels.at(w, h))});
                }
            }
        }
    }
    table.groups.push_back(std::move(group));
    return table;
}

Figure material_flip_figure(const MaterialJudgment& judgment) {
    Figure figure;
    figure.id = "materials-flip";
    figure.title = "FLIP by horizon";
    figure.caption =
        "Mean FLIP between the pictures of forecast and true materials. The static control in "
        "gray.";
    for (const MaterialDirection& d : judgment.directions) {
        FigurePanel panel;
        panel.title = d.label;
        panel.x = {.label = "horizon (units)"};
        panel.y = {.label = "mean FLIP", .lo = 0, .format = kFlip};
        for (const MaterialScores& s : d.rows) {
            FigureSeries series{s.name, SeriesKind::line, {}, &s == &d.control()};
            const std::vector<double> means = horizon_means(s.flip);
            for (std::size_t h = 0; h < means.size(); ++h)
                series.points.push_back({double(judgment.options.horizons[h]), means[h]});
            panel.series.push_back(std::move(series));
        }
        figure.panels.push_back(std::move(panel));
    }
    never_empty(figure);
    return figure;
}

Figure material_gain_figure(const MaterialJudgment& judgment,
                            const std::vector<MaterialDirectionVerdict>& list) {
    Figure figure;
    figure.id = "materials-gains";
    figure.title = "Gain over the static control";
    figure.caption =
        "Gain in mean FLIP. Bars: nominal 95 % intervals over non-overlapping blocks, where there "
        "are enough; they cover less than they say.";
    for (const MaterialDirectionVerdict& v : list) {
        FigurePanel panel;
        panel.title = v.direction->label;
        panel.x = {.label = "horizon (units)"};
        for (const int horizon : judgment.options.horizons)
            panel.x.categories.push_back(fmt::format("+{}", horizon));
        panel.y = {.label = "gain over the static control", .format = kGain};
        for (std::size_t i = 0; i < v.rows.size(); ++i) {
            FigureSeries series{v.direction->rows[i + 1].name, SeriesKind::points, {}};
            for (std::size_t h = 0; h < v.rows[i].size(); ++h) {
                const Resolved& gain = v.rows[i][h].gain;
                if (!std::isfinite(gain.value)) continue;
                series.points.push_back(
                    interval_point(double(h), gain.value,
                                   gain.blocks.size() < kFewBlocks ? std::nullopt : gain.block));
            }
            panel.series.push_back(std::move(series));
        }
        panel.references.push_back({"static control", 0});
        figure.panels.push_back(std::move(panel));
    }
    never_empty(figure);
    return figure;
}

}  // namespace verdigris
