// SPDX-License-Identifier: MIT
#include "verdigris/pixels/parallel_rows.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <memory>

namespace verdigris {

int row_run_count(int height, int rows_per_run) {
    const int rows = std::max(rows_per_run, 1);
    return height <= 0 ? 0 : (height - 1) / rows + 1;
}

void parallel_rows(int height, int rows_per_run, const std::function<void(RowRun)>& body) {
    const int rows = std::max(rows_per_run, 1);
    const int runs = row_run_count(height, rows);
    if (runs == 1) {
        body({0, height, 0});
        return;
    }
    tbb::parallel_for(tbb::blocked_range<int>(0, runs, 1), [&](const tbb::blocked_range<int>& r) {
        for (int i = r.begin(); i != r.end(); ++i) {
            body({i * rows, std::min((i + 1) * rows, height), i});
        }
    });
}

void parallel_for(int count, const std::function<void(int)>& body) {
    tbb::parallel_for(tbb::blocked_range<int>(0, std::max(count, 0), 1),
                      [&](const tbb::blocked_range<int>& r) {
                          for (int i = r.begin(); i != r.end(); ++i) body(i);
                      });
}

void on_one_thread(const std::function<void()>& body) {
    tbb::task_arena(1).execute(body);
}

void set_thread_count(int threads) {
    static std::unique_ptr<tbb::global_control> limit;
    limit.reset();
    if (threads > 0) {
        limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                      std::size_t(threads));
    }
}

}  // namespace verdigris
