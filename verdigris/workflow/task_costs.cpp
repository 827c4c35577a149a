// SPDX-License-Identifier: MIT
#include "verdigris/workflow/task_costs.h"

namespace verdigris {

void TaskCosts::measured(std::size_t task, double seconds, int threads) {
    const Task& t = graph_.tasks()[task];
    for (Sums* sums : {&kinds_[t.kind], &all_}) {
        sums->measured += seconds * double(threads);
        sums->estimated += t.cost;
    }
}

double TaskCosts::factor(const std::string& kind) const {
    const auto found = kinds_.find(kind);
    const Sums& sums = found == kinds_.end() ? all_ : found->second;
    return sums.estimated > 0 && sums.measured > 0 ? sums.measured / sums.estimated : 1;
}

}  // namespace verdigris
