// SPDX-License-Identifier: MIT
#include "verdigris/forecast/increments.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "verdigris/forecast/backdrop_light.h"
#include "verdigris/forecast/context_noise.h"
#include "verdigris/forecast/context_pixels.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

using Eigen::MatrixXd;
constexpr int kChunk = 8192;  // values per task: sums are combined chunk by chunk, in order

int chunks(std::size_t size) {
    return int((size + kChunk - 1) / kChunk);
}
std::size_t chunk_end(int chunk, std::size_t size) {
    return std::min(std::size_t(chunk + 1) * kChunk, size);
}

using Vector4 = Eigen::Vector4d;
Vector4 features(const SrgbF& c) {
    return {1, double(c.r), double(c.g), double(c.b)};
}

Image<SrgbF> mean_color(const std::vector<Image<SrgbF>>& frames) {
    Image<SrgbF> mean(frames.front().width(), frames.front().height());
    const float share = 1 / float(frames.size());
    parallel_rows(mean.height(), 32, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            for (const auto& frame : frames) {
                for (int x = 0; x < mean.width(); ++x) {
                    SrgbF& to = mean(x, y);
                    const SrgbF c = frame(x, y);
                    to = {to.r + share * c.r, to.g + share * c.g, to.b + share * c.b};
                }
            }
        }
    });
    return mean;
}

}  // namespace

Increments increments_of(const Context& context, const Mask& moving, bool relight) {
    const int n = context.length();
    const auto light = relight ? backdrop_light(context)
                               : std::vector<std::array<double, 3>>(std::size_t(n), {1, 1, 1});
    std::vector<Image<SrgbF>> relit_frames(std::size_t(n - 1));
    for (int i = 0; i + 1 < n; ++i)
        relit_frames[std::size_t(i)] = relit(context.frames[std::size_t(i)], light[std::size_t(i)]);
    const auto frame = [&](int i) {
        return i + 1 < n ? relit_frames[std::size_t(i)].pixels() : context.frames.back().pixels();
    };
    Increments out(std::size_t(n - 1));
    const auto inside = moving.pixels();
    parallel_for(n - 1, [&](int i) {
        const auto before = frame(i), after = frame(i + 1);
        ColorField& d = out[std::size_t(i)];
        for (Field& p : d) p.resize(inside.size());
        for (std::size_t at = 0; at < inside.size(); ++at) {
            const float on = inside[at] ? 1.0f : 0.0f;
            d[0][at] = on * (after[at].r - before[at].r);
            d[1][at] = on * (after[at].g - before[at].g);
            d[2][at] = on * (after[at].b - before[at].b);
        }
    });
    return out;
}

Increments affine_part(const Context& context, const Mask& moving, const Increments& increments) {
    const Image<SrgbF> color = mean_color(context.frames);
    const auto colors = color.pixels();
    const auto inside = moving.pixels();
    const auto q = Eigen::Index(increments.size());
    struct Moments {
        Eigen::Matrix4d xx = Eigen::Matrix4d::Zero();
        MatrixXd xd;
        double count = 0;
    };
    std::vector<Moments> parts(std::size_t(chunks(inside.size())));
    parallel_for(int(parts.size()), [&](int chunk) {
        Moments& m = parts[std::size_t(chunk)];
        m.xd = MatrixXd::Zero(4, 3 * q);
        for (auto at = std::size_t(chunk) * kChunk; at < chunk_end(chunk, inside.size()); ++at) {
            if (inside[at] == 0) continue;
            const Vector4 x = features(colors[at]);
            m.xx += x * x.transpose();
            ++m.count;
            for (Eigen::Index i = 0; i < q; ++i)
                for (Eigen::Index k = 0; k < 3; ++k)
                    m.xd.col(3 * i + k) +=
                        x * double(increments[std::size_t(i)][std::size_t(k)][at]);
        }
    });
    Moments all{Eigen::Matrix4d::Zero(), MatrixXd::Zero(4, 3 * q), 0};
    for (const Moments& m : parts) all.xx += m.xx, all.xd += m.xd, all.count += m.count;
    // Centered, so that the ridge holds back the slopes and not the mean.
    const Eigen::Vector3d mean = all.xx.block<3, 1>(1, 0) / all.count;
    const Eigen::Matrix3d spread = all.xx.block<3, 3>(1, 1) / all.count - mean * mean.transpose();
    const double sigma =
        context.sigma > 0 ? context.sigma : context_noise(context.frames, moving, 1e-3);
    const double ridge = 3 * sigma * sigma / context.length() + 1e-12;
    const MatrixXd mean_change = all.xd.row(0) / all.count;
    const MatrixXd together = all.xd.bottomRows(3) / all.count - mean * mean_change;
    const MatrixXd slopes =
        Eigen::LDLT<Eigen::Matrix3d>(spread + ridge * Eigen::Matrix3d::Identity()).solve(together);
    MatrixXd fit(4, 3 * q);
    fit.row(0) = mean_change - mean.transpose() * slopes;
    fit.bottomRows(3) = slopes;
    Increments out(increments.size());
    parallel_for(int(q), [&](int i) {
        for (int k = 0; k < 3; ++k) {
            Field& to = out[std::size_t(i)][std::size_t(k)];
            to.resize(inside.size());
            const Eigen::Vector4f f = fit.col(3 * i + k).cast<float>();
            for (std::size_t at = 0; at < inside.size(); ++at) {
                const SrgbF c = colors[at];
                to[at] = inside[at] ? f[0] + f[1] * c.r + f[2] * c.g + f[3] * c.b : 0;
            }
        }
    });
    return out;
}

