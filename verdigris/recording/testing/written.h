// SPDX-License-Identifier: MIT
// For tests that write recordings.
#pragma once

#include <gtest/gtest.h>
#include <sched.h>

#include <stdexcept>

#include "verdigris/pixels/parallel_rows.h"
#include "verdigris/recording/libav.h"

namespace verdigris::testing {

inline bool have_x264() {
    return avcodec_find_encoder_by_name("libx264") != nullptr;
}

/// While it lives, this thread and those it starts run on one core and know of no more (1), or
/// nothing changes (0).
class OnCores {
  public:
    explicit OnCores(int cores) {
        if (::sched_getaffinity(0, sizeof(before_), &before_) != 0) {
            throw std::runtime_error("sched_getaffinity failed");
        }
        if (cores == 0) return;
        cpu_set_t one;
        CPU_ZERO(&one);
        for (int i = 0; i < CPU_SETSIZE; ++i) {
            if (!CPU_ISSET(i, &before_)) continue;
            CPU_SET(i, &one);
            break;
        }
        ::sched_setaffinity(0, sizeof(one), &one);
        set_thread_count(1);
    }
    ~OnCores() {
        ::sched_setaffinity(0, sizeof(before_), &before_);
        set_thread_count(0);
    }
    OnCores(const OnCores&) = delete;
    OnCores& operator=(const OnCores&) = delete;

  private:
    cpu_set_t before_{};
};

}  // namespace verdigris::testing

#define NEEDS_X264()                                             \
    if (!verdigris::testing::have_x264()) {                      \
        GTEST_SKIP() << "this FFmpeg was built without libx264"; \
    }
