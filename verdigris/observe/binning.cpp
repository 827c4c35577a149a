// SPDX-License-Identifier: MIT
#include "verdigris/observe/binning.h"

#include <algorithm>

#include "verdigris/error.h"
#include "verdigris/observe/area_average.h"
#include "verdigris/observe/bin_accumulator.h"
#include "verdigris/observe/exposure.h"
#include "verdigris/recording/to_srgb.h"

namespace verdigris {
namespace {

// chosen: up to this many crop pixels the probe is the whole sample; beyond, bands of together
// kProbePixels source pixels: 2e4 differences per sample, of which a few samples suffice.
constexpr int kWholeProbe = 1 << 17, kProbePixels = 1 << 13;
constexpr int kBands = 8;

// Makes a part of the samples: rows [begin, end) of the output.
class PartMaker {
  public:
    PartMaker(const FrameFormat& format, const BinningPlan& plan, int begin, int end)
        : format_(format),
          resampling_{plan.crop.width, plan.crop.height, plan.width, plan.height},
          begin_(begin),
          end_(end) {
        const auto [first, last] = resampling_.source_rows(begin, end);
        first_ = first;
        shown_ = {plan.crop.x, plan.crop.y + first, plan.crop.width, last - first};
        coded_ = coded_rect(format, shown_);
        bin_.emplace(format, coded_, plan.trim);
    }
    void begin(int expected) { bin_->begin(expected); }
    void add(const Frame& frame) { bin_->add(frame); }
    int count() const { return bin_->count(); }
    void codes(SampleCodes& out) { bin_->codes(out.data()); }
    Image<SrgbF> image() {
        Image<SrgbF> source = srgb_from_part(bin_->means(), coded_, format_, shown_);
        if (resampling_.identity()) return source;
        return resample_rows(source, first_, resampling_, begin_, end_);
    }

  private:
    FrameFormat format_;
    Resampling resampling_;
    int begin_, end_, first_ = 0;
    Rect shown_, coded_;
    std::optional<BinAccumulator> bin_;
};

void copy_rows(const Image<SrgbF>& from, int from_row, Image<SrgbF>& to, int to_row, int rows) {
    for (int y = 0; y < rows; ++y) {
        std::copy_n(from.row(from_row + y), from.width(), to.row(to_row + y));
    }
}

// Samples that are frames' own pixels are stored as the frames are coded: half the size, and no
// color to be made.
SampleLayout layout_of_samples(const FrameFormat& format, const BinningPlan& plan) {
    const bool resampled = plan.width != plan.crop.width || plan.height != plan.crop.height;
    if (resampled || format.model != PixelModel::yuv || format.type == SampleType::f32) {
        return rgb_layout(plan.width, plan.height);
    }
    return plane_layout(format, plan.crop);
}

class Binner {
  public:
    Binner(const Recording& recording, const BinningPlan& plan)
        : plan_(plan),
          axis_(*plan.axis),
          probe_(probe_rows(plan.crop, plan.height)),
          noise_(plan.width, probe_.rows),
          jumps_(recording.info().format),
          full_(needed_in_full()),
          layout_(layout_of_samples(recording.info().format, plan)),
          line_(kept_bins(), layout_, plan.store, plan.specimen.empty()),
          whole_(recording.info().format, plan, 0, plan.height) {
        for (const auto& [begin, end] : probe_.bands) {
            bands_.emplace_back(recording.info().format, plan, begin, end);
        }
        if (!plan.specimen.empty()) noise_.only_inside(probe_of(plan.specimen, probe_));
    }

    void add(const Frame& frame) {
        jumps_.add(frame);
        const int bin = axis_.bin_of_frame[std::size_t(frame.index)];
        if (bin != current_) {
            close();
            current_ = bin;
            const int expected = axis_.frames_in_bin[std::size_t(bin)];
            if (full_[std::size_t(bin)]) {
                whole_.begin(expected);
            } else {
                for (PartMaker& band : bands_) band.begin(expected);
            }
        }
        if (full_[std::size_t(bin)]) {
            whole_.add(frame);
        } else {
            for (PartMaker& band : bands_) band.add(frame);
        }
    }

    Binned finish(const DecodeReport& report) {
        close();
        Binned out{line_.finish(),    line_.kept(), 0,      line_.clipped(), line_.take_look(),
                   std::move(noise_), probe_,       report, jumps_.finding()};
        out.samples = out.kept.empty() ? 0 : out.kept.back().bin + 1;
        return out;
    }

