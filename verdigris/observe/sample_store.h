// SPDX-License-Identifier: MIT
// Samples on disk as 16-bit codes: written behind the back of the computation, read on demand.
// With a path, a .npy; without, an unnamed temporary file.
#pragma once

#include <filesystem>
#include <memory>

#include "verdigris/observe/observe.h"
#include "verdigris/observe/sample_layout.h"

namespace verdigris {

/// Takes samples of one layout, in order. The writing happens on another thread.
class SampleSink {
  public:
    virtual ~SampleSink() = default;
    /// `codes` must stay as they are until the next call. Throws what the writing thread ran
    /// into: Error{failed}, disk full.
    virtual void append(const SampleCodes& codes) = 0;
    /// Until everything is written. Throws as append.
    virtual void wait() = 0;
    /// After the last append. Throws as append.
    virtual std::shared_ptr<const SampleStore> finish() = 0;
};

/// A .npy has shape (T, H, W, 3) where samples are encoded sRGB, else (T, codes of a sample).
std::unique_ptr<SampleSink> make_sample_sink(const std::filesystem::path& store,
                                             const SampleLayout& layout);

/// A samples.npy. `layout`: how it is coded, or null for encoded sRGB of the size it says itself.
/// Throws Error{bad_input} naming the file.
std::shared_ptr<const SampleStore> open_samples(const std::filesystem::path& path,
                                                const SampleLayout* layout);
/// The file behind a store, empty if it is a temporary.
std::filesystem::path path_of(const SampleStore& store);
/// How a store that path_of() knows is coded.
const SampleLayout& layout_of(const SampleStore& store);

}  // namespace verdigris
