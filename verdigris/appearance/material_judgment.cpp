// SPDX-License-Identifier: MIT
#include "verdigris/appearance/material_judgment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "verdigris/color/convert.h"
#include "verdigris/deliver/visible_change.h"
#include "verdigris/error.h"
#include "verdigris/evaluate/characterize.h"
#include "verdigris/metrics/pixel_errors.h"
#include "verdigris/metrics/ssim.h"
#include "verdigris/pixels/parallel_rows.h"
#include "verdigris/render/largest_rectangle.h"

namespace verdigris {
namespace {

constexpr int kMostHorizon = 1000;  // as the protocol's
constexpr std::size_t kControls = MaterialDirection::kControls, kFinish = kControls - 1;

bool same(const Image<SrgbF>& a, const Image<SrgbF>& b) {
    return a.same_size(b) && std::ranges::equal(a.pixels(), b.pixels());
}

Image<SrgbU8> rounded(const Image<SrgbF>& picture) {
    auto out = Image<SrgbU8>::for_overwrite(picture.width(), picture.height());
    std::ranges::transform(picture.pixels(), out.pixels().begin(), u8_from_srgb);
    return out;
}

void check(const MaterialJudgeOptions& o) {
    const bool rising =
        std::ranges::adjacent_find(o.horizons, std::greater_equal<>()) == o.horizons.end();
    if (o.horizons.empty() || !rising || o.horizons.front() < 1 ||
        o.horizons.back() > kMostHorizon) {
        throw Error(ErrorCode::usage, "horizons are whole units from 1 to 1000, increasing");
    }
    if (!(o.pixels_per_degree >= kFlipSmallestPpd && o.pixels_per_degree <= kFlipLargestPpd))
        throw Error(ErrorCode::usage, "pixels per degree are 1 to 400");
}

void check_reach(const EvaluationProtocol& base, std::span<const Observation> observations,
                 int furthest) {
    for (const Observation& o : observations) {
        if (!o.store) continue;  // evaluate() says so
        const int longest = longest_horizon(base, o.store->count());
        if (furthest <= longest) continue;
        throw Error(ErrorCode::bad_input,
                    fmt::format("is too short for +{}: behind {} observed frames its furthest "
                                "horizon is +{}",
                                furthest, base.context, longest),
                    o.source_name);
    }
}

/// What one picture of the window is compared with, all pictures of one horizon.
struct Compared {
    FlipResult flip;
    double ssim = 0, delta_e = 0;
};

/// The windows of one held-out recording, one after the other.
class DirectionJudge {
  public:
    DirectionJudge(const MaterialJudgeOptions& options, const ScoredWindow& w) : options_(options) {
        const int width = w.context.frames.front().width(),
                  height = w.context.frames.front().height();
        out_.held_out = w.direction.held_out;
        out_.label = w.direction.label();
        out_.shown = options.whole ? Rect{0, 0, width, height}
                                   : largest_rectangle(w.observation.specimen, width, height);
        view_ = std::make_unique<MaterialView>(options.view, out_.shown);
        const int columns = int(options.horizons.size());
        const ErrorTable none(0, columns);
        out_.truth_moved = none;
        for (std::size_t i = 0; i < kControls + w.forecasts.size() - 1; ++i) {
            MaterialScores s;
            if (i < kControls) {
                const char* kNames[] = {"persistence", "canvas", "true-finish"};
                s.name = kNames[i];
            } else {
                s.name = w.direction.entrants[i - kControls + 1].name;
                s.trained = w.direction.entrants[i - kControls + 1].trained;
            }
            for (ErrorTable* t : {&s.flip, &s.ssim, &s.delta_e, &s.error, &s.moved, &s.agreement,
                                  &s.outside_pixels, &s.outside_channels})
                *t = none;
            if (options.lpips) s.lpips = none;
            out_.rows.push_back(std::move(s));
        }
    }

    void add(const ScoredWindow& w, const Progress& progress) {
        const Image<SrgbF>& last = w.context.frames.back();
        const WindowMaterials materials(w, options_.horizons.back(), options_.scale);
        const bool keep =
            out_.examples.empty() ||
            w.start <= (w.direction.plan.starts.front() + w.direction.plan.starts.back()) / 2;
        if (keep) out_.examples.clear();
        out_.starts.push_back(w.start);
        std::vector<Image<SrgbF>> still(2);  // of both controls: the same at every horizon
        for (std::size_t h = 0; h < options_.horizons.size(); ++h) {
            report(progress, "render",
                   std::int64_t(out_.starts.size() - 1) * std::int64_t(options_.horizons.size()) +
                       std::int64_t(h),
                   std::int64_t(w.direction.plan.starts.size() * options_.horizons.size()));
            one_horizon(w, materials, last, h, still, keep);
        }
    }
    MaterialDirection take() { return std::move(out_); }

