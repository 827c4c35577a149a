// SPDX-License-Identifier: MIT
// A part of the increments of a context, known by what makes it and not pixel by pixel: what is not
// written need not be read again (internal).
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "verdigris/forecast/increments.h"

namespace verdigris {

/// Means over what moves and channels.
struct PartMoments {
    Eigen::MatrixXd gram;  ///< of the products of increments i and j
    SrgbF energy;          ///< per channel, of the squares of all increments
};

class ChangePart {
  public:
    explicit ChangePart(const Mask& moving) : moving_(moving) {}
    virtual ~ChangePart() = default;
    ChangePart(const ChangePart&) = delete;
    ChangePart& operator=(const ChangePart&) = delete;

    const Mask& moving() const { return moving_; }
    virtual int increments() const = 0;
    /// Row y of one channel of one increment, `width` values, 0 outside of what moves.
    virtual void row(int increment, int channel, int y, float* out) const = 0;
    /// Sum of weight * increment.
    virtual ColorField combined(const Eigen::RowVectorXd& weights) const = 0;
    void subtract(Increments& from) const;
    /// From all rows, or of parts of more than kMostMoments pixels every second row, every third
    /// ...; same bytes at any number of threads.
    virtual PartMoments moments() const;
    static constexpr std::int64_t kMostMoments = 300000;

  private:
    const Mask& moving_;
};

/// Of each increment, its least-squares fit by an affine function of the mean color. The ridge is
/// three times the variance of the noise in that mean.
class AffinePart : public ChangePart {
  public:
    AffinePart(const Context& context, const Mask& moving, const Increments& increments);
    /// Its mean over what moves, the same for every pixel; and the rest, which depends on color and
    /// whose mean is 0.
    AffinePart mean() const;
    AffinePart slopes() const;
    int increments() const override { return int(fit_.cols() / 3); }
    void row(int increment, int channel, int y, float* out) const override;
    ColorField combined(const Eigen::RowVectorXd& weights) const override;
    PartMoments moments() const override;

  private:
    AffinePart(const AffinePart& of, Eigen::MatrixXd fit)
        : ChangePart(of.moving()),
          color_(of.color_),
          color_moments_(of.color_moments_),
          fit_(std::move(fit)) {}
    void row_of(const Eigen::Vector4d& fit, int y, float* out) const;

    std::shared_ptr<const Image<SrgbF>> color_;
    Eigen::Matrix4d color_moments_;  ///< means of the products of 1 and red, green, blue
    Eigen::MatrixXd fit_;            ///< [1 and red, green, blue x channels of increments]
};

/// Of each increment, what a gain of all light does to the mean picture.
class LightPart : public ChangePart {
  public:
    /// Gains that are known: their logs, [increments x channels].
    LightPart(const Context& context, const Mask& moving, const Eigen::MatrixX3d& log_gains);
    /// One gray gain per increment that fits it best, as light, exposure and an iris have it.
    LightPart(const Context& context, const Mask& moving, const Increments& increments);
    int increments() const override { return int(gains_.rows()); }
    void row(int increment, int channel, int y, float* out) const override;
    ColorField combined(const Eigen::RowVectorXd& weights) const override;
    PartMoments moments() const override;

  private:
    void row_of(double gain, int channel, int y, float* out) const;

    Image<SrgbF> slope_;  ///< of the encoded mean color by the log of the light
    Eigen::MatrixX3d gains_;
};

/// Each increment under a Gaussian.
class SmoothPart : public ChangePart {
  public:
    SmoothPart(const Increments& increments, const Mask& moving, int sigma);
    int increments() const override { return int(cells_.size()); }
    void row(int increment, int channel, int y, float* out) const override;
    ColorField combined(const Eigen::RowVectorXd& weights) const override;

  private:
    MaskedGaussian gaussian_;
    Increments cells_;
};

/// All that is left.
class RestPart : public ChangePart {
  public:
    /// `increments` must outlive this.
    RestPart(const Increments& increments, const Mask& moving)
        : ChangePart(moving), increments_(increments) {}
    int increments() const override { return int(increments_.size()); }
    void row(int increment, int channel, int y, float* out) const override;
    ColorField combined(const Eigen::RowVectorXd& weights) const override;

  private:
    const Increments& increments_;
};

}  // namespace verdigris
