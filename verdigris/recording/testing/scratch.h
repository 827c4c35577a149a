// SPDX-License-Identifier: MIT
// A folder that goes away, errors as values, and the shared recordings if they are here.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "verdigris/files/testing.h"

namespace verdigris::testing {

using Scratch = ScratchFolder;
using ::verdigris::error_of;

inline void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream out(path, std::ios::binary);
    out.write(bytes.data(), std::streamsize(bytes.size()));
    if (!out) throw std::runtime_error("cannot write a test file");
}

inline std::string read_bytes(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

inline std::filesystem::path shared_data() {
    return VERDIGRIS_SHARED_DATA;
}

template <class List>
bool has_note(const List& notes, const std::string& id) {
    for (const auto& note : notes) {
        if (note.id == id) return true;
    }
    return false;
}

}  // namespace verdigris::testing

/// For the first line of a test that needs the shared recordings.
#define NEEDS_SHARED_DATA(file)                                                 \
    if (!std::filesystem::exists(verdigris::testing::shared_data() / (file))) { \
        GTEST_SKIP() << "the shared recordings are not here";                   \
    }