  private:
    std::vector<int> kept_bins() const {
        std::vector<int> bins;
        for (std::size_t i = 0; i < plan_.kept.size(); ++i) {
            if (plan_.kept[i]) bins.push_back(int(i));
        }
        return bins;
    }
    // Kept bins, and where a kept bin is empty its nearest neighbors that are not.
    std::vector<bool> needed_in_full() const {
        std::vector<bool> full = plan_.kept;
        const int bins = int(full.size());
        const auto filled = [&](int i) { return axis_.frames_in_bin[std::size_t(i)] > 0; };
        for (int i = 0; i < bins; ++i) {
            if (!plan_.kept[std::size_t(i)] || filled(i)) continue;
            int left = i, right = i;
            while (left >= 0 && !filled(left)) --left;
            while (right < bins && !filled(right)) ++right;
            if (left >= 0) full[std::size_t(left)] = true;
            if (right < bins) full[std::size_t(right)] = true;
        }
        return full;
    }

    void close() {
        if (current_ < 0) return;
        auto probe = Image<SrgbF>::for_overwrite(plan_.width, probe_.rows);
        int row = 0;
        const auto take = [&](const Image<SrgbF>& from, int first, int rows) {
            copy_rows(from, first, probe, row, rows);
            row += rows;
        };
        if (!full_[std::size_t(current_)]) {
            for (PartMaker& band : bands_) {
                const Image<SrgbF> part = band.image();
                take(part, 0, part.height());
            }
        } else if (layout_.is_rgb()) {
            const Image<SrgbF> sample = whole_.image();
            for (const auto& [begin, end] : probe_.bands) take(sample, begin, end - begin);
            pack_rgb(sample, line_.buffer());
            line_.give(current_, whole_.count());
        } else {
            SampleCodes& codes = line_.buffer();
            whole_.codes(codes);
            for (const auto& [begin, end] : probe_.bands) {
                take(rows_of_sample(layout_, codes.data(), begin, end), 0, end - begin);
            }
            line_.give(current_, whole_.count());
        }
        noise_.add(current_, probe);
    }

    const BinningPlan& plan_;
    const AxisPlan& axis_;
    ProbeRows probe_;
    NoiseMeter noise_;
    JumpWatch jumps_;
    std::vector<bool> full_;
    SampleLayout layout_;
    SampleLine line_;
    PartMaker whole_;
    std::vector<PartMaker> bands_;
    int current_ = -1;
};

}  // namespace

ProbeRows probe_rows(Rect crop, int height) {
    ProbeRows rows;
    if (std::int64_t(crop.width) * crop.height <= kWholeProbe || height > crop.height) {
        rows.bands = {{0, height}};
        rows.rows = height;
        return rows;
    }
    const double scale = double(crop.height) / height;
    const int band = std::clamp(int(kProbePixels / (kBands * double(crop.width)) / scale), 1,
                                std::max(1, height / kBands));
    for (int i = 0; i < kBands; ++i) {
        const int middle = int((2 * i + 1) * std::int64_t(height) / (2 * kBands));
        const int begin =
            std::max(middle - band / 2, rows.bands.empty() ? 0 : rows.bands.back().second);
        const int end = std::min(begin + band, height);
        if (begin >= end) continue;
        rows.bands.emplace_back(begin, end);
        rows.rows += end - begin;
    }
    return rows;
}

Mask probe_of(const Mask& mask, const ProbeRows& rows) {
    Mask out(mask.width(), rows.rows);
    int row = 0;
    for (const auto& [begin, end] : rows.bands) {
        for (int y = begin; y < end; ++y) std::copy_n(mask.row(y), mask.width(), out.row(row++));
    }
    return out;
}

std::optional<double> Binned::sigma_of(const Mask& specimen) const {
    return noise.sigma(probe_of(specimen, probe));
}

Binned bin_recording(const Recording& recording, const BinningPlan& plan,
                     const Progress& progress) {
    const auto frames = std::int64_t(recording.info().times.size());
    Binner binner(recording, plan);
    const auto reader = recording.read();
    Frame frame;
    report(progress, "observe", 0, frames);
    while (reader->next(frame)) {
        binner.add(frame);
        report(progress, "observe", frame.index + 1, frames);
    }
    const DecodeReport& decoded = reader->report();
    const std::string name = recording.info().path.filename().string();
    if (decoded.decoded < 2) {
        throw Error(ErrorCode::bad_input,
                    decoded.decoded == 0
                        ? "no frame could be decoded"
                        : "only one frame could be decoded; a recording needs at least 2",
                    name);
    }
    return binner.finish(decoded);
}

}  // namespace verdigris
