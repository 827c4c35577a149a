// SPDX-License-Identifier: MIT
// An image is a rectangle of pixels in memory: indexing and ownership, nothing else.
// Convention: origin top-left, x right, y down, pixel centers at +0.5, rows contiguous.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace verdigris {

/// A rectangle of whole pixels: left-top corner and extent.
struct Rect {
    int x = 0, y = 0, width = 0, height = 0;
    bool operator==(const Rect&) const = default;
};

/// Three numbers that are not a color: a normal, or packed masks. Files never tag them as sRGB.
template <class T>
struct Vec3 {
    T x{}, y{}, z{};
    bool operator==(const Vec3&) const = default;
};
using Vec3F = Vec3<float>;
using Vec3U8 = Vec3<std::uint8_t>;
using Vec3U16 = Vec3<std::uint16_t>;

/// A strided window on pixels owned by somebody else. Copying it copies no pixel.
template <class P>
class ImageView {
  public:
    ImageView() = default;
    /// `stride` is the distance between rows in pixels.
    ImageView(P* data, int width, int height, std::ptrdiff_t stride)
        : data_(data), width_(width), height_(height), stride_(stride) {}

    int width() const { return width_; }
    int height() const { return height_; }
    std::ptrdiff_t stride() const { return stride_; }
    bool empty() const { return width_ == 0 || height_ == 0; }
    std::size_t pixel_count() const { return std::size_t(width_) * std::size_t(height_); }

    P* row(int y) const {
        assert(y >= 0 && y < height_);
        return data_ + y * stride_;
    }
    P& operator()(int x, int y) const {
        assert(x >= 0 && x < width_);
        return row(y)[x];
    }
    /// A window on the part of this view inside `rect`, which must lie within it.
    ImageView window(Rect rect) const {
        assert(rect.x >= 0 && rect.y >= 0 && rect.x + rect.width <= width_ &&
               rect.y + rect.height <= height_);
        return {data_ + rect.y * stride_ + rect.x, rect.width, rect.height, stride_};
    }
    operator ImageView<const P>() const { return {data_, width_, height_, stride_}; }

  private:
    P* data_ = nullptr;
    int width_ = 0, height_ = 0;
    std::ptrdiff_t stride_ = 0;
};

/// Owns width x height pixels, rows contiguous, first row 64-byte aligned. Moves, never copies by
/// accident: an image can be hundreds of megabytes. Use clone() where a copy is meant.
template <class P>
class Image {
    static_assert(std::is_trivially_copyable_v<P>);

  public:
    Image() = default;
    /// Zero-filled. Throws std::length_error if the extent is negative or overflows.
    Image(int width, int height) : Image(for_overwrite(width, height)) {
        if (data_) std::memset(static_cast<void*>(data_.get()), 0, byte_count());
    }
    /// Contents undefined: for images whose every pixel is written next.
    static Image for_overwrite(int width, int height) {
        if (width < 0 || height < 0 ||
            (width > 0 && std::size_t(height) > std::numeric_limits<std::ptrdiff_t>::max() /
                                                    sizeof(P) / std::size_t(width))) {
            throw std::length_error("image extent out of range");
        }
        Image image;
        image.width_ = width;
        image.height_ = height;
        if (image.pixel_count() > 0) {
            image.data_.reset(static_cast<P*>(::operator new(image.byte_count(), kAlignment)));
        }
        return image;
    }

    Image(Image&& other) noexcept { swap(other); }
    Image& operator=(Image&& other) noexcept {
        Image moved(std::move(other));
        swap(moved);
        return *this;
    }
    Image(const Image&) = delete;
    Image& operator=(const Image&) = delete;

    Image clone() const {
        Image copy = for_overwrite(width_, height_);
        if (data_) std::memcpy(static_cast<void*>(copy.data_.get()), data_.get(), byte_count());
        return copy;
    }

    int width() const { return width_; }
    int height() const { return height_; }
    bool empty() const { return pixel_count() == 0; }
    std::size_t pixel_count() const { return std::size_t(width_) * std::size_t(height_); }
    std::size_t byte_count() const { return pixel_count() * sizeof(P); }
    bool same_size(int width, int height) const { return width_ == width && height_ == height; }
    template <class Q>
    bool same_size(const Image<Q>& other) const {
        return same_size(other.width(), other.height());
    }

    P* row(int y) { return data_.get() + std::ptrdiff_t(y) * width_; }
    const P* row(int y) const { return data_.get() + std::ptrdiff_t(y) * width_; }
    P& operator()(int x, int y) {
        assert(x >= 0 && x < width_ && y >= 0 && y < height_);
        return row(y)[x];
    }
    const P& operator()(int x, int y) const {
        assert(x >= 0 && x < width_ && y >= 0 && y < height_);
        return row(y)[x];
    }
    std::span<P> pixels() { return {data_.get(), pixel_count()}; }
    std::span<const P> pixels() const { return {data_.get(), pixel_count()}; }

    ImageView<P> view() { return {data_.get(), width_, height_, width_}; }
    ImageView<const P> view() const { return {data_.get(), width_, height_, width_}; }
    operator ImageView<P>() { return view(); }
    operator ImageView<const P>() const { return view(); }

  private:
    static constexpr std::align_val_t kAlignment{64};
    struct Release {
        void operator()(P* p) const { ::operator delete(p, kAlignment); }
    };
    void swap(Image& other) noexcept {
        std::swap(data_, other.data_);
        std::swap(width_, other.width_);
        std::swap(height_, other.height_);
    }
    std::unique_ptr<P, Release> data_;
    int width_ = 0, height_ = 0;
};

/// 255 inside, 0 outside. Nothing in between.
using Mask = Image<std::uint8_t>;
inline constexpr std::uint8_t kInside = 255;

}  // namespace verdigris