  private:
    void one_horizon(const ScoredWindow& w, const WindowMaterials& materials,
                     const Image<SrgbF>& last, std::size_t h, std::vector<Image<SrgbF>>& still,
                     bool keep) {
        const int horizon = options_.horizons[h];
        const Image<SrgbF>& truth = w.truth(horizon);
        const std::size_t rows = out_.rows.size();
        // Frames: those of the controls, of the entrants; then the truth.
        std::vector<Image<SrgbF>> frames;
        frames.push_back(last.clone());
        frames.push_back(materials.canvas().clone());
        frames.push_back(last.clone());
        for (std::size_t i = 1; i < w.forecasts.size(); ++i)
            frames.push_back(w.forecasts[i].at(horizon));
        frames.push_back(truth.clone());

        std::vector<Image<SrgbF>> pictures(rows + 1);
        std::vector<std::size_t> to_render;
        for (std::size_t i = 0; i <= rows; ++i) {
            if (i < still.size() && !still[i].empty()) {
                pictures[i] = still[i].clone();
            } else if (i < kControls || i == rows || !same(frames[i], last)) {
                to_render.push_back(i);
            }
        }
        parallel_for(int(to_render.size()), [&](int k) {
            const std::size_t i = to_render[std::size_t(k)];
            Material m = materials.material(i == kFinish ? truth : frames[i], horizon);
            if (i == kFinish) m.albedo = last.clone();
            pictures[i] = view_->picture(m);
        });
        for (std::size_t i = 0; i < still.size(); ++i)
            if (still[i].empty()) still[i] = pictures[i].clone();
        for (Image<SrgbF>& p : pictures)
            if (p.empty()) p = still[0].clone();  // it holds still

        const Image<SrgbF>& real = pictures[rows];
        if (out_.noise_flip == 0)
            out_.noise_flip = flip(real, view_->picture(materials.material(truth, horizon), 1),
                                   {options_.pixels_per_degree})
                                  .mean;
        std::vector<Compared> compared(rows);
        parallel_for(int(rows), [&](int k) {
            const auto i = std::size_t(k);
            compared[i] = {flip(real, pictures[i], {options_.pixels_per_degree}),
                           ssim(real, pictures[i]), color_difference(real, pictures[i]).mean};
        });
        for (std::size_t i = 0; i < rows; ++i) {
            const FrameMotion m = frame_motion(frames[i], truth, last, out_.shown);
            const FrameMotion free =
                i < kControls ? m
                              : frame_motion(unclamped(w.forecasts[i - kControls + 1], horizon),
                                             truth, last, out_.shown);
            MaterialScores& s = out_.rows[i];
            put(s.flip, h, compared[i].flip.mean);
            put(s.ssim, h, compared[i].ssim);
            put(s.delta_e, h, compared[i].delta_e);
            put(s.error, h, m.error);
            put(s.moved, h, m.moved);
            put(s.agreement, h, m.agreement);
            put(s.outside_pixels, h, free.outside_pixels);
            put(s.outside_channels, h, free.outside_channels);
            if (options_.lpips) put(s.lpips, h, options_.lpips(real, pictures[i]));
        }
        put(out_.truth_moved, h, frame_motion(truth, truth, last, out_.shown).moved);
        if (keep) keep_example(w, horizon, frames, pictures, compared);
    }

    void keep_example(const ScoredWindow& w, int horizon, const std::vector<Image<SrgbF>>& frames,
                      const std::vector<Image<SrgbF>>& pictures, std::vector<Compared>& compared) {
        const Image<SrgbF>& last = w.context.frames.back();
        const auto example = [&](const Image<SrgbF>& frame) {
            return ExampleFrame{rounded(frame), change_between(last, frame)};
        };
        MaterialExample e;
        e.start = w.start;
        e.horizon = horizon;
        e.last = rounded(last);
        e.true_frame = example(frames.back());
        e.truth = rounded(pictures.back());
        for (std::size_t i = 0; i < compared.size(); ++i)
            e.rows.push_back({out_.rows[i].name, example(frames[i]), rounded(pictures[i]),
                              std::move(compared[i].flip.map), compared[i].flip.mean});
        out_.examples.push_back(std::move(e));
    }

    /// Appends: horizons of a window come in their order.
    static void put(ErrorTable& table, std::size_t h, double value) {
        table.values.push_back(value);
        table.windows += h + 1 == std::size_t(table.horizons);
    }

    const MaterialJudgeOptions& options_;
    MaterialDirection out_;
    std::unique_ptr<MaterialView> view_;
};

}  // namespace

EvaluationProtocol material_protocol(const EvaluationProtocol& base,
                                     const std::vector<int>& horizons) {
    EvaluationProtocol p = base;
    p.embargo = base.embargo_samples();
    p.horizons = horizons.empty() ? base.horizons : horizons.back();
    p.delta_e = p.out_of_gamut = false;  // here of what is shown
    return p;
}

MaterialJudgment judge_materials(const EvaluationProtocol& base,
                                 std::span<const Observation> observations,
                                 const std::vector<Entrant>& entrants,
                                 const MaterialJudgeOptions& options, const Progress& progress) {
    check(options);
    check_reach(base, observations, options.horizons.back());
    const EvaluationProtocol protocol = material_protocol(base, options.horizons);
    MaterialJudgment out;
    out.options = options;
    std::unique_ptr<DirectionJudge> judge;
    std::string held_out;
    const auto finish = [&] {
        if (judge) out.directions.push_back(judge->take());
        judge.reset();
    };
    out.evaluation =
        evaluate(protocol, observations, entrants, progress, [&](const ScoredWindow& w) {
            if (!judge || held_out != w.direction.held_out) {
                finish();
                judge = std::make_unique<DirectionJudge>(options, w);
                held_out = w.direction.held_out;
            }
            judge->add(w, progress);
        });
    finish();
    return out;
}

WindowRatios flip_ratios(const MaterialDirection& direction, const MaterialScores& row,
                         std::size_t horizon) {
    WindowRatios ratios;
    ratios.starts = direction.starts;
    for (int w = 0; w < row.flip.windows; ++w) {
        const double control = direction.control().flip.at(w, int(horizon));
        ratios.over.push_back(control - row.flip.at(w, int(horizon)));
        ratios.under.push_back(control);
    }
    return ratios;
}

BootstrapOptions flip_bootstrap(const MaterialJudgment& judgment, std::size_t horizon) {
    EvaluationProtocol at = judgment.evaluation.protocol;
    at.horizons = judgment.options.horizons[horizon];
    return bootstrap_options(at);
}

}  // namespace verdigris
