// SPDX-License-Identifier: MIT
// How much memory a safetensors file can make us take, counted at operator new. Not under the
// sanitizers, which bring their own.
#include <gtest/gtest.h>

#include "verdigris/files/atomic_file.h"
#include "verdigris/files/safetensors.h"
#include "verdigris/files/safetensors_testing.h"

#ifndef __SANITIZE_ADDRESS__
#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<bool> counting{false};
std::atomic<std::ptrdiff_t> held{0}, peak{0};

void count(std::ptrdiff_t bytes) {
    if (!counting) return;
    const std::ptrdiff_t now = held += bytes;
    if (now > peak) peak = now;
}

void release(void* block) {
    if (block) count(-std::ptrdiff_t(::malloc_usable_size(block)));
    std::free(block);
}

}  // namespace

void* operator new(std::size_t bytes) {
    void* const block = std::malloc(std::max<std::size_t>(bytes, 1));
    if (!block) throw std::bad_alloc();
    count(std::ptrdiff_t(::malloc_usable_size(block)));
    return block;
}
void operator delete(void* block) noexcept {
    release(block);
}
void operator delete(void* block, std::size_t) noexcept {
    release(block);
}

namespace verdigris {
namespace {

// Bytes in use at most while the file is read or refused.
std::size_t bytes_to_read(const std::string& text) {
    const ScratchFolder folder;
    const auto path = folder / "a.safetensors";
    put_text(path, text);
    held = 0, peak = 0;
    counting = true;
    try {
        read_safetensors(path);
    } catch (const Error&) {
    }
    counting = false;
    return std::size_t(peak.load());
}

std::string repeated(const std::string& start, const std::string& piece, int count,
                     const std::string& end) {
    std::string text = start;
    for (int i = 0; i < count; ++i) text += piece;
    return text + end;
}

// What the header of a file may cost, in its own size; safetensors.h promises 16.
double factor(const std::string& header, const std::string& data = {}) {
    const std::size_t used = bytes_to_read(safetensors_text(header, data));
    EXPECT_GE(used, header.size());  // the counter counts
    return double(used - std::min(used, data.size())) / double(header.size());
}

TEST(SafetensorsMemory, StaysWithinAFewTimesTheHeader) {
    std::string tensors = "{", metadata = "{\"__metadata__\":{";
    for (int i = 0; i < 100'000; ++i) {
        tensors += (i ? ",\"" : "\"") + std::to_string(i) +
                   R"(":{"dtype":"U8","shape":[0],"data_offsets":[0,0]})";
    }
    for (int i = 0; i < 10'000; ++i) {
        metadata += (i ? ",\"" : "\"") + std::to_string(i) + "\":\"\"";
    }
    std::string ranks = "{";
    for (int i = 0; i < 10'000; ++i) {
        ranks += (i ? ",\"" : "\"") + std::to_string(i) +
                 "\":{\"dtype\":\"U8\",\"shape\":" + repeated("[0", ",0", 63, "]") +
                 ",\"data_offsets\":[0,0]}";
    }
    const std::string many(1 << 20, 'n');
    const std::vector<std::pair<std::string, std::string>> cases{
        {"tensors", tensors + "}"},
        {"tensors cut", tensors},
        {"metadata", metadata + "}}"},
        {"ranks", ranks + "}"},
        {"a long name", "{\"" + many + "\":{}}"},
        {"a long key", "{\"__metadata__\":{\"" + many + "\":\"" + many + "\"}}"},
        {"a long type", "{\"w\":{\"dtype\":\"" + many + "\"}}"},
        {"a long number", "{\"w\":{\"shape\":[" + std::string(1 << 20, '9') + "]}}"},
        {"depth", "{\"w\":{\"shape\":" + std::string(1 << 20, '[')},
        {"a long token", "{\"w\":" + many + "}"},
        {"an open string", "{\"" + many},
        {"white space", "{" + std::string(1 << 20, ' ') + "}"},
    };
    for (const auto& [name, header] : cases) {
        const double times = factor(header);
        RecordProperty(name, std::to_string(times));
        EXPECT_LT(times, 16) << name;
    }
}

TEST(SafetensorsMemory, TakesTheDataOnce) {
    const std::string header =
        R"({"w":{"dtype":"U8","shape":[8388608],"data_offsets":[0,8388608]}})";
    const std::string data(1 << 23, 'd');
    EXPECT_LT(bytes_to_read(safetensors_text(header, data)), data.size() + 8192);
    // Promised and not there: nothing is taken for it.
    EXPECT_LT(bytes_to_read(safetensors_text(header)), 8192u);
}

}  // namespace
}  // namespace verdigris
#else
TEST(SafetensorsMemory, StaysWithinAFewTimesTheHeader) {
    GTEST_SKIP() << "the sanitizer counts memory differently";
}
#endif
