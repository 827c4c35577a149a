// SPDX-License-Identifier: MIT
// Rows of an image, shared out over the cores, with results that do not depend on how many.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace verdigris {

/// A run of rows [begin, end); `index` counts the runs from the top.
struct RowRun {
    int begin = 0, end = 0, index = 0;
};

/// How [0, height) is cut: runs of `rows_per_run` rows, the last one shorter. The cut depends on
/// nothing else, so partial results kept per run and combined in order give the same bytes on
/// any number of threads.
int row_run_count(int height, int rows_per_run);

/// Calls `body` once per run, in parallel, in no particular order. An exception thrown by `body`
/// reaches the caller. Cost: one task per run; choose runs of at least ~10 us of work.
void parallel_rows(int height, int rows_per_run, const std::function<void(RowRun)>& body);

/// As parallel_rows, and returns what `body` returned, ordered by run: sum it front to back.
template <class Partial>
std::vector<Partial> map_rows(int height, int rows_per_run,
                              const std::function<Partial(RowRun)>& body) {
    std::vector<Partial> partials(std::size_t(row_run_count(height, rows_per_run)));
    parallel_rows(height, rows_per_run,
                  [&](RowRun run) { partials[std::size_t(run.index)] = body(run); });
    return partials;
}

/// Calls `body(i)` for i in [0, count), in parallel: frames, files, maps.
void parallel_for(int count, const std::function<void(int)>& body);

/// Limits every later parallel call in this process to `threads` (0: all the machine has).
void set_thread_count(int threads);

/// Runs `body`, and what it or a library on oneTBB does in parallel, on one thread: for what need
/// not come out the same on several.
void on_one_thread(const std::function<void()>& body);

}  // namespace verdigris
