// SPDX-License-Identifier: MIT
#include "verdigris/metrics/ssim.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "verdigris/error.h"
#include "verdigris/metrics/image_pair.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

// [Wang2004], Section III.B and C, for a data range of 1.
constexpr int kWindow = kSsimSmallest;
constexpr double kSigma = 1.5, kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;
// [Wang2003], Section 3.2, from the finest scale on.
constexpr std::array<double, 5> kScaleWeights{0.0448, 0.2856, 0.3001, 0.2363, 0.1333};
constexpr int kRowsPerRun = 16;

using Window = std::array<double, kWindow>;
using Plane = Image<double>;

Window gaussian_window() {
    Window w{};
    double sum = 0;
    for (int i = 0; i < kWindow; ++i) {
        const double x = (i - kWindow / 2) / kSigma;
        sum += w[std::size_t(i)] = std::exp(-0.5 * x * x);
    }
    for (double& v : w) v /= sum;
    return w;
}

Plane channel_of(ImageView<const SrgbF> image, float SrgbF::*channel) {
    Plane plane = Plane::for_overwrite(image.width(), image.height());
    parallel_rows(image.height(), kRowsPerRun, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            std::transform(image.row(y), image.row(y) + image.width(), plane.row(y),
                           [&](const SrgbF& c) { return limited(c.*channel); });
        }
    });
    return plane;
}

/// Sums over places of the similarity and of its contrast and structure alone.
struct Similarity {
    double whole = 0, structure = 0;
};

/// Row `y` of the windows' moments, columns first: five rows stay in the first cache.
class MomentRows {
  public:
    explicit MomentRows(int width) : width_(std::size_t(width)) {
        for (auto* row : {&a_, &b_, &aa_, &bb_, &ab_}) row->resize(width_);
    }

    Similarity similarity(const Plane& a, const Plane& b, int y, const Window& window) {
        for (auto* row : {&a_, &b_, &aa_, &bb_, &ab_}) std::fill(row->begin(), row->end(), 0.0);
        for (int k = 0; k < kWindow; ++k) add(a.row(y + k), b.row(y + k), window[std::size_t(k)]);
        Similarity sum;
        for (std::size_t x = 0; x + kWindow <= width_; ++x) {
            double ma = 0, mb = 0, aa = 0, bb = 0, ab = 0;
            for (std::size_t k = 0; k < kWindow; ++k) {
                const double w = window[k];
                ma += w * a_[x + k];
                mb += w * b_[x + k];
                aa += w * aa_[x + k];
                bb += w * bb_[x + k];
                ab += w * ab_[x + k];
            }
            const double structure =
                (2 * (ab - ma * mb) + kC2) / ((aa - ma * ma) + (bb - mb * mb) + kC2);
            sum.structure += structure;
            sum.whole += structure * (2 * ma * mb + kC1) / (ma * ma + mb * mb + kC1);
        }
        return sum;
    }

  private:
    void add(const double* a, const double* b, double w) {
        for (std::size_t x = 0; x < width_; ++x) {
            const double wa = w * a[x], wb = w * b[x];
            a_[x] += wa;
            b_[x] += wb;
            aa_[x] += wa * a[x];
            bb_[x] += wb * b[x];
            ab_[x] += wa * b[x];
        }
    }

    std::size_t width_;
    std::vector<double> a_, b_, aa_, bb_, ab_;
};

Similarity mean_similarity(const Plane& a, const Plane& b) {
    const Window window = gaussian_window();
    const int rows = a.height() - kWindow + 1, columns = a.width() - kWindow + 1;
    const auto partials = map_rows<Similarity>(rows, kRowsPerRun, [&](RowRun run) {
        MomentRows moments(a.width());
        Similarity sum;
        for (int y = run.begin; y < run.end; ++y) {
            const Similarity row = moments.similarity(a, b, y, window);
            sum.whole += row.whole;
            sum.structure += row.structure;
        }
        return sum;
    });
    Similarity all;
    for (const Similarity& p : partials) {
        all.whole += p.whole;
        all.structure += p.structure;
    }
    const double places = double(rows) * columns;
    return {all.whole / places, all.structure / places};
}

Plane halved(const Plane& plane) {
    const int width = (plane.width() + 1) / 2, height = (plane.height() + 1) / 2;
    Plane out = Plane::for_overwrite(width, height);
    parallel_rows(height, kRowsPerRun, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            const double *upper = plane.row(2 * y),
                         *lower = plane.row(std::min(2 * y + 1, plane.height() - 1));
            for (int x = 0; x < width; ++x) {
                const int left = 2 * x, right = std::min(2 * x + 1, plane.width() - 1);
                out.row(y)[x] = (upper[left] + upper[right] + lower[left] + lower[right]) / 4;
            }
        }
    });
    return out;
}

void check_size(ImageView<const SrgbF> image, int smallest, const char* name) {
    if (image.width() < smallest || image.height() < smallest) {
        throw Error(ErrorCode::bad_input,
                    fmt::format("{} needs pictures of at least {} x {} pixels; these have {} x {}",
                                name, smallest, smallest, image.width(), image.height()));
    }
}

constexpr std::array<float SrgbF::*, 3> kChannels{&SrgbF::r, &SrgbF::g, &SrgbF::b};

}  // namespace

double ssim(ImageView<const SrgbF> reference, ImageView<const SrgbF> test) {
    check_pair(reference, test);
    check_size(reference, kSsimSmallest, "SSIM");
    double sum = 0;
    for (const auto channel : kChannels)
        sum += mean_similarity(channel_of(reference, channel), channel_of(test, channel)).whole;
    return sum / double(kChannels.size());
}

double ms_ssim(ImageView<const SrgbF> reference, ImageView<const SrgbF> test) {
    check_pair(reference, test);
    check_size(reference, kMsSsimSmallest, "MS-SSIM");
    double sum = 0;
    for (const auto channel : kChannels) {
        Plane a = channel_of(reference, channel), b = channel_of(test, channel);
        double product = 1;
        for (std::size_t scale = 0; scale < kScaleWeights.size(); ++scale) {
            const bool last = scale + 1 == kScaleWeights.size();
            const Similarity s = mean_similarity(a, b);
            product *= std::pow(std::max(last ? s.whole : s.structure, 0.0), kScaleWeights[scale]);
            if (last) break;
            a = halved(a);
            b = halved(b);
        }
        sum += product;
    }
    return sum / double(kChannels.size());
}

}  // namespace verdigris
