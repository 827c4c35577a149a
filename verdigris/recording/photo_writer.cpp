// SPDX-License-Identifier: MIT
#include "verdigris/recording/photo_writer.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <utility>
#include <vector>

#include "verdigris/error.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/files/png.h"
#include "verdigris/files/staged_folder.h"
#include "verdigris/pixels/parallel_rows.h"
#include "verdigris/recording/writer_checks.h"

namespace verdigris {
namespace {

namespace fs = std::filesystem;

// chosen: pictures wait until so many can be compressed at once, or fill so much memory.
constexpr std::size_t kWaiting = 16, kWaitingBytes = std::size_t(64) << 20;

// Without a slash at the end; what a link points to, so that it still is a link afterwards.
fs::path plain_name(const fs::path& target) {
    fs::path path = target.has_filename() ? target : target.parent_path();
    const fs::path name = path.filename();
    if (name.empty() || name == "." || name == "..") {
        throw Error(ErrorCode::usage, "is not the name of a folder that can be written new",
                    target.string());
    }
    std::error_code ignored;
    if (fs::is_symlink(path, ignored)) {
        const fs::path followed = fs::weakly_canonical(path, ignored);
        if (!followed.empty() && !fs::is_symlink(followed, ignored)) path = followed;
    }
    return path;
}

// The shortest text that reads as the same number.
std::string text_of(double seconds) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), seconds).ptr;
    return {text.data(), end};
}

class PhotoWriter final : public RecordingWriter {
  public:
    PhotoWriter(fs::path target, const WriterOptions& options)
        : target_(std::move(target)), path_(plain_name(target_)), options_(options) {
        named([&] {
            // Staged in the folder above: what appears there is the finished folder, at once.
            const fs::path above = path_.parent_path();
            staged_ = std::make_unique<StagedFolder>(above.empty() ? fs::path(".") : above);
            fs::create_directory(folder());
        });
    }

    void add(ImageView<const SrgbU8> frame) override { keep(frame, 8, waiting8_); }
    void add(ImageView<const SrgbU16> frame) override { keep(frame, 16, waiting16_); }

    void commit() override {
        if (committed_) throw std::logic_error("RecordingWriter::commit twice");
        check_any_frame(target_, frames_);
        write_waiting();
        named([&] {
            std::string table = "file,time\n";
            for (int i = 0; i < frames_; ++i) {
                table += picture_name(i) + "," + text_of(i / options_.fps) + "\n";
            }
            write_file(folder() / "times.csv", table);
        });
        check_existing(target_, options_.replace, TargetKind::folder);
        named([&] { staged_->commit(); });
        committed_ = true;
    }

  private:
    template <class P>
    void keep(ImageView<const P> frame, int bits, std::vector<Image<P>>& waiting) {
        if (committed_) throw std::logic_error("RecordingWriter::add after commit");
        if (failure_) std::rethrow_exception(failure_);
        check_frame(target_, options_, frames_, {frame.width(), frame.height(), bits});
        auto copy = Image<P>::for_overwrite(frame.width(), frame.height());
        for (int y = 0; y < frame.height(); ++y) {
            std::memcpy(copy.row(y), frame.row(y), std::size_t(frame.width()) * sizeof(P));
        }
        const std::size_t bytes = copy.byte_count();
        waiting.push_back(std::move(copy));
        ++frames_;
        if (waiting.size() >= kWaiting || waiting.size() * bytes >= kWaitingBytes) write_waiting();
    }

    void write_waiting() {
        if (failure_) std::rethrow_exception(failure_);
        try {
            write_all(waiting8_);
            write_all(waiting16_);
        } catch (...) {
            failure_ = std::current_exception();  // some are missing: it must not be committed
            throw;
        }
    }

    template <class P>
    void write_all(std::vector<Image<P>>& waiting) {
        const int count = int(waiting.size()), first = frames_ - count;
        if (count == 0) return;
        named([&] {
            parallel_for(count, [&](int i) {
                write_png(folder() / picture_name(first + i), waiting[std::size_t(i)]);
            });
        });
        waiting.clear();
    }

    // Errors name what the caller asked for, not the folder in the making.
    template <class Body>
    void named(Body body) {
        try {
            body();
        } catch (const Error& error) {
            throw Error(error.code(), error.sentence(), target_.string());
        } catch (const fs::filesystem_error& error) {
            throw Error(ErrorCode::failed, "cannot be written: " + error.code().message(),
                        target_.string());
        }
    }
    fs::path folder() const { return staged_->path() / path_.filename(); }

    fs::path target_, path_;
    WriterOptions options_;
    std::unique_ptr<StagedFolder> staged_;
    std::vector<Image<SrgbU8>> waiting8_;  // one of the two is used
    std::vector<Image<SrgbU16>> waiting16_;
    std::exception_ptr failure_;
    int frames_ = 0;
    bool committed_ = false;
};

}  // namespace

std::string picture_name(int index) {
    const std::string digits = std::to_string(index);
    return std::string(6 - std::min<std::size_t>(6, digits.size()), '0') + digits + ".png";
}

std::unique_ptr<RecordingWriter> write_photographs(const fs::path& target,
                                                   const WriterOptions& options) {
    return std::make_unique<PhotoWriter>(target, options);
}

}  // namespace verdigris
