// SPDX-License-Identifier: MIT
#include "verdigris/simulate/simulate.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <memory>

#include "verdigris/color/convert.h"
#include "verdigris/pixels/parallel_rows.h"
#include "verdigris/recording/memory_recording.h"

namespace verdigris {
namespace {

double mean_luminance(const Image<LinearF>& frame) {
    const auto sums = map_rows<double>(frame.height(), 32, [&](RowRun run) {
        double sum = 0;
        for (int y = run.begin; y < run.end; ++y) {
            const LinearF* row = frame.row(y);
            float line = 0;
            for (int x = 0; x < frame.width(); ++x)
                line += kLumaR * row[x].r + kLumaG * row[x].g + kLumaB * row[x].b;
            sum += line;
        }
        return sum;
    });
    double sum = 0;
    for (const double s : sums) sum += s;
    return sum / double(frame.pixel_count());
}

// Adds the time of a piece of work to a counter.
class Timed {
  public:
    explicit Timed(double& seconds) : seconds_(seconds), start_(Clock::now()) {}
    ~Timed() { seconds_ += std::chrono::duration<double>(Clock::now() - start_).count(); }

  private:
    using Clock = std::chrono::steady_clock;
    double& seconds_;
    Clock::time_point start_;
};

// The light at two neighboring nodes of 0.1 units; between them it changes along a straight line.
class Light {
  public:
    Light(const SimulationSpec& spec, const SimulationSinks& sinks, Breathe breathe)
        : sinks_(sinks),
          breathe_(std::move(breathe)),
          units_(spec.frames.units),
          specimen_(spec, breathe_),
          scene_(spec, specimen_.grid()),
          track_(spec) {
        show(after_);
    }
    /// Until the two nodes embrace `unit`.
    void advance_to(double unit) {
        while (node_ < 0 || (after_unit_ < unit && after_unit_ < units_)) {
            ++node_;
            std::swap(before_, after_);
            before_unit_ = after_unit_;
            const double next = (node_ + 1) * CameraTrack::kNodeUnits;
            after_unit_ = next > units_ - 1e-9 ? units_ : next;
            specimen_.advance_to(after_unit_, breathe_);
            show(after_);
        }
    }
    void finish() { advance_to(units_); }

    const Image<LinearF>& before() const { return before_; }
    const Image<LinearF>& after() const { return after_; }
    /// How far from before to after, 0 to 1.
    double share(double unit) const {
        return std::clamp((unit - before_unit_) / (after_unit_ - before_unit_), 0.0, 1.0);
    }
    const CameraTrack& track() const { return track_; }

  private:
    void show(Image<LinearF>& frame) {
        scene_.compose(specimen_.color(), frame);
        track_.see(mean_luminance(frame));
        const double unit = specimen_.unit();
        if (sinks_.state && (unit == units_ || std::abs(unit - std::round(unit)) < 1e-6))
            sinks_.state(specimen_);
    }

    const SimulationSinks& sinks_;
    Breathe breathe_;
    double units_;
    Specimen specimen_;
    Scene scene_;
    CameraTrack track_;
    Image<LinearF> before_, after_;
    double before_unit_ = 0, after_unit_ = 0;
    int node_ = -1;
};

}  // namespace

double frame_unit(const FrameSpec& frames, int index) {
    return (index + 0.5) / frames.count * frames.units;
}

SimulationResult simulate(const SimulationSpec& spec, const SimulationSinks& sinks,
                          const Progress& progress) {
    check_spec(spec);
    SimulationResult result;
    int frame = 0;
    // Also asked between frames: a fine grid can take long from one to the next.
    const Breathe breathe = [&] { report(progress, "simulate", frame, spec.frames.count); };
    std::unique_ptr<Light> light;
    std::unique_ptr<Camera> camera;
    {
        const Timed timed(result.seconds_specimen);
        light = std::make_unique<Light>(spec, sinks, breathe);
        camera = std::make_unique<Camera>(spec);
    }
    Image<SrgbU8> frame8;
    Image<SrgbU16> frame16;
    for (int i = 0; i < spec.frames.count; ++i) {
        frame = i;
        breathe();
        const double unit = frame_unit(spec.frames, i);
        {
            const Timed timed(result.seconds_specimen);
            light->advance_to(unit);
        }
        const FrameGains gains = light->track().gains(unit, i);
        result.gains.push_back(gains);
        const bool deep = spec.camera.bits == 16;
        {
            const Timed timed(result.seconds_camera);
            const double t = light->share(unit);
            if (deep)
                camera->expose(light->before(), light->after(), t, gains, i, frame16);
            else
                camera->expose(light->before(), light->after(), t, gains, i, frame8);
        }
        const Timed timed(result.seconds_sinks);
        if (deep && sinks.frame16) sinks.frame16(i, frame16);
        if (!deep && sinks.frame8) sinks.frame8(i, frame8);
    }
    light->finish();
    report(progress, "simulate", spec.frames.count, spec.frames.count);
    return result;
}

Recording simulated_recording(const SimulationSpec& spec, const Progress& progress) {
    auto frames = std::make_shared<std::vector<Image<SrgbU8>>>();
    SimulationSpec eight = spec;
    eight.camera.bits = 8;
    simulate(eight,
             {.frame8 =
                  [&](int, ImageView<const SrgbU8> view) {
                      auto copy = Image<SrgbU8>::for_overwrite(view.width(), view.height());
                      for (int y = 0; y < view.height(); ++y)
                          std::copy(view.row(y), view.row(y) + view.width(), copy.row(y));
                      frames->push_back(std::move(copy));
                  },
              .frame16 = {},
              .state = {}},
             progress);
    std::vector<double> times;
    for (int i = 0; i < spec.frames.count; ++i) times.push_back(i / spec.frames.fps);
    return recording_from_function(
        spec.frames.width, spec.frames.height, std::move(times),
        [frames](int i) { return (*frames)[std::size_t(i)].clone(); }, "simulated " + spec.preset);
}

}  // namespace verdigris
