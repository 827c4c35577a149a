// SPDX-License-Identifier: MIT
// Content hashes (SHA-256 through libcrypto): how a result names the input it came from.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace verdigris {

class Sha256 {
  public:
    Sha256();
    ~Sha256();
    Sha256(Sha256&&) noexcept;
    Sha256& operator=(Sha256&&) noexcept;
    void update(std::span<const std::byte> bytes);
    void update(std::string_view text);
    /// 64 lower-case hexadecimal digits. Call once.
    std::string hex();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Of a file's bytes; streamed. Throws Error{bad_input}.
std::string sha256_of_file(const std::filesystem::path& path);

}  // namespace verdigris
