// SPDX-License-Identifier: MIT
#include "verdigris/observe/bin_accumulator.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "verdigris/error.h"
#include "verdigris/observe/bin_kernel.h"
#include "verdigris/observe/trimmed_plane.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

// tuned: bench/observe_clip.cpp; from 8 on the state's traffic is below the frames' own.
constexpr int kFramesHeld = 8;

// Averages of consecutive frames, for bins with more frames than are trimmed one by one.
template <class T>
struct GroupTraits {
    using Sum = std::uint32_t;  // 65,537 frames of 16 bit; a group holds a bin's 80th part
    using Mean = std::uint16_t;
    // A group's mean fills 16 bits, so that few-bit frames keep fractions of a code.
    static double scale(int bits) { return std::exp2(16 - std::clamp(bits, 8, 16)); }
};
template <>
struct GroupTraits<float> {
    using Sum = double;
    using Mean = float;
    static double scale(int) { return 1; }
};

template <class T>
class PlaneBin {
  public:
    using Mean = typename GroupTraits<T>::Mean;

    PlaneBin(int n, int rows, int bits)
        : n_(n),
          rows_(rows),
          scale_(GroupTraits<T>::scale(bits)),
          single_(n, rows),
          means_(samples()) {}

    void begin(int k, bool grouped) {
        grouped_ = grouped;
        if (!grouped) return single_.begin(k);
        if (!groups_) groups_.emplace(n_, rows_);
        groups_->begin(k);
        group_sum_.assign(samples(), 0);
        in_group_ = 0;
    }
    void add(const std::vector<PlaneWindow<T>>& windows) {
        if (!grouped_) return single_.add(windows);
        parallel_rows(rows_, 32, [&](RowRun run) {
            for (int y = run.begin; y < run.end; ++y) {
                auto* sum = group_sum_.data() + std::size_t(y) * std::size_t(n_);
                for (const PlaneWindow<T>& window : windows) {
                    const T* row = window.row(y);
                    for (int x = 0; x < n_; ++x) sum[x] += row[x];
                }
            }
        });
        in_group_ += int(windows.size());
    }
    void end_group() {
        if (!grouped_ || in_group_ == 0) return;
        group_mean_.resize(samples());
        const double factor = scale_ / in_group_;
        for (std::size_t i = 0; i < samples(); ++i) {
            const double mean = double(group_sum_[i]) * factor;
            // Samples of more bits than they should have (a faulty coder) must not wrap around.
            group_mean_[i] =
                std::is_same_v<Mean, float> ? Mean(mean) : Mean(std::min(mean + 0.5, 65535.0));
            group_sum_[i] = 0;
        }
        in_group_ = 0;
        groups_->add({{group_mean_.data(), std::ptrdiff_t(std::size_t(n_) * sizeof(Mean))}});
    }
    int values() const { return grouped_ ? groups_->count() : single_.count(); }
    const float* means(int drop) {
        if (grouped_) {
            groups_->means(drop, 1 / scale_, means_.data());
        } else {
            single_.means(drop, 1, means_.data());
        }
        return means_.data();
    }
    void codes(int drop, std::uint16_t* out) const {
        if (grouped_) {
            groups_->means(drop, 1, out);
        } else {
            single_.means(drop, scale_, out);
        }
    }
    int n() const { return n_; }
    int rows() const { return rows_; }

  private:
    std::size_t samples() const { return std::size_t(n_) * std::size_t(rows_); }
    int n_, rows_;
    double scale_;  // of a group's mean, per code
    bool grouped_ = false;
    TrimmedPlane<T> single_;
    std::optional<TrimmedPlane<Mean>> groups_;
    std::vector<typename GroupTraits<T>::Sum> group_sum_;
    std::vector<Mean> group_mean_;
    std::vector<float> means_;
    int in_group_ = 0;
};

int plane_count(const FrameFormat& format) {
    return format.model == PixelModel::yuv ? 3 : 1;
}
int channels(const FrameFormat& format) {
    return format.model == PixelModel::rgb ? 3 : 1;
}
int shift_up(int v, int shift) {
    return (v + (1 << shift) - 1) >> shift;
}

}  // namespace

int TrimRule::largest() const {
    int n = kMaxTrimmedCount;
    while (n > 1 && int(std::floor(trim * n)) > kMaxTrim) --n;
    return n;
}
int TrimRule::dropped(int values) const {
    return std::min({int(std::floor(trim * values)), (values - 1) / 2, kMaxTrim});
}

Rect plane_rect(const FrameFormat& format, int plane, Rect coded) {
    if (plane == 0) return coded;
    const int sx = format.chroma_shift_x, sy = format.chroma_shift_y;
    Rect r{coded.x >> sx, coded.y >> sy, 0, 0};
    r.width = shift_up(coded.x + coded.width, sx) - r.x;
    r.height = shift_up(coded.y + coded.height, sy) - r.y;
    return r;
}

