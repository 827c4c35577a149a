// SPDX-License-Identifier: MIT
// Numbers of a GLB, read with distrust (internal).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace tinygltf {
class Model;
}

namespace verdigris {

/// A window on numbers that are known to lie within the file.
class Accessor {
  public:
    enum class Type { none, f32, u8, i8, u16, i16, u32 };
    Accessor() = default;
    Accessor(const std::string& where, const char* name, const unsigned char* first, Type type,
             std::size_t count, std::size_t stride, bool normalized)
        : where_(&where),
          name_(name),
          first_(first),
          type_(type),
          count_(count),
          stride_(stride),
          normalized_(normalized) {}

    bool valid() const { return type_ != Type::none; }
    std::size_t count() const { return count_; }
    std::uint32_t index(std::size_t i) const;
    /// Throws Error{bad_input} if one is not finite or over 1e15: its square must be a number too.
    template <std::size_t N>
    std::array<float, N> read(std::size_t i) const {
        std::array<float, N> out;
        for (std::size_t k = 0; k < N; ++k) {
            out[k] = component(i, k);
            if (!(std::abs(out[k]) <= 1e15f)) refuse_number(i);
        }
        return out;
    }

  private:
    float component(std::size_t i, std::size_t k) const;
    [[noreturn]] void refuse_number(std::size_t i) const;
    const std::string* where_ = nullptr;
    const char* name_ = "";
    const unsigned char* first_ = nullptr;
    Type type_ = Type::none;
    std::size_t count_ = 0, stride_ = 0;
    bool normalized_ = false;
};

/// `components` numbers per element; indices have 1 and are integers. The model and `where` must
/// outlive it. Throws Error{bad_input}.
Accessor open_accessor(const std::string& where, const tinygltf::Model& model, int index,
                       const char* name, int components);

}  // namespace verdigris
