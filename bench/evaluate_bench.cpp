// SPDX-License-Identifier: MIT
// The held-out protocol at the paper's size: 810 windows of two recordings of 128 x 128,
// persistence and the nine affine variants. The target is 20 s on two cores and 1 GB.
// bench/peers/evaluate_numpy.py reads the same samples (EVALUATE_BENCH_SAMPLES=FOLDER writes them).
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "verdigris/evaluate/characterize.h"
#include "verdigris/evaluate/evaluate.h"
#include "verdigris/files/npy.h"
#include "verdigris/observe/noise.h"

namespace {

using namespace verdigris;

constexpr int kSide = 128, kSamples = 984;
constexpr float kSigma = 0.0012f;

/// Samples as an observation stores them: 16-bit codes in memory.
class CodeStore final : public SampleStore {
  public:
    explicit CodeStore(unsigned seed) : codes_(std::size_t(kSamples) * kSide * kSide) {
        std::mt19937 random(seed);
        std::normal_distribution<float> noise(0, kSigma);
        std::vector<float> table(1 << 16);  // Gaussian noise, drawn once and walked through
        for (float& v : table) v = noise(random);
        for (std::size_t t = 0; t < kSamples; ++t) {
            const float jitter = table[t], age = float(t) / kSamples;
            std::size_t at = random() % table.size();
            for (int y = 0; y < kSide; ++y) {
                for (int x = 0; x < kSide; ++x) {
                    const bool metal = x > 10 && x < 118 && y > 10 && y < 118;
                    const float u = 0.1f * std::sin(0.11f * float(x)),
                                v = 0.1f * std::cos(0.17f * float(y));
                    const float move = metal ? std::sqrt(age) : 0;
                    const auto code = [&](float value) {
                        at = (at + 1) % table.size();
                        return std::uint16_t(65535 * (value + jitter + table[at]) + 0.5f);
                    };
                    const float gray = 0.45f + 0.001f * float(x);
                    codes_[(t * kSide + std::size_t(y)) * kSide + std::size_t(x)] =
                        metal
                            ? SrgbU16{code(0.6f + u - 0.15f * move), code(0.42f + v - 0.02f * move),
                                      code(0.33f - 3 * u * v + 0.06f * move)}
                            : SrgbU16{code(gray), code(gray), code(gray)};
                }
            }
        }
    }
    int count() const override { return kSamples; }
    int width() const override { return kSide; }
    int height() const override { return kSide; }
    Image<SrgbF> image(int index) const override {
        Image<SrgbF> out = Image<SrgbF>::for_overwrite(kSide, kSide);
        const SrgbU16* from = codes_.data() + std::size_t(index) * kSide * kSide;
        for (std::size_t i = 0; i < out.pixel_count(); ++i) {
            out.pixels()[i] = {float(from[i].r) / 65535, float(from[i].g) / 65535,
                               float(from[i].b) / 65535};
        }
        return out;
    }
    std::span<const std::byte> bytes() const { return std::as_bytes(std::span(codes_)); }

  private:
    std::vector<SrgbU16> codes_;
};

const std::vector<Observation>& recordings() {
    static const std::vector<Observation> made = [] {
        std::vector<Observation> list(2);
        for (unsigned i = 0; i < 2; ++i) {
            Observation& o = list[i];
            o.source_name = i == 0 ? "chamber" : "air";
            o.axis = {98.4, kSamples, 10, 1};
            const auto store = std::make_shared<CodeStore>(i + 1);
            o.store = store;
            o.specimen = Mask(kSide, kSide);
            for (int y = 11; y < 118; ++y) std::memset(o.specimen.row(y) + 11, 255, 107);
            o.noise = noise_from(kSigma, std::nullopt);
            // For the NumPy peer, which reads what is evaluated here.
            if (const char* folder = std::getenv("EVALUATE_BENCH_SAMPLES")) {
                write_npy(std::filesystem::path(folder) / (o.source_name + ".npy"), NpyType::u16,
                          {kSamples, kSide, kSide, 3}, store->bytes());
            }
        }
        return list;
    }();
    return made;
}

std::vector<Entrant> nine_variants() {
    std::vector<Entrant> list;
    for (const AffineFamily f :
         {AffineFamily::full, AffineFamily::per_channel, AffineFamily::single_gain}) {
        for (const int order : {0, 1, 2})
            list.push_back(training_free(affinergb(paper_affine(f, order))));
    }
    return list;
}

void whole_protocol(benchmark::State& state) {
    EvaluationProtocol protocol;
    protocol.delta_e = state.range(0) != 0;
    const auto& list = recordings();
    std::int64_t windows = 0;
    double error = 0;
    for (auto _ : state) {
        const Evaluation e = evaluate(protocol, list, nine_variants());
        for (const Direction& d : e.directions) windows += std::int64_t(d.starts.size());
        error = overall_mean(e.directions[1].entrants[2].foreground);
    }
    state.counters["windows/s"] = benchmark::Counter(double(windows), benchmark::Counter::kIsRate);
    state.counters["mse of full order 1, air"] = error;
}
BENCHMARK(whole_protocol)
    ->ArgName("delta_e")
    ->Arg(0)
    ->Arg(1)
    ->Iterations(1)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kSecond);

void table_two(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(characterize({}, recordings()).rows.size());
}
BENCHMARK(table_two)->Iterations(1)->MeasureProcessCPUTime()->UseRealTime()->Unit(
    benchmark::kSecond);

}  // namespace
