// SPDX-License-Identifier: MIT
// How fast is observe() on a real file? Prints frames per second and the peak of the memory.
//   observe_clip FILE [none|automatic] [every] [size N] [to FOLDER]
// bench/observe_vs_ffmpeg.sh compares it with ffmpeg decoding to nothing.
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "verdigris/observe/observation_io.h"
#include "verdigris/observe/observe.h"
#include "verdigris/recording/recording.h"

int main(int argc, char** argv) try {
    using namespace verdigris;
    if (argc < 2) {
        std::fprintf(stderr,
                     "usage: observe_clip FILE [none|automatic] [every] [size N] [to DIR]\n");
        return 2;
    }
    ObserveOptions options;
    std::filesystem::path folder;
    for (int i = 2; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "none") options.crop.mode = CropMode::none;
        if (word == "every") options.keep = Keep::every_sample;
        if (word == "size" && i + 1 < argc) options.size = std::atoi(argv[++i]);
        if (word == "to" && i + 1 < argc) folder = argv[++i];
    }
    if (!folder.empty()) options.store = folder / "samples.npy";
    const auto start = std::chrono::steady_clock::now();
    const Recording recording = open_recording(argv[1]);
    // Seconds per stage: from its first report to that of the next.
    std::vector<std::pair<std::string, double>> stages{{"open", 0}};
    const auto now = [&start] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    const Progress progress = [&](std::string_view stage, std::int64_t, std::int64_t) {
        if (stages.back().first != stage) stages.emplace_back(stage, now());
        return true;
    };
    const Observation o = observe(recording, options, progress);
    for (std::size_t i = 0; i < stages.size(); ++i) {
        const double end = i + 1 < stages.size() ? stages[i + 1].second : now();
        std::fprintf(stderr, "%-8s %7.3f s\n", stages[i].first.c_str(), end - stages[i].second);
    }
    if (!folder.empty()) write_observation(o, folder);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    std::printf(
        "{\"frames\": %d, \"seconds\": %.3f, \"fps\": %.1f, \"cpu_seconds\": %.2f, "
        "\"peak_mb\": %.0f, \"samples\": %d, \"width\": %d, \"height\": %d, "
        "\"sigma\": %.5f, \"crop\": \"%s\"}\n",
        o.decode.decoded, seconds, o.decode.decoded / seconds,
        double(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
            1e-6 * double(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec),
        double(usage.ru_maxrss) / 1024, int(o.samples.size()), o.width(), o.height(), o.noise.sigma,
        o.crop.sentence.c_str());
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
}
