// SPDX-License-Identifier: MIT
#include "verdigris/forecast/change_part.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "verdigris/forecast/backdrop_light.h"
#include "verdigris/forecast/context_noise.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector4d;

constexpr int kChunk = 8192;  // values per task: sums are combined chunk by chunk, in order
constexpr int kRowsPerTask = 32;
constexpr Eigen::Index kRun = 256;  // values that are summed in single precision
constexpr double kNudge = 0.01;     // of light, to see what a change of it does to a picture

int rows_per_chunk(int width) {
    return std::max(1, kChunk / width);
}

Image<SrgbF> mean_color(const std::vector<Image<SrgbF>>& frames) {
    Image<SrgbF> mean(frames.front().width(), frames.front().height());
    const float share = 1 / float(frames.size());
    parallel_rows(mean.height(), kRowsPerTask, [&](RowRun run) {
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

/// Derivative of encoded values by the log of the light.
Image<SrgbF> light_slope(Image<SrgbF> picture) {
    const double nudge = std::log1p(kNudge);
    const Image<SrgbF> brighter = relit(picture, {1 + kNudge, 1 + kNudge, 1 + kNudge});
    for (std::size_t i = 0; i < picture.pixels().size(); ++i) {
        SrgbF& c = picture.pixels()[i];
        const SrgbF b = brighter.pixels()[i];
        c = {float(double(b.r - c.r) / nudge), float(double(b.g - c.g) / nudge),
             float(double(b.b - c.b) / nudge)};
    }
    return picture;
}

struct AffineMoments {
    Eigen::Matrix4d xx = Eigen::Matrix4d::Zero();
    MatrixXd xd;
    double count = 0;
};

AffineMoments affine_moments(const Image<SrgbF>& color, const Mask& moving,
                             const Increments& increments) {
    const auto q = Eigen::Index(increments.size());
    const auto parts =
        map_rows<AffineMoments>(color.height(), rows_per_chunk(color.width()), [&](RowRun run) {
            AffineMoments m;
            m.xd = MatrixXd::Zero(4, 3 * q);
            // Row by row, so that a product of matrices does the work.
            Eigen::Matrix<double, 4, Eigen::Dynamic> x(4, color.width());
            MatrixXd d(color.width(), 3 * q);
            for (int y = run.begin; y < run.end; ++y) {
                const SrgbF* colors = color.row(y);
                const std::uint8_t* inside = moving.row(y);
                for (Eigen::Index i = 0; i < color.width(); ++i) {
                    const SrgbF c = colors[i];
                    if (inside[i] == 0)
                        x.col(i).setZero();
                    else
                        x.col(i) = Vector4d{1, double(c.r), double(c.g), double(c.b)};
                }
                for (Eigen::Index i = 0; i < 3 * q; ++i) {
                    const Field& field = increments[std::size_t(i / 3)][std::size_t(i % 3)];
                    d.col(i) = Eigen::Map<const Eigen::VectorXf>(
                                   field.data() + std::size_t(y) * std::size_t(color.width()),
                                   color.width())
                                   .cast<double>();
                }
                m.xx += x * x.transpose();
                m.xd.noalias() += x * d;
            }
            m.count = m.xx(0, 0);
            return m;
        });
    AffineMoments all;
    all.xd = MatrixXd::Zero(4, 3 * q);
    for (const AffineMoments& m : parts) all.xx += m.xx, all.xd += m.xd, all.count += m.count;
    return all;
}

/// From the means over what moves, channel by channel.
PartMoments from_grams(const std::array<MatrixXd, 3>& gram) {
    const auto energy = [&](std::size_t k) {
        return float(gram[k].trace() / double(gram[k].rows()));
    };
    return {(gram[0] + gram[1] + gram[2]) / 3, {energy(0), energy(1), energy(2)}};
}

/// Rows that `row(channel, y, out)` writes, as a field.
template <class Row>
ColorField field_of(const Mask& moving, const Row& row) {
    ColorField out;
    for (Field& plane : out) plane.resize(moving.pixel_count());
    parallel_rows(moving.height(), kRowsPerTask, [&](RowRun run) {
        for (int k = 0; k < 3; ++k)
            for (int y = run.begin; y < run.end; ++y)
                row(k, y,
                    out[std::size_t(k)].data() + std::size_t(y) * std::size_t(moving.width()));
    });
    return out;
}

}  // namespace

void ChangePart::subtract(Increments& from) const {
    const int width = moving_.width(), height = moving_.height();
    parallel_for(3 * int(from.size()), [&](int i) {
        Field part(std::size_t(width), 0);
        float* to = from[std::size_t(i / 3)][std::size_t(i % 3)].data();
        for (int y = 0; y < height; ++y, to += width) {
            row(i / 3, i % 3, y, part.data());
            for (int x = 0; x < width; ++x) to[x] -= part[std::size_t(x)];
        }
    });
}

AffinePart::AffinePart(const Context& context, const Mask& moving, const Increments& increments)
    : ChangePart(moving), color_(std::make_shared<const Image<SrgbF>>(mean_color(context.frames))) {
    const AffineMoments all = affine_moments(*color_, moving, increments);
    // Centered, so that the ridge holds back the slopes and not the mean.
    color_moments_ = all.xx / all.count;
    const Eigen::Vector3d mean = all.xx.block<3, 1>(1, 0) / all.count;
    const Eigen::Matrix3d spread = all.xx.block<3, 3>(1, 1) / all.count - mean * mean.transpose();
    const double sigma =
        context.sigma > 0 ? context.sigma : context_noise(context.frames, moving, 1e-3);
    const double ridge = 3 * sigma * sigma / context.length() + 1e-12;
    const MatrixXd mean_change = all.xd.row(0) / all.count;
    const MatrixXd together = all.xd.bottomRows(3) / all.count - mean * mean_change;
    const MatrixXd slopes =
        Eigen::LDLT<Eigen::Matrix3d>(spread + ridge * Eigen::Matrix3d::Identity()).solve(together);
    fit_.resize(4, all.xd.cols());
    fit_.row(0) = mean_change - mean.transpose() * slopes;
    fit_.bottomRows(3) = slopes;
}

AffinePart AffinePart::mean() const {
    MatrixXd fit = MatrixXd::Zero(4, fit_.cols());
    fit.row(0) = color_moments_.row(0) * fit_;
    return {*this, std::move(fit)};
}

AffinePart AffinePart::slopes() const {
    MatrixXd fit = fit_;
    fit.row(0) -= color_moments_.row(0) * fit_;
    return {*this, std::move(fit)};
}

void AffinePart::row_of(const Vector4d& fit, int y, float* out) const {
    const Eigen::Vector4f f = fit.cast<float>();
    const SrgbF* color = color_->row(y);
    const std::uint8_t* inside = moving().row(y);
    for (int x = 0; x < color_->width(); ++x) {
        const SrgbF c = color[x];
        const float value = f[0] + f[1] * c.r + f[2] * c.g + f[3] * c.b;
        out[x] = inside[x] ? value : 0;
    }
}

void AffinePart::row(int increment, int channel, int y, float* out) const {
    row_of(fit_.col(3 * increment + channel), y, out);
}

ColorField AffinePart::combined(const Eigen::RowVectorXd& weights) const {
    std::array<Vector4d, 3> fit;
    for (Eigen::Index k = 0; k < 3; ++k) {
        fit[std::size_t(k)] = Vector4d::Zero();
        for (Eigen::Index i = 0; i < weights.size(); ++i)
            fit[std::size_t(k)] += weights[i] * fit_.col(3 * i + k);
    }
    return field_of(moving(),
                    [&](int k, int y, float* out) { row_of(fit[std::size_t(k)], y, out); });
}

PartMoments AffinePart::moments() const {
    std::array<MatrixXd, 3> gram;
    for (Eigen::Index k = 0; k < 3; ++k) {
        const MatrixXd fit = fit_(Eigen::all, Eigen::seqN(k, increments(), 3));
        gram[std::size_t(k)] = fit.transpose() * color_moments_ * fit;
    }
    return from_grams(gram);
}

LightPart::LightPart(const Context& context, const Mask& moving, const Eigen::MatrixX3d& log_gains)
    : ChangePart(moving), slope_(light_slope(mean_color(context.frames))), gains_(log_gains) {}

LightPart::LightPart(const Context& context, const Mask& moving, const Increments& increments)
    : ChangePart(moving), slope_(light_slope(mean_color(context.frames))) {
    const auto q = Eigen::Index(increments.size());
    const auto parts =
        map_rows<Eigen::VectorXd>(slope_.height(), rows_per_chunk(slope_.width()), [&](RowRun run) {
            Eigen::VectorXd sums = Eigen::VectorXd::Zero(q + 1);
            for (int y = run.begin; y < run.end; ++y) {
                const std::size_t row = std::size_t(y) * std::size_t(slope_.width());
                for (int x = 0; x < slope_.width(); ++x) {
                    if (moving(x, y) == 0) continue;
                    const SrgbF s = slope_(x, y);
                    const std::size_t at = row + std::size_t(x);
                    const auto dot = [&](float r, float g, float b) {
                        return double(s.r) * double(r) + double(s.g) * double(g) +
                               double(s.b) * double(b);
                    };
                    sums[q] += dot(s.r, s.g, s.b);
                    for (Eigen::Index i = 0; i < q; ++i) {
                        const ColorField& d = increments[std::size_t(i)];
                        sums[i] += dot(d[0][at], d[1][at], d[2][at]);
                    }
                }
            }
            return sums;
        });
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(q + 1);
    for (const Eigen::VectorXd& p : parts) sums += p;
    gains_ = (sums.head(q) / std::max(sums[q], 1e-30)).replicate(1, 3);
}

void LightPart::row_of(double gain, int channel, int y, float* out) const {
    const SrgbF* slope = slope_.row(y);
    const std::uint8_t* inside = moving().row(y);
    const float g = float(gain);
    for (int x = 0; x < slope_.width(); ++x) {
        const SrgbF s = slope[x];
        out[x] = inside[x] ? g * (channel == 0 ? s.r : channel == 1 ? s.g : s.b) : 0;
    }
}

void LightPart::row(int increment, int channel, int y, float* out) const {
    row_of(gains_(increment, channel), channel, y, out);
}

ColorField LightPart::combined(const Eigen::RowVectorXd& weights) const {
    const Eigen::RowVector3d gain = weights * gains_;
    return field_of(moving(), [&](int k, int y, float* out) { row_of(gain[k], k, y, out); });
}

PartMoments LightPart::moments() const {
    std::array<double, 3> squares{};
    double inside = 0;
    for (int y = 0; y < slope_.height(); ++y) {
        std::array<double, 3> of_row{};
        for (int x = 0; x < slope_.width(); ++x) {
            if (moving()(x, y) == 0) continue;
            const SrgbF s = slope_(x, y);
            of_row[0] += double(s.r) * double(s.r);
            of_row[1] += double(s.g) * double(s.g);
            of_row[2] += double(s.b) * double(s.b);
            ++inside;
        }
        for (std::size_t k = 0; k < 3; ++k) squares[k] += of_row[k];
    }
    std::array<MatrixXd, 3> gram;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto gains = gains_.col(Eigen::Index(k));
        gram[k] = squares[k] / std::max(inside, 1.0) * (gains * gains.transpose());
    }
    return from_grams(gram);
}

SmoothPart::SmoothPart(const Increments& increments, const Mask& moving, int sigma)
    : ChangePart(moving), gaussian_(moving, sigma), cells_(increments.size()) {
    parallel_for(3 * int(increments.size()), [&](int i) {
        const auto at = std::size_t(i / 3), k = std::size_t(i % 3);
        gaussian_.cells(increments[at][k], cells_[at][k]);
    });
}

void SmoothPart::row(int increment, int channel, int y, float* out) const {
    gaussian_.row(cells_[std::size_t(increment)][std::size_t(channel)], y, out);
}

ColorField SmoothPart::combined(const Eigen::RowVectorXd& weights) const {
    ColorField cells;
    parallel_for(3, [&](int k) {
        Field& to = cells[std::size_t(k)];
        to.assign(cells_.front()[std::size_t(k)].size(), 0);
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            const float w = float(weights[Eigen::Index(i)]);
            const Field& from = cells_[i][std::size_t(k)];
            for (std::size_t at = 0; at < to.size(); ++at) to[at] += w * from[at];
        }
    });
    return field_of(
        moving(), [&](int k, int y, float* out) { gaussian_.row(cells[std::size_t(k)], y, out); });
}

