// SPDX-License-Identifier: MIT
// Measures the presets `chamber` and `air` against what the paper prints, as Markdown:
//   calibrate measure SEEDS   the table of docs/models/simulate.md
//   calibrate search SEEDS    looks for the tuned numbers of presets.cpp
// Everything is measured on what a user would have: the frames, through observe(). Only the masks
// of specimen and reference are the simulator's own.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <string>
#include <tuple>
#include <vector>

#include "verdigris/color/convert.h"
#include "verdigris/observe/binning.h"
#include "verdigris/observe/observe.h"
#include "verdigris/simulate/simulate.h"

namespace {

using namespace verdigris;

struct Measured {
    double ten_units = 0;    ///< mean over windows of mean |x(u + 10) - x(u)| over the crop
    double whole = 0;        ///< largest mean_c |specimen's mean - its mean at the start|
    double reference = 0;    ///< the same of the reference region
    double correlation = 0;  ///< of both luminances
    double noise = 0;        ///< sigma of one sample
};

/// [Paper], and the spread of its noise: three to one.
constexpr Measured kChamber{0.006, 0.128, 0.001, 0, 0}, kAir{0.012, 0.119, 0.026, -0.79, 0};

SrgbF mean_inside(const Image<SrgbU8>& frame, const Mask& mask) {
    double r = 0, g = 0, b = 0, n = 0;
    for (std::size_t i = 0; i < mask.pixel_count(); ++i) {
        if (!mask.pixels()[i]) continue;
        const SrgbF c = srgb_from_u8(frame.pixels()[i]);
        r += double(c.r), g += double(c.g), b += double(c.b), ++n;
    }
    return {float(r / n), float(g / n), float(b / n)};
}

// A centered moving average of 101 samples, shorter at the ends, as the paper smooths its drift.
std::vector<SrgbF> smoothed(const std::vector<SrgbF>& values) {
    std::vector<SrgbF> result;
    const int count = int(values.size());
    for (int i = 0; i < count; ++i) {
        const int reach = std::min({50, i, count - 1 - i});
        double r = 0, g = 0, b = 0;
        for (int k = i - reach; k <= i + reach; ++k) {
            const SrgbF c = values[std::size_t(k)];
            r += double(c.r), g += double(c.g), b += double(c.b);
        }
        const double n = 2 * reach + 1;
        result.push_back({float(r / n), float(g / n), float(b / n)});
    }
    return result;
}

double largest_movement(const std::vector<SrgbF>& values) {
    double largest = 0;
    const SrgbF start = values.front();
    for (const SrgbF c : values) {
        largest = std::max(largest, double(std::abs(c.r - start.r) + std::abs(c.g - start.g) +
                                           std::abs(c.b - start.b)) /
                                        3);
    }
    return largest;
}

double correlation(const std::vector<SrgbF>& a, const std::vector<SrgbF>& b) {
    double ma = 0, mb = 0, aa = 0, bb = 0, ab = 0;
    for (std::size_t i = 0; i < a.size(); ++i) ma += double(luma(a[i])), mb += double(luma(b[i]));
    ma /= double(a.size()), mb /= double(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double da = double(luma(a[i])) - ma, db = double(luma(b[i])) - mb;
        aa += da * da, bb += db * db, ab += da * db;
    }
    return ab / std::sqrt(aa * bb);
}

double ten_unit_change(const Observation& o) {
    const auto [first, last] = paper_valid_range(o.store->count());
    const int span = 10 * o.axis.samples_per_unit;
    double sum = 0;
    int windows = 0;
    for (int i = first; i + span < last; i += 2 * o.axis.samples_per_unit, ++windows) {
        const Image<SrgbF> a = o.store->image(i), b = o.store->image(i + span);
        double change = 0;
        for (std::size_t k = 0; k < a.pixel_count(); ++k) {
            const SrgbF p = a.pixels()[k], q = b.pixels()[k];
            change += double(std::abs(p.r - q.r) + std::abs(p.g - q.g) + std::abs(p.b - q.b));
        }
        sum += change / 3 / double(a.pixel_count());
    }
    return sum / windows;
}

Measured measure(SimulationSpec spec, std::uint64_t seed) {
    spec.seed = seed;
    const CellGrid grid = specimen_grid(spec);
    const Scene scene(spec, grid);
    const Mask specimen = scene.specimen(), reference = scene.reference();
    const Recording recording = simulated_recording(spec);
    std::vector<SrgbF> on_specimen, on_reference;
    const auto reader = recording.read();
    Frame frame;
    while (reader->next(frame)) {
        const Plane& plane = frame.planes.plane[0];
        Image<SrgbU8> image(spec.frames.width, spec.frames.height);
        for (int y = 0; y < image.height(); ++y)
            std::memcpy(image.row(y), plane.data + y * plane.stride_bytes,
                        std::size_t(image.width()) * sizeof(SrgbU8));
        on_specimen.push_back(mean_inside(image, specimen));
        on_reference.push_back(mean_inside(image, reference));
    }
    on_specimen = smoothed(on_specimen);
    on_reference = smoothed(on_reference);
    ObserveOptions options;
    options.keep = Keep::every_sample;
    const Observation observation = observe(recording, options);
    return {ten_unit_change(observation), largest_movement(on_specimen),
            largest_movement(on_reference), correlation(on_specimen, on_reference),
            observation.noise.sigma};
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return n % 2 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

// The medians over seeds: a light that drifts at random makes single specimens differ a lot.
Measured typical(const std::vector<Measured>& all) {
    const auto of = [&](double Measured::*what) {
        std::vector<double> values;
        for (const Measured& m : all) values.push_back(m.*what);
        return median(values);
    };
    return {of(&Measured::ten_units), of(&Measured::whole), of(&Measured::reference),
            of(&Measured::correlation), of(&Measured::noise)};
}

std::vector<Measured> over_seeds(const SimulationSpec& spec, int seeds) {
    std::vector<Measured> all;
    for (int seed = 1; seed <= seeds; ++seed) all.push_back(measure(spec, std::uint64_t(seed)));
    return all;
}

std::string range(const std::vector<Measured>& all, double Measured::*what, int digits) {
    double low = all.front().*what, high = low;
    for (const Measured& m : all) low = std::min(low, m.*what), high = std::max(high, m.*what);
    return fmt::format("{:.{}f} ({:.{}f} to {:.{}f})", typical(all).*what, digits, low, digits,
                       high, digits);
}

void print_table(int seeds) {
    const auto chamber = over_seeds(preset_spec("chamber"), seeds);
    const auto air = over_seeds(preset_spec("air"), seeds);
    fmt::print(
        "| | chamber, printed | simulated | air, printed | simulated |\n|---|---|---|---|---|\n");
    const auto row = [&](const char* name, double Measured::*what, int digits,
                         const char* of_chamber, const char* of_air) {
        fmt::print("| {} | {} | {} | {} | {} |\n", name, of_chamber, range(chamber, what, digits),
                   of_air, range(air, what, digits));
    };
    row("mean change over 10 units", &Measured::ten_units, 4, "0.006", "0.012");
    row("specimen, whole recording", &Measured::whole, 3, "0.128", "0.119");
    row("reference, whole recording", &Measured::reference, 4, "0.001", "0.026");
    row("their correlation", &Measured::correlation, 2, "not printed", "-0.79");
    row("noise of a sample", &Measured::noise, 5, "not printed", "not printed");
    fmt::print("\nair over chamber, noise: {:.2f} (printed: about 3)\n",
               typical(air).noise / typical(chamber).noise);
}

// Each number is moved by the ratio of what is wanted to what is measured, all at once; they nearly
// decouple, so a few rounds do.
void search(int seeds) {
    SimulationSpec chamber = preset_spec("chamber"), air = preset_spec("air");
    const auto nudge = [](double& value, double wanted, double measured, double power) {
        value *= std::clamp(std::pow(wanted / measured, power), 0.5, 2.0);
    };
    for (int round = 0; round < 8; ++round) {
        const Measured c = typical(over_seeds(chamber, seeds));
        const Measured a = typical(over_seeds(air, seeds));
        for (const auto& [name, spec, m] :
             {std::tuple{"chamber", &chamber, &c}, std::tuple{"air", &air, &a}}) {
            fmt::print(
                "{} {}: initial_nm {:.4g} rate {:.4g} auto_exposure {:.4g} light_drift {:.4g} "
                "white_balance {:.4g} read_noise {:.4g} shot_noise {:.4g}: "
                "ten {:.4f} whole {:.4f} reference {:.4f} correlation {:.3f} noise {:.5f}\n",
                round, name, spec->oxide.initial_nm, spec->oxide.growth.parabolic_rate,
                spec->camera.auto_exposure, spec->camera.light_drift, spec->camera.white_balance,
                spec->camera.read_noise, spec->camera.shot_noise, m->ten_units, m->whole,
                m->reference, m->correlation, m->noise);
        }
        std::fflush(stdout);
        nudge(chamber.oxide.growth.parabolic_rate, kChamber.whole, c.whole, 2);
        nudge(chamber.oxide.initial_nm, kChamber.ten_units, c.ten_units, 1.5);
        nudge(chamber.camera.light_drift, kChamber.reference, c.reference, 1);
        nudge(air.oxide.growth.parabolic_rate, kAir.whole, a.whole, 2);
        nudge(air.oxide.initial_nm, kAir.ten_units, a.ten_units, 1.5);
        nudge(air.camera.auto_exposure, kAir.reference, a.reference, 1);
        air.camera.auto_exposure = std::min(air.camera.auto_exposure, 1.0);
        // More light that drifts by itself, less correlation: through the tangent of the angle.
        const double is = std::acos(std::clamp(-a.correlation, 0.01, 0.999));
        nudge(air.camera.light_drift, std::tan(std::acos(-kAir.correlation)), std::tan(is), 0.7);
        const double noise = 3 * c.noise / a.noise;
        nudge(air.camera.read_noise, noise, 1, 1);
        nudge(air.camera.shot_noise, noise, 1, 2);
    }
}

}  // namespace

int main(int argc, char** argv) {
    const std::string what = argc > 1 ? argv[1] : "";
    const int seeds = argc > 2 ? std::max(1, std::atoi(argv[2])) : 5;
    if (what == "measure") return print_table(seeds), 0;
    if (what == "search") return search(seeds), 0;
    std::fprintf(stderr, "usage: calibrate measure|search [seeds]\n");
    return 2;
}
