// SPDX-License-Identifier: MIT
#include "verdigris/render/model_accessor.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include "verdigris/error.h"

namespace verdigris {
namespace {

[[noreturn]] void refuse(const std::string& where, const std::string& sentence) {
    throw Error(ErrorCode::bad_input, sentence, where);
}

template <class T>
T number_at(const unsigned char* at) {
    T value;
    std::memcpy(&value, at, sizeof value);
    return value;
}

}  // namespace

std::uint32_t Accessor::index(std::size_t i) const {
    const unsigned char* at = first_ + i * stride_;
    if (type_ == Type::u8) return *at;
    return type_ == Type::u16 ? number_at<std::uint16_t>(at) : number_at<std::uint32_t>(at);
}

float Accessor::component(std::size_t i, std::size_t k) const {
    const unsigned char* at = first_ + i * stride_;
    const auto scaled = [&](auto value, float most) {
        const float v = float(value);
        return normalized_ ? std::max(v / most, -1.0f) : v;
    };
    switch (type_) {
        case Type::f32:
            return number_at<float>(at + 4 * k);
        case Type::u8:
            return scaled(at[k], 255);
        case Type::i8:
            return scaled(number_at<std::int8_t>(at + k), 127);
        case Type::u16:
            return scaled(number_at<std::uint16_t>(at + 2 * k), 65535);
        case Type::i16:
            return scaled(number_at<std::int16_t>(at + 2 * k), 32767);
        case Type::u32:
            return float(number_at<std::uint32_t>(at + 4 * k));
        case Type::none:
            break;
    }
    return 0;
}

void Accessor::refuse_number(std::size_t i) const {
    refuse(*where_, fmt::format("has a {} (number {}) that is not finite, or immense", name_, i));
}

Accessor open_accessor(const std::string& where, const tinygltf::Model& model, int index,
                       const char* name, int components) {
    const auto outside = [&] {
        refuse(where, fmt::format("is damaged: its {} lie outside of the file", name));
    };
    if (index < 0 || std::size_t(index) >= model.accessors.size()) outside();
    const tinygltf::Accessor& a = model.accessors[std::size_t(index)];
    if (a.sparse.isSparse)
        refuse(where, fmt::format("stores its {} sparsely, which is not read", name));
    if (a.bufferView < 0 || std::size_t(a.bufferView) >= model.bufferViews.size()) outside();
    const tinygltf::BufferView& view = model.bufferViews[std::size_t(a.bufferView)];
    if (view.buffer < 0 || std::size_t(view.buffer) >= model.buffers.size()) outside();
    const auto& data = model.buffers[std::size_t(view.buffer)].data;

    using Type = Accessor::Type;
    Type type = Type::none;
    std::size_t size = 0;
    switch (a.componentType) {
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            type = Type::f32, size = 4;
            break;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            type = Type::u8, size = 1;
            break;
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            type = Type::i8, size = 1;
            break;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            type = Type::u16, size = 2;
            break;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            type = Type::i16, size = 2;
            break;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            type = Type::u32, size = 4;
            break;
        default:
            break;
    }
    const bool index_type = type == Type::u8 || type == Type::u16 || type == Type::u32;
    if (type == Type::none ||
        tinygltf::GetNumComponentsInType(std::uint32_t(a.type)) != components ||
        (components == 1 && !index_type)) {
        refuse(where, fmt::format("has {} of a type that glTF does not allow", name));
    }
    const std::size_t element = size * std::size_t(components);
    const std::size_t stride = view.byteStride != 0 ? view.byteStride : element;
    // All of them below 2^32 in a file that size, so that no product overflows.
    constexpr std::size_t kMost = std::size_t(1) << 32;
    if (a.count >= kMost || stride >= kMost || stride < element || a.byteOffset >= kMost ||
        view.byteOffset >= kMost || view.byteLength > data.size() ||
        view.byteOffset > data.size() - view.byteLength || a.byteOffset > view.byteLength) {
        outside();
    }
    if (a.count > 0 && (view.byteLength - a.byteOffset < element ||
                        (a.count - 1) > (view.byteLength - a.byteOffset - element) / stride)) {
        outside();
    }
    return {where,  name,        data.data() + view.byteOffset + a.byteOffset, type, a.count,
            stride, a.normalized};
}

}  // namespace verdigris