void RestPart::row(int increment, int channel, int y, float* out) const {
    const float* from = increments_[std::size_t(increment)][std::size_t(channel)].data() +
                        std::size_t(y) * std::size_t(moving().width());
    std::copy(from, from + moving().width(), out);
}

ColorField RestPart::combined(const Eigen::RowVectorXd& weights) const {
    const auto width = std::size_t(moving().width());
    return field_of(moving(), [&](int k, int y, float* out) {
        std::fill(out, out + width, 0.0f);
        for (std::size_t i = 0; i < increments_.size(); ++i) {
            const float w = float(weights[Eigen::Index(i)]);
            const float* from = increments_[i][std::size_t(k)].data() + std::size_t(y) * width;
            for (std::size_t x = 0; x < width; ++x) out[x] += w * from[x];
        }
    });
}

PartMoments ChangePart::moments() const {
    const int width = moving_.width(), height = moving_.height();
    const auto q = Eigen::Index(increments());
    const std::int64_t pixels = std::int64_t(width) * height;
    const int step = int(1 + (pixels - 1) / kMostMoments);
    struct Sums {
        std::array<MatrixXd, 3> gram;
        double inside = 0;
    };
    const auto sums =
        map_rows<Sums>((height + step - 1) / step, rows_per_chunk(width), [&](RowRun run) {
            Sums s;
            s.gram.fill(MatrixXd::Zero(q, q));
            // One row of all increments at a time: products of matrices do the work, and sums of
            // more than kRun values are in double.
            Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic> values(width, q), part(q, q);
            for (int y = run.begin; y < run.end; ++y) {
                for (int x = 0; x < width; ++x) s.inside += moving_(x, y * step) != 0;
                for (int k = 0; k < 3; ++k) {
                    for (Eigen::Index i = 0; i < q; ++i)
                        row(int(i), k, y * step, values.col(i).data());
                    for (Eigen::Index x = 0; x < width; x += kRun) {
                        const auto here =
                            values.middleRows(x, std::min<Eigen::Index>(kRun, width - x));
                        part.setZero();
                        part.selfadjointView<Eigen::Lower>().rankUpdate(here.transpose());
                        s.gram[std::size_t(k)] += part.cast<double>();
                    }
                }
            }
            return s;
        });
    std::array<MatrixXd, 3> gram;
    gram.fill(MatrixXd::Zero(q, q));
    double inside = 0;
    for (const Sums& s : sums) {
        inside += s.inside;
        for (std::size_t k = 0; k < 3; ++k) gram[k] += s.gram[k];
    }
    for (MatrixXd& g : gram) {
        g.triangularView<Eigen::StrictlyUpper>() = g.transpose();
        g /= std::max(inside, 1.0);
    }
    return from_grams(gram);
}

}  // namespace verdigris
