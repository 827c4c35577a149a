// SPDX-License-Identifier: MIT
// Simulation: a whole small recording, and what a frame at the paper's size costs against memcpy of
// its bytes.
#include <benchmark/benchmark.h>

#include <cstring>
#include <vector>

#include "verdigris/simulate/simulate.h"

namespace {

using namespace verdigris;

// 128 x 128 x 950, each preset: the yardstick. Counters: seconds of either half.
void whole_recording(benchmark::State& state) {
    SimulationSpec spec = preset_spec(preset_names()[std::size_t(state.range(0))]);
    state.SetLabel(spec.preset);
    spec.frames.width = spec.frames.height = 128;
    spec.frames.count = 950;
    double specimen = 0, camera = 0;
    for (auto _ : state) {
        const SimulationResult result = simulate(spec, {});
        specimen += result.seconds_specimen;
        camera += result.seconds_camera;
    }
    state.counters["specimen_s"] = specimen / double(state.iterations());
    state.counters["camera_s"] = camera / double(state.iterations());
}
BENCHMARK(whole_recording)->DenseRange(0, 5)->Unit(benchmark::kMillisecond)->UseRealTime();

SimulationSpec full_chamber() {
    SimulationSpec spec = full_size(preset_spec("chamber"));
    spec.camera.read_noise = 0.002;
    return spec;
}

void full_frame_exposed(benchmark::State& state) {
    const SimulationSpec spec = full_chamber();
    Specimen specimen(spec);
    const Scene scene(spec, specimen.grid());
    Image<LinearF> before, after;
    scene.compose(specimen.color(), before);
    specimen.advance_to(0.1);
    scene.compose(specimen.color(), after);
    CameraTrack track(spec);
    track.see(0.3);
    const Camera camera(spec);
    Image<SrgbU8> frame;
    int index = 0;
    for (auto _ : state) {
        camera.expose(before, after, 0.5, track.gains(0), index++, frame);
        benchmark::DoNotOptimize(frame.row(0));
    }
}
BENCHMARK(full_frame_exposed)->Unit(benchmark::kMillisecond)->UseRealTime();

// One node of 0.1 units: 36.6 frames of the chamber share it.
void full_node_corroded_and_composed(benchmark::State& state) {
    const SimulationSpec spec = full_chamber();
    Specimen specimen(spec);
    const Scene scene(spec, specimen.grid());
    Image<LinearF> frame;
    double unit = 0;
    for (auto _ : state) {
        unit += 0.1;
        specimen.advance_to(unit);
        scene.compose(specimen.color(), frame);
        benchmark::DoNotOptimize(frame.row(0));
    }
}
BENCHMARK(full_node_corroded_and_composed)->Unit(benchmark::kMillisecond)->UseRealTime();

// What no program that touches the light of every pixel can beat: reading two frames of linear
// light.
void full_frame_memcpy(benchmark::State& state) {
    std::vector<float> from(1920 * 1080 * 6, 0.5f), to(from.size());
    for (auto _ : state) {
        std::memcpy(to.data(), from.data(), from.size() * sizeof(float));
        benchmark::DoNotOptimize(to.data());
    }
}
BENCHMARK(full_frame_memcpy)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