void smooth_part(const Increments& increments, const Mask& moving, int sigma, Increments& out) {
    const MaskedGaussian gaussian(moving, sigma);
    out.resize(increments.size());
    parallel_for(3 * int(increments.size()), [&](int i) {
        gaussian.mean(increments[std::size_t(i / 3)][std::size_t(i % 3)],
                      out[std::size_t(i / 3)][std::size_t(i % 3)]);
    });
}

void subtract(const Increments& part, Increments& from) {
    parallel_for(3 * int(from.size()), [&](int i) {
        const Field& p = part[std::size_t(i / 3)][std::size_t(i % 3)];
        Field& f = from[std::size_t(i / 3)][std::size_t(i % 3)];
        for (std::size_t at = 0; at < f.size(); ++at) f[at] -= p[at];
    });
}

MatrixXd gram_of(const Increments& increments) {
    const std::size_t size = increments.front()[0].size();
    const auto q = Eigen::Index(increments.size());
    std::vector<MatrixXd> parts(std::size_t(chunks(size)));
    parallel_for(int(parts.size()), [&](int chunk) {
        MatrixXd& g = parts[std::size_t(chunk)];
        g = MatrixXd::Zero(q, q);
        const std::size_t begin = std::size_t(chunk) * kChunk, end = chunk_end(chunk, size);
        // Rows of values in double: a product of matrices then does the work.
        Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values(
            q, Eigen::Index(end - begin));
        for (std::size_t k = 0; k < 3; ++k) {
            for (Eigen::Index i = 0; i < q; ++i) {
                const float* from = increments[std::size_t(i)][k].data() + begin;
                for (Eigen::Index at = 0; at < values.cols(); ++at)
                    values(i, at) = double(from[at]);
            }
            g.selfadjointView<Eigen::Lower>().rankUpdate(values);
        }
    });
    MatrixXd gram = MatrixXd::Zero(q, q);
    for (const MatrixXd& g : parts) gram += g;
    gram.triangularView<Eigen::StrictlyUpper>() = gram.transpose();
    return gram / (3 * double(size));
}

ColorField combined(const Increments& increments, const Eigen::RowVectorXd& weights) {
    ColorField out;
    parallel_for(3, [&](int k) {
        Field& to = out[std::size_t(k)];
        to.assign(increments.front()[0].size(), 0);
        for (std::size_t i = 0; i < increments.size(); ++i) {
            const float w = float(weights[Eigen::Index(i)]);
            const Field& from = increments[i][std::size_t(k)];
            for (std::size_t at = 0; at < to.size(); ++at) to[at] += w * from[at];
        }
    });
    return out;
}

Image<SrgbF> image_of(const std::vector<const ColorField*>& planes,
                      const Eigen::RowVectorXd& weights, const Image<SrgbF>& like) {
    Image<SrgbF> out(like.width(), like.height());
    const auto width = std::size_t(like.width());
    parallel_rows(like.height(), 32, [&](RowRun run) {
        for (std::size_t i = 0; i < planes.size(); ++i) {
            const float w = float(weights[Eigen::Index(i)]);
            const ColorField& p = *planes[i];
            for (int y = run.begin; y < run.end; ++y) {
                SrgbF* to = out.row(y);
                const std::size_t row = std::size_t(y) * width;
                for (std::size_t x = 0; x < width; ++x)
                    to[x] = {to[x].r + w * p[0][row + x], to[x].g + w * p[1][row + x],
                             to[x].b + w * p[2][row + x]};
            }
        }
    });
    return out;
}

double mean_square_difference(const Image<SrgbF>& a, const Image<SrgbF>& b, const Mask& inside) {
    struct Sum {
        double squares = 0, count = 0;
    };
    const auto sums = map_rows<Sum>(a.height(), 32, [&](RowRun run) {
        Sum s;
        for (int y = run.begin; y < run.end; ++y) {
            for (int x = 0; x < a.width(); ++x) {
                if (inside(x, y) == 0) continue;
                const SrgbF p = a(x, y), q = b(x, y);
                const double r = double(p.r - q.r), g = double(p.g - q.g), c = double(p.b - q.b);
                s.squares += r * r + g * g + c * c;
                s.count += 3;
            }
        }
        return s;
    });
    Sum all;
    for (const Sum& s : sums) all.squares += s.squares, all.count += s.count;
    return all.count > 0 ? all.squares / all.count : 0;
}

}  // namespace verdigris
