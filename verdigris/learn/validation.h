// SPDX-License-Identifier: MIT
// How well a network does on the stretch of its own recording that it does not learn from: the
// protocol's measure, with the protocol's code (internal).
#pragma once

#include <vector>

#include "verdigris/evaluate/evaluate.h"
#include "verdigris/evaluate/foreground.h"
#include "verdigris/learn/learn.h"

namespace verdigris {

struct ValidationErrors {
    double network = 0, persistence = 0;  ///< mean over windows and horizons, foreground MSE
};

class ValidationSet {
  public:
    /// All windows inside source.validation. Throws Error{bad_input} if there is none, or all of
    /// them have too little foreground.
    ValidationSet(const EvaluationProtocol& protocol, const TrainingSource& source,
                  const Progress& progress);

    ValidationErrors errors(const Network& network, int batch, const Progress& progress) const;
    int count() const { return int(starts_.size()); }

  private:
    const Image<SrgbF>& frame(int start, int i) const;

    int context_, horizons_, stride_;
    std::vector<Image<SrgbF>> samples_;
    std::vector<int> starts_;  ///< of those with enough foreground, counted from the first sample
    std::vector<PixelWeights> foreground_;
    PixelWeights all_;
    double persistence_ = 0;
};

}  // namespace verdigris
