// SPDX-License-Identifier: MIT
// A 3x3 symmetric positive definite system, and how well conditioned it is (internal).
#pragma once

#include "verdigris/forecast/slope_moments.h"

namespace verdigris {

class Cholesky3 {
  public:
    explicit Cholesky3(const Matrix3& a);
    /// 1 / (|A|_1 |A^-1|_1); 0 if A is not positive definite.
    double rcond() const { return rcond_; }
    Triple solve(const Triple& b) const;

  private:
    Matrix3 l_{};
    double rcond_ = 0;
};

}  // namespace verdigris
