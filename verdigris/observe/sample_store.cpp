// SPDX-License-Identifier: MIT
#include "verdigris/observe/sample_store.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <future>
#include <span>
#include <string>
#include <vector>

#include "verdigris/color/convert.h"
#include "verdigris/error.h"
#include "verdigris/files/npy.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

constexpr int kRowsPerRun = 64;

Image<SrgbU16> packed(const Image<SrgbF>& image) {
    auto out = Image<SrgbU16>::for_overwrite(image.width(), image.height());
    parallel_rows(image.height(), kRowsPerRun, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            const float* from = &image.row(y)->r;
            std::uint16_t* to = &out.row(y)->r;
            for (int i = 0; i < 3 * image.width(); ++i) {  // as u16_from_srgb, but vectorizable
                const float v = from[i] > 0 ? std::min(from[i], 1.0f) : 0.0f;
                to[i] = std::uint16_t(int(v * 65535.0f + 0.5f));
            }
        }
    });
    return out;
}

Image<SrgbF> unpacked(const SrgbU16* from, int width, int height) {
    auto out = Image<SrgbF>::for_overwrite(width, height);
    parallel_rows(height, kRowsPerRun, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            const std::uint16_t* in = &from[std::size_t(y) * std::size_t(width)].r;
            float* to = &out.row(y)->r;
            for (int i = 0; i < 3 * width; ++i) to[i] = float(in[i]) / 65535.0f;
        }
    });
    return out;
}

class NpyStore final : public SampleStore {
  public:
    explicit NpyStore(const std::filesystem::path& path) : path_(path), file_(path) {
        const auto& shape = file_.shape();
        if (file_.type() != NpyType::u16 || shape.size() != 4 || shape[3] != 3 || shape[0] == 0 ||
            shape[1] == 0 || shape[2] == 0 || std::max({shape[0], shape[1], shape[2]}) > 1u << 30) {
            throw Error(ErrorCode::bad_input,
                        "does not hold samples: 16-bit numbers of shape (samples, height, width, "
                        "3) are expected",
                        path.string());
        }
    }
    int count() const override { return int(file_.shape()[0]); }
    int height() const override { return int(file_.shape()[1]); }
    int width() const override { return int(file_.shape()[2]); }
    Image<SrgbF> image(int index) const override {
        const std::size_t size = std::size_t(width()) * std::size_t(height());
        const auto values = file_.values<std::uint16_t>();
        static_assert(sizeof(SrgbU16) == 3 * sizeof(std::uint16_t));
        return unpacked(reinterpret_cast<const SrgbU16*>(values.data()) + std::size_t(index) * size,
                        width(), height());
    }
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
    NpyFile file_;
};

// A file without a name: it is gone when the last reader is.
class TemporaryFile {
  public:
    TemporaryFile() {
        std::string name = (std::filesystem::temp_directory_path() / "verdigris-XXXXXX").string();
        descriptor_ = ::mkostemp(name.data(), O_CLOEXEC);
        if (descriptor_ < 0) fail("cannot make a temporary file");
        ::unlink(name.c_str());
    }
    ~TemporaryFile() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    void write(const void* data, std::size_t size, std::size_t offset) const {
        auto from = static_cast<const char*>(data);
        while (size > 0) {
            const auto done = ::pwrite(descriptor_, from, size, off_t(offset));
            if (done < 0 && errno == EINTR) continue;
            if (done <= 0) fail("cannot write the temporary samples");
            from += done, offset += std::size_t(done), size -= std::size_t(done);
        }
    }
    void read(void* data, std::size_t size, std::size_t offset) const {
        auto to = static_cast<char*>(data);
        while (size > 0) {
            const auto done = ::pread(descriptor_, to, size, off_t(offset));
            if (done < 0 && errno == EINTR) continue;
            if (done <= 0) fail("cannot read the temporary samples");
            to += done, offset += std::size_t(done), size -= std::size_t(done);
        }
    }

  private:
    [[noreturn]] static void fail(const std::string& what) {
        throw Error(ErrorCode::failed, what + ": " + std::strerror(errno),
                    std::filesystem::temp_directory_path().string());
    }
    int descriptor_ = -1;
};

// Reads with pread, not through a mapping: mapped pages would count as this process's memory.
class TemporaryStore final : public SampleStore {
  public:
    TemporaryStore(std::shared_ptr<const TemporaryFile> file, int count, int width, int height)
        : file_(std::move(file)), count_(count), width_(width), height_(height) {}
    int count() const override { return count_; }
    int width() const override { return width_; }
    int height() const override { return height_; }
    Image<SrgbF> image(int index) const override {
        auto codes = Image<SrgbU16>::for_overwrite(width_, height_);
        file_->read(codes.row(0), codes.byte_count(), std::size_t(index) * codes.byte_count());
        return unpacked(codes.row(0), width_, height_);
    }

  private:
    std::shared_ptr<const TemporaryFile> file_;
    int count_, width_, height_;
};

// One image is written while the next one is made.
class BackgroundSink : public SampleSink {
  public:
    void append(Image<SrgbF> image) final {
        wait();
        pending_ = std::async(std::launch::async,
                              [this, held = std::move(image)] { write(packed(held)); });
    }
    ~BackgroundSink() override = default;

  protected:
    virtual void write(const Image<SrgbU16>& codes) = 0;
    /// Derived destructors call this before their members go.
    void settle() noexcept {
        if (pending_.valid()) pending_.wait();
    }
    void wait() {
        if (pending_.valid()) pending_.get();
    }

  private:
    std::future<void> pending_;
};

class NpySink final : public BackgroundSink {
  public:
    NpySink(const std::filesystem::path& path, int width, int height)
        : path_(path),
          writer_(path, NpyType::u16, {std::size_t(height), std::size_t(width), std::size_t(3)}) {}
    ~NpySink() override { settle(); }
    std::shared_ptr<const SampleStore> finish() override {
        wait();
        writer_.commit();
        return std::make_shared<NpyStore>(path_);
    }

  private:
    void write(const Image<SrgbU16>& codes) override {
        writer_.append(std::as_bytes(codes.pixels()));
    }
    std::filesystem::path path_;
    NpyWriter writer_;
};

class TemporarySink final : public BackgroundSink {
  public:
    TemporarySink(int width, int height)
        : file_(std::make_shared<TemporaryFile>()), width_(width), height_(height) {}
    ~TemporarySink() override { settle(); }
    std::shared_ptr<const SampleStore> finish() override {
        wait();
        return std::make_shared<TemporaryStore>(file_, count_, width_, height_);
    }

  private:
    void write(const Image<SrgbU16>& codes) override {
        file_->write(codes.row(0), codes.byte_count(), std::size_t(count_) * codes.byte_count());
        ++count_;
    }
    std::shared_ptr<const TemporaryFile> file_;
    int count_ = 0, width_, height_;
};

}  // namespace

std::unique_ptr<SampleSink> make_sample_sink(const std::filesystem::path& store, int width,
                                             int height) {
    if (store.empty()) return std::make_unique<TemporarySink>(width, height);
    return std::make_unique<NpySink>(store, width, height);
}

std::shared_ptr<const SampleStore> open_samples(const std::filesystem::path& path) {
    return std::make_shared<NpyStore>(path);
}

std::filesystem::path path_of(const SampleStore& store) {
    const auto* npy = dynamic_cast<const NpyStore*>(&store);
    return npy ? npy->path() : std::filesystem::path{};
}

}  // namespace verdigris
