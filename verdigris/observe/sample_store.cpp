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

#include "verdigris/error.h"
#include "verdigris/files/npy.h"

namespace verdigris {
namespace {

class NpyStore final : public SampleStore {
  public:
    NpyStore(const std::filesystem::path& path, const SampleLayout* layout)
        : path_(path), file_(path) {
        const auto& shape = file_.shape();
        bool fits = file_.type() == NpyType::u16 && shape.size() == 4 && shape[3] == 3;
        std::string expected = "(samples, height, width, 3)";
        if (layout && !layout->is_rgb()) {
            fits = file_.type() == NpyType::u16 && shape.size() == 2 && shape[1] == layout->codes();
            expected = "(samples, " + std::to_string(layout->codes()) + ")";
        }
        for (const std::size_t n : shape) fits = fits && n > 0 && n <= 1u << 30;
        if (!fits) {
            throw Error(
                ErrorCode::bad_input,
                "does not hold samples: 16-bit numbers of shape " + expected + " are expected",
                path.string());
        }
        layout_ = layout && !layout->is_rgb() ? *layout : rgb_layout(int(shape[2]), int(shape[1]));
    }
    int count() const override { return int(file_.shape()[0]); }
    int height() const override { return layout_.height(); }
    int width() const override { return layout_.width(); }
    Image<SrgbF> image(int index) const override {
        const auto values = file_.values<std::uint16_t>();
        return rows_of_sample(layout_, values.data() + std::size_t(index) * layout_.codes(), 0,
                              height());
    }
    const std::filesystem::path& path() const { return path_; }
    const SampleLayout& layout() const { return layout_; }

  private:
    std::filesystem::path path_;
    NpyFile file_;
    SampleLayout layout_;
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
    TemporaryStore(std::shared_ptr<const TemporaryFile> file, int count, const SampleLayout& layout)
        : file_(std::move(file)), count_(count), layout_(layout) {}
    int count() const override { return count_; }
    int width() const override { return layout_.width(); }
    int height() const override { return layout_.height(); }
    Image<SrgbF> image(int index) const override {
        SampleCodes codes(layout_.codes());
        const std::size_t bytes = codes.size() * sizeof(codes[0]);
        file_->read(codes.data(), bytes, std::size_t(index) * bytes);
        return rows_of_sample(layout_, codes.data(), 0, height());
    }

  private:
    std::shared_ptr<const TemporaryFile> file_;
    int count_;
    SampleLayout layout_;
};

// One sample is written while the next one is made.
class BackgroundSink : public SampleSink {
  public:
    void append(const SampleCodes& codes) final {
        wait();
        pending_ = std::async(std::launch::async,
                              [this, held = std::as_bytes(std::span(codes))] { write(held); });
    }
    void wait() final {
        if (pending_.valid()) pending_.get();
    }
    ~BackgroundSink() override = default;

  protected:
    virtual void write(std::span<const std::byte> codes) = 0;
    /// Derived destructors call this before their members go.
    void settle() noexcept {
        if (pending_.valid()) pending_.wait();
    }

  private:
    std::future<void> pending_;
};

std::vector<std::size_t> npy_shape(const SampleLayout& layout) {
    if (!layout.is_rgb()) return {layout.codes()};
    return {std::size_t(layout.height()), std::size_t(layout.width()), std::size_t(3)};
}

class NpySink final : public BackgroundSink {
  public:
    NpySink(const std::filesystem::path& path, const SampleLayout& layout)
        : path_(path), layout_(layout), writer_(path, NpyType::u16, npy_shape(layout)) {}
    ~NpySink() override { settle(); }
    std::shared_ptr<const SampleStore> finish() override {
        wait();
        writer_.commit();
        return std::make_shared<NpyStore>(path_, &layout_);
    }

  private:
    void write(std::span<const std::byte> codes) override { writer_.append(codes); }
    std::filesystem::path path_;
    SampleLayout layout_;
    NpyWriter writer_;
};

class TemporarySink final : public BackgroundSink {
  public:
    explicit TemporarySink(const SampleLayout& layout)
        : file_(std::make_shared<TemporaryFile>()), layout_(layout) {}
    ~TemporarySink() override { settle(); }
    std::shared_ptr<const SampleStore> finish() override {
        wait();
        return std::make_shared<TemporaryStore>(file_, count_, layout_);
    }

  private:
    void write(std::span<const std::byte> codes) override {
        file_->write(codes.data(), codes.size(), std::size_t(count_) * codes.size());
        ++count_;
    }
    std::shared_ptr<const TemporaryFile> file_;
    int count_ = 0;
    SampleLayout layout_;
};

const NpyStore* npy_store(const SampleStore& store) {
    return dynamic_cast<const NpyStore*>(&store);
}

}  // namespace

std::unique_ptr<SampleSink> make_sample_sink(const std::filesystem::path& store,
                                             const SampleLayout& layout) {
    if (store.empty()) return std::make_unique<TemporarySink>(layout);
    return std::make_unique<NpySink>(store, layout);
}

std::shared_ptr<const SampleStore> open_samples(const std::filesystem::path& path,
                                                const SampleLayout* layout) {
    return std::make_shared<NpyStore>(path, layout);
}

std::filesystem::path path_of(const SampleStore& store) {
    const NpyStore* npy = npy_store(store);
    return npy ? npy->path() : std::filesystem::path{};
}

const SampleLayout& layout_of(const SampleStore& store) {
    const NpyStore* npy = npy_store(store);
    if (!npy) throw Error(ErrorCode::usage, "the samples are no file");
    return npy->layout();
}

}  // namespace verdigris
