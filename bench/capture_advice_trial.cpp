// SPDX-License-Identifier: MIT
// Is the advice of `inspect` good? Recordings are cut off, the advice is asked for, and the error
// is measured with what was cut off: no timing, but scripts/advice_results.sh.
//   capture_advice_trial STRIDE RECORDING...
// A line per cut: recording, first frame, frames n, frames more m, expected error at n, measured,
// ratio expected of n + m, ratio measured. Errors are root mean squares over the ten units that
// follow the cut, on the specimen, the noise of the frames compared with taken off.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <utility>

#include "verdigris/forecast/band_trend.h"
#include "verdigris/forecast/capture_advice.h"
#include "verdigris/observe/observe.h"

namespace {

using namespace verdigris;

constexpr int kAhead = 10, kStep = 10, kLongest = 40;

struct Held {
    Observation observation;
    std::vector<Image<SrgbF>> frames;
};

Held held(const char* path, int stride) {
    ObserveOptions options;
    options.size = kRecentSide;
    options.keep = Keep::every_sample;
    Held h{observe(open_recording(path, {}), options), {}};
    const int all = h.observation.store->count();
    for (int i = (all - 1) % stride; i < all; i += stride)
        h.frames.push_back(h.observation.store->image(i));
    return h;
}

double square(const Image<SrgbF>& a, const Image<SrgbF>& b, const Mask& inside) {
    double sum = 0;
    std::int64_t count = 0;
    for (std::size_t i = 0; i < inside.pixels().size(); ++i) {
        if (inside.pixels()[i] == 0) continue;
        const SrgbF p = a.pixels()[i], q = b.pixels()[i];
        sum += std::pow(p.r - q.r, 2) + std::pow(p.g - q.g, 2) + std::pow(p.b - q.b, 2);
        ++count;
    }
    return sum / double(3 * count);
}

double measured(const Held& h, int first, int n, const Forecaster& forecaster) {
    const Observation& o = h.observation;
    Context context;
    for (int i = first; i < first + n; ++i)
        context.frames.push_back(h.frames[std::size_t(i)].clone());
    context.specimen = o.specimen.clone();
    context.clipped = o.clipped.clone();
    context.sigma = o.noise.sigma;
    context.tau = o.noise.tau;
    const Forecast f = forecaster.forecast(context);
    double sum = 0;
    for (int ahead = 1; ahead <= kAhead; ++ahead)
        sum += square(f.at(ahead), h.frames[std::size_t(first + n - 1 + ahead)], o.specimen);
    return std::sqrt(std::max(1e-12, sum / kAhead - o.noise.sigma * o.noise.sigma));
}

CaptureAdvice advice(const Held& h, int first, int n) {
    RecentUnits recent;
    for (int i = first; i < first + n; ++i)
        recent.frames.push_back(h.frames[std::size_t(i)].clone());
    recent.specimen = h.observation.specimen.clone();
    recent.frames_recorded = n;
    recent.units = n;
    recent.frames_per_unit = 1;
    return capture_advice(recent);
}

}  // namespace

int main(int argc, char** argv) {
    const Forecaster forecaster = band_trend({true, false, {}});
    for (int r = 2; r < argc; ++r) {
        const Held h = held(argv[r], std::max(1, std::atoi(argv[1])));
        const int count = int(h.frames.size());
        std::map<std::pair<int, int>, double> error;
        const auto error_of = [&](int first, int n) {
            auto [at, made] = error.try_emplace({first, n}, 0.0);
            if (made) at->second = measured(h, first, n, forecaster);
            return at->second;
        };
        for (const int n : {10, 20}) {
            for (int first = 0; first + n + kStep + kAhead <= count; first += kStep) {
                const CaptureAdvice a = advice(h, first, n);
                for (const CaptureOutlook& o : a.outlooks) {
                    const int longer = n + int(o.units);
                    const bool compared = o.units == 10 || o.units == 20 || o.units == 30;
                    if (!compared || longer > kLongest || first + longer + kAhead > count) continue;
                    fmt::print("{} {} {} {} {:.3g} {:.3g} {:.3f} {:.3f}\n",
                               h.observation.source_name, first, n, o.units, a.error,
                               error_of(first, n), o.error / a.error,
                               error_of(first, longer) / error_of(first, n));
                }
            }
        }
    }
    return 0;
}