// What all sample types share, and the batch of held frames.
struct BinAccumulator::State {
    State(const FrameFormat& f, Rect c, double trim) : format(f), coded(c), rule{trim} {}
    virtual ~State() = default;
    virtual void begin_planes(int k, bool grouped) = 0;
    virtual void flush() = 0;
    virtual void end_group() = 0;
    virtual PlaneSet finish() = 0;
    virtual void write_codes(std::uint16_t* out) = 0;

    FrameFormat format;
    Rect coded;
    TrimRule rule;
    int expected = 0, added = 0, groups = 0, group = 0;
    std::vector<Frame> held;
};

namespace {

template <class T>
struct TypedState final : BinAccumulator::State {
    TypedState(const FrameFormat& f, Rect c, double trim) : State(f, c, trim) {
        for (int p = 0; p < plane_count(format); ++p) {
            const Rect r = plane_rect(format, p, coded);
            planes.emplace_back(r.width * channels(format), r.height, format.bits);
        }
    }
    void begin_planes(int k, bool grouped) override {
        for (auto& plane : planes) plane.begin(k, grouped);
    }
    void flush() override {
        if (held.empty()) return;
        std::vector<PlaneWindow<T>> windows(held.size());
        for (int p = 0; p < int(planes.size()); ++p) {
            const Rect r = plane_rect(format, p, coded);
            for (std::size_t i = 0; i < held.size(); ++i) {
                const Plane& plane = held[i].planes.plane[std::size_t(p)];
                windows[i] = {reinterpret_cast<const T*>(plane.data + r.y * plane.stride_bytes) +
                                  r.x * plane.channels,
                              plane.stride_bytes};
            }
            planes[std::size_t(p)].add(windows);
        }
        held.clear();
    }
    void end_group() override {
        for (auto& plane : planes) plane.end_group();
    }
    PlaneSet finish() override {
        PlaneSet set;
        set.count = int(planes.size());
        for (std::size_t p = 0; p < planes.size(); ++p) {
            PlaneBin<T>& plane = planes[p];
            const float* data = plane.means(rule.dropped(plane.values()));
            const int per_pixel = channels(format);
            set.plane[p] = {reinterpret_cast<const std::byte*>(data),
                            std::ptrdiff_t(std::size_t(plane.n()) * sizeof(float)),
                            plane.n() / per_pixel,
                            plane.rows(),
                            per_pixel,
                            SampleType::f32};
        }
        return set;
    }
    void write_codes(std::uint16_t* out) override {
        for (const PlaneBin<T>& plane : planes) {
            plane.codes(rule.dropped(plane.values()), out);
            out += std::size_t(plane.n()) * std::size_t(plane.rows());
        }
    }
    std::vector<PlaneBin<T>> planes;
};

}  // namespace

BinAccumulator::BinAccumulator(const FrameFormat& format, Rect coded, double trim) {
    switch (format.type) {
        case SampleType::u8:
            state_ = std::make_unique<TypedState<std::uint8_t>>(format, coded, trim);
            break;
        case SampleType::u16:
            state_ = std::make_unique<TypedState<std::uint16_t>>(format, coded, trim);
            break;
        case SampleType::f32:
            state_ = std::make_unique<TypedState<float>>(format, coded, trim);
            break;
    }
}
BinAccumulator::~BinAccumulator() = default;
BinAccumulator::BinAccumulator(BinAccumulator&&) noexcept = default;
BinAccumulator& BinAccumulator::operator=(BinAccumulator&&) noexcept = default;

void BinAccumulator::begin(int expected) {
    State& s = *state_;
    s.held.clear();
    s.expected = std::max(expected, 1);
    s.added = s.group = 0;
    const int largest = s.rule.largest();
    s.groups = s.expected > largest ? largest : 0;
    s.begin_planes(s.rule.dropped(s.groups > 0 ? s.groups : s.expected), s.groups > 0);
}

void BinAccumulator::add(const Frame& frame) {
    State& s = *state_;
    bool fits = frame.planes.count >= plane_count(s.format);
    for (int p = 0; fits && p < plane_count(s.format); ++p) {
        const Plane& plane = frame.planes.plane[std::size_t(p)];
        const Rect r = plane_rect(s.format, p, s.coded);
        fits = plane.type == s.format.type && plane.channels == channels(s.format) &&
               plane.width >= r.x + r.width && plane.height >= r.y + r.height;
    }
    if (!fits) {
        throw Error(ErrorCode::bad_input, "the frame has another size or format than the first",
                    "frame " + std::to_string(frame.index));
    }
    s.held.push_back(frame);
    ++s.added;
    if (s.groups > 0) {
        // Group g gets the frames [g * expected / groups, (g + 1) * expected / groups).
        const auto next = std::int64_t(s.group + 1) * s.expected / s.groups;
        if (s.added >= next) {
            s.flush();
            s.end_group();
            ++s.group;
            return;
        }
    }
    if (int(s.held.size()) >= kFramesHeld) s.flush();
}

int BinAccumulator::count() const {
    return state_->added;
}

PlaneSet BinAccumulator::means() {
    state_->flush();
    state_->end_group();
    return state_->finish();
}

void BinAccumulator::codes(std::uint16_t* out) {
    state_->flush();
    state_->end_group();
    state_->write_codes(out);
}

}  // namespace verdigris
