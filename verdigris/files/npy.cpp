// SPDX-License-Identifier: MIT
// The layout is that of [NumpyFormat]: magic, version, header length, a Python literal, data.
#include "verdigris/files/npy.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <new>
#include <stdexcept>
#include <utility>

#include "verdigris/error.h"
#include "verdigris/files/input_file.h"
#include "verdigris/files/npy_header.h"

namespace verdigris {
namespace {

std::size_t element_count(const std::vector<std::size_t>& shape) {
    std::size_t count = 1;
    for (std::size_t n : shape) {
        if (__builtin_mul_overflow(count, n, &count)) {
            throw std::length_error("npy: the shape overflows");
        }
    }
    return count;
}

std::vector<std::size_t> with_count(std::size_t count, const std::vector<std::size_t>& frame) {
    std::vector<std::size_t> shape{count};
    shape.insert(shape.end(), frame.begin(), frame.end());
    return shape;
}

struct Mapping {
    void* address = MAP_FAILED;
    std::size_t length = 0;
    Mapping() = default;
    Mapping(const Mapping&) = delete;
    Mapping& operator=(const Mapping&) = delete;
    ~Mapping() {
        if (address != MAP_FAILED) ::munmap(address, length);
    }
};

template <class T>
constexpr NpyType type_of() {
    if constexpr (std::is_same_v<T, std::uint8_t>) return NpyType::u8;
    if constexpr (std::is_same_v<T, std::uint16_t>) return NpyType::u16;
    if constexpr (std::is_same_v<T, float>) return NpyType::f32;
    if constexpr (std::is_same_v<T, double>) return NpyType::f64;
}

}  // namespace

std::size_t byte_size(NpyType type) {
    switch (type) {
        case NpyType::u8:
            return 1;
        case NpyType::u16:
            return 2;
        case NpyType::f32:
            return 4;
        case NpyType::f64:
            return 8;
    }
    return 0;
}

NpyWriter::NpyWriter(std::filesystem::path target, NpyType type,
                     std::vector<std::size_t> frame_shape)
    : file_(std::move(target)), type_(type), frame_shape_(std::move(frame_shape)) {
    frame_bytes_ = element_count(frame_shape_) * byte_size(type_);
    // Padded for the longest count, so that commit() can write the true one in the same place.
    file_.write(npy_header(type_, with_count(0, frame_shape_), kNpyCountDigits));
}

void NpyWriter::append(std::span<const std::byte> frame) {
    if (frame.size() != frame_bytes_) {
        throw std::invalid_argument("NpyWriter::append: not exactly one frame");
    }
    file_.write(frame);
    ++count_;
}

void NpyWriter::commit() {
    const std::string header = npy_header(type_, with_count(count_, frame_shape_), kNpyCountDigits);
    file_.rewrite(0, std::as_bytes(std::span(header.data(), header.size())));
    file_.commit();
}

NpyFile::NpyFile(const std::filesystem::path& path) : path_(path) {
    InputFile file(path);
    const NpyLayout layout = read_npy_layout(file);
    type_ = layout.type;
    shape_ = layout.shape;
    bytes_ = layout.data_bytes;

    auto mapping = std::make_shared<Mapping>();
    mapping->length = std::size_t(file.size());
    mapping->address =
        ::mmap(nullptr, mapping->length, PROT_READ, MAP_PRIVATE, ::fileno(file.handle()), 0);
    if (mapping->address == MAP_FAILED) {
        file.refuse("cannot be mapped into memory: " + reason_from_errno(errno));
    }
    data_ = static_cast<const std::byte*>(mapping->address) + layout.data_offset;
    if (layout.data_offset % byte_size(type_) == 0) {
        mapping_ = std::move(mapping);
        return;
    }
    // Some writers do not pad the header; misaligned elements cannot be handed out as a span.
    const std::size_t words = bytes_ / sizeof(double) + 1;
    std::shared_ptr<double[]> copy(new double[words]);
    std::memcpy(copy.get(), data_, bytes_);
    data_ = reinterpret_cast<const std::byte*>(copy.get());
    mapping_ = std::move(copy);
}

template <class T>
std::span<const T> NpyFile::values() const {
    if (type_ != type_of<T>() || !mapping_) {
        throw Error(ErrorCode::bad_input,
                    "holds " + npy_type_name(type_) + " values where " +
                        npy_type_name(type_of<T>()) + " are expected",
                    path_.string());
    }
    return {reinterpret_cast<const T*>(data_), bytes_ / sizeof(T)};
}
template std::span<const std::uint8_t> NpyFile::values() const;
template std::span<const std::uint16_t> NpyFile::values() const;
template std::span<const float> NpyFile::values() const;
template std::span<const double> NpyFile::values() const;

void write_npy(const std::filesystem::path& path, NpyType type,
               const std::vector<std::size_t>& shape, std::span<const std::byte> values) {
    if (values.size() != element_count(shape) * byte_size(type)) {
        throw std::invalid_argument("write_npy: the values do not fill the shape");
    }
    AtomicFile file(path);
    file.write(npy_header(type, shape, 0));
    file.write(values);
    file.commit();
}

}  // namespace verdigris
