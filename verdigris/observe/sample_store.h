// SPDX-License-Identifier: MIT
// Samples on disk as 16-bit encoded sRGB: written behind the back of the computation, read on
// demand. With a path, a .npy of shape (T, H, W, 3); without, an unnamed temporary file.
#pragma once

#include <filesystem>
#include <memory>

#include "verdigris/observe/observe.h"

namespace verdigris {

/// Takes images of one size, in order. The conversion to 16 bit and the writing happen on another
/// thread; at most one image waits.
class SampleSink {
  public:
    virtual ~SampleSink() = default;
    /// Throws what the writing thread ran into: Error{failed}, disk full.
    virtual void append(Image<SrgbF> image) = 0;
    /// After the last append. Throws as append.
    virtual std::shared_ptr<const SampleStore> finish() = 0;
};

std::unique_ptr<SampleSink> make_sample_sink(const std::filesystem::path& store, int width,
                                             int height);

/// A samples.npy. Throws Error{bad_input} naming the file.
std::shared_ptr<const SampleStore> open_samples(const std::filesystem::path& path);
/// The file behind a store, empty if it is a temporary.
std::filesystem::path path_of(const SampleStore& store);

}  // namespace verdigris
