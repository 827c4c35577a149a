// SPDX-License-Identifier: MIT
// FLIP.h of its authors and ours in turn, on one pair in memory; built by flip_authors.sh, which
// knows where theirs lies. Theirs is handed linear light, which ours makes itself.
#include <FLIP.h>
#include <omp.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <variant>
#include <vector>

#include "verdigris/color/convert.h"
#include "verdigris/files/image_file.h"
#include "verdigris/metrics/flip.h"
#include "verdigris/pixels/parallel_rows.h"

namespace {

using namespace verdigris;

double seconds_of_cpu() {
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return double(usage.ru_utime.tv_sec) + 1e-6 * double(usage.ru_utime.tv_usec);
}

struct Times {
    std::vector<double> wall, cpu;
    double mean = 0;

    template <class Body>
    void add(Body body) {
        const auto start = std::chrono::steady_clock::now();
        const double cpu_start = seconds_of_cpu();
        mean = body();
        cpu.push_back(seconds_of_cpu() - cpu_start);
        wall.push_back(
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    static double median(std::vector<double> v) {
        std::sort(v.begin(), v.end());
        return v[v.size() / 2];
    }
    void print(const char* name) const {
        std::printf("%-8s wall %7.1f ms  cpu %7.1f ms  mean %.7f\n", name, 1e3 * median(wall),
                    1e3 * median(cpu), mean);
    }
};

Image<SrgbF> read(const char* path) {
    const ImageFile file = read_image(path);
    const auto& codes = std::get<Image<SrgbU8>>(file.pixels);
    Image<SrgbF> image(codes.width(), codes.height());
    for (std::size_t i = 0; i < codes.pixel_count(); ++i)
        image.pixels()[i] = srgb_from_u8(codes.pixels()[i]);
    return image;
}

std::vector<float> linear_light(const Image<SrgbF>& image) {
    std::vector<float> out;
    for (const SrgbF& c : image.pixels())
        for (const float v : {c.r, c.g, c.b}) out.push_back(linear_from_srgb(v));
    return out;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 5) return 2;
    const Image<SrgbF> reference = read(argv[1]), test = read(argv[2]);
    const int rounds = std::atoi(argv[3]), threads = std::atoi(argv[4]);
    const int width = test.width(), height = test.height();
    const std::vector<float> a = linear_light(reference), b = linear_light(test);
    set_thread_count(threads);
    omp_set_num_threads(threads);
    Times theirs, ours;
    for (int i = 0; i < rounds; ++i) {
        theirs.add([&] {
            FLIP::Parameters parameters;
            parameters.PPD = float(kFlipPixelsPerDegree);
            float mean = 0, *map = nullptr;
            FLIP::evaluate(a.data(), b.data(), width, height, false, parameters, false, false, mean,
                           &map);
            const std::unique_ptr<float[]> owned(map);
            double sum = 0;  // their own sum is in float
            for (std::size_t k = 0; k < test.pixel_count(); ++k) sum += double(map[k]);
            return sum / double(test.pixel_count());
        });
        ours.add([&] { return flip(reference, test).mean; });
    }
    theirs.print("authors'");
    ours.print("ours");
    std::printf("ratio    wall %7.1f     cpu %7.1f\n",
                Times::median(theirs.wall) / Times::median(ours.wall),
                Times::median(theirs.cpu) / Times::median(ours.cpu));
}
