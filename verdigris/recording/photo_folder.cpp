// SPDX-License-Identifier: MIT
#include "verdigris/recording/photo_folder.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "verdigris/error.h"
#include "verdigris/files/image_file.h"
#include "verdigris/files/sha256.h"
#include "verdigris/pixels/parallel_rows.h"
#include "verdigris/recording/hash_file.h"
#include "verdigris/recording/natural_order.h"
#include "verdigris/recording/photo_reader.h"
#include "verdigris/recording/photo_times.h"

namespace verdigris {
namespace {

class PhotoSource : public Recording::Source {
  public:
    PhotoSource(std::shared_ptr<const PhotoSequence> photos, std::filesystem::path sidecar)
        : photos_(std::move(photos)), sidecar_(std::move(sidecar)) {}
    std::unique_ptr<FrameReader> read() const override {
        return std::make_unique<PhotoReader>(photos_);
    }
    // Names and lengths go in before the contents, so that no two folders give the same bytes.
    std::string sha256(const Progress& progress) const override {
        std::vector<std::filesystem::path> files = photos_->files;
        if (!sidecar_.empty()) files.push_back(sidecar_);
        HashProgress done{progress, 0, 0};
        for (const auto& file : files) done.total += std::int64_t(std::filesystem::file_size(file));
        Sha256 hash;
        for (const auto& file : files) {
            hash.update(file.filename().string() + '\0' +
                        std::to_string(std::filesystem::file_size(file)) + '\0');
            hash_file(hash, file, done);
        }
        return hash.hex();
    }

  private:
    std::shared_ptr<const PhotoSequence> photos_;
    std::filesystem::path sidecar_;
};

std::string lower_extension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension) c = char(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    return extension;
}

bool named_like_picture(const std::filesystem::path& path) {
    static const std::set<std::string> kNames{".png", ".jpg", ".jpeg", ".tif", ".tiff", ".exr"};
    return kNames.contains(lower_extension(path));
}

// Pictures by content; files that are only named like one are kept, as frames that are lost.
std::vector<Photo> find_photos(const std::filesystem::path& folder, Statuses& notes) {
    std::vector<Photo> photos;
    int ignored = 0;
    std::string example;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        std::error_code unreadable;
        if (name.starts_with('.') || !entry.is_regular_file(unreadable)) continue;
        if (looks_like_image(entry.path()) || named_like_picture(entry.path())) {
            photos.push_back({name, {}, {}});
        } else if (name != "times.csv" && lower_extension(entry.path()) != ".txt") {
            if (++ignored == 1 || natural_less(name, example)) example = name;
        }
    }
    if (ignored > 0) {
        notes.push_back({"files_ignored", Severity::info,
                         std::to_string(ignored) + " files that are no pictures are ignored (" +
                             example + (ignored > 1 ? " ...)" : ")")});
    }
    std::sort(photos.begin(), photos.end(),
              [](const Photo& a, const Photo& b) { return natural_less(a.name, b.name); });
    return photos;
}

void read_headers(const std::filesystem::path& folder, std::vector<Photo>& photos,
                  Statuses& notes) {
    parallel_for(int(photos.size()), [&](int i) {
        Photo& photo = photos[std::size_t(i)];
        try {
            photo.info = read_image_info(folder / photo.name);
        } catch (const Error& error) {
            photo.broken = error.sentence();
        }
    });
    // A picture that says it is too large is not damaged: it says what it means to say.
    for (const Photo& photo : photos) {
        if (photo.broken.starts_with("declares")) {
            throw Error(ErrorCode::bad_input, photo.broken, (folder / photo.name).string());
        }
    }
    const auto broken = [](const Photo& p) { return !p.broken.empty(); };
    const auto first = std::find_if(photos.begin(), photos.end(), broken);
    const auto count = std::count_if(photos.begin(), photos.end(), broken);
    if (count > 0 && count == std::ptrdiff_t(photos.size())) {
        throw Error(ErrorCode::bad_input, first->broken, (folder / first->name).string());
    }
    if (count > 0) {
        notes.push_back({"broken_pictures", Severity::caution,
                         std::to_string(count) + (count > 1 ? " pictures" : " picture") +
                             " cannot be read (first " + first->name + ": " + first->broken + ")"});
    }
}

// All of one size, and the widest sample type of all.
FrameFormat common_format(const std::filesystem::path& folder, const std::vector<Photo>& photos) {
    const Photo* first = nullptr;
    FrameFormat format;
    format.chroma_y = 0;
    for (const Photo& photo : photos) {
        if (!photo.broken.empty()) continue;
        const ImageInfo& info = photo.info;
        if (!first) {
            first = &photo;
            format.coded_width = info.width;
            format.coded_height = info.height;
        } else if (info.width != first->info.width || info.height != first->info.height) {
            throw Error(ErrorCode::bad_input,
                        "is " + std::to_string(info.width) + " x " + std::to_string(info.height) +
                            " pixels, but " + first->name + " is " +
                            std::to_string(first->info.width) + " x " +
                            std::to_string(first->info.height) +
                            "; a recording needs pictures of one size",
                        (folder / photo.name).string());
        }
        // Pictures with another profile than sRGB become 16-bit sRGB when read.
        const bool profile =
            info.color.starts_with("ICC") && info.color.find("sRGB") == std::string::npos;
        if (info.is_float) {
            format.type = SampleType::f32;
        } else if ((info.bits > 8 || profile) && format.type == SampleType::u8) {
            format.type = SampleType::u16;
        }
    }
    format.bits = format.type == SampleType::u8 ? 8 : format.type == SampleType::u16 ? 16 : 32;
    return format;
}

// The values that occur, in order of appearance: "png", "png, jpeg".
template <class Get>
std::string all_of(const std::vector<Photo>& photos, Get get) {
    std::vector<std::string> seen;
    std::string text;
    for (const Photo& photo : photos) {
        const std::string value = photo.broken.empty() ? get(photo.info) : std::string();
        if (value.empty() || std::find(seen.begin(), seen.end(), value) != seen.end()) continue;
        seen.push_back(value);
        text += (text.empty() ? "" : ", ") + value;
    }
    return text;
}

}  // namespace

Recording open_photographs(const std::filesystem::path& folder, const RecordingOptions& options) {
    RecordingInfo info;
    info.path = folder;
    info.kind = RecordingKind::photographs;
    std::vector<Photo> photos;
    try {
        photos = find_photos(folder, info.notes);
    } catch (const std::filesystem::filesystem_error& error) {
        throw Error(ErrorCode::bad_input, "cannot be listed (" + error.code().message() + ")",
                    folder.string());
    }
    if (photos.empty()) {
        throw Error(ErrorCode::bad_input, "has no pictures we can read (PNG, JPEG, TIFF, EXR)",
                    folder.string());
    }
    read_headers(folder, photos, info.notes);
    info.format = common_format(folder, photos);
    info.width = info.format.coded_width;
    info.height = info.format.coded_height;
    std::filesystem::path sidecar = folder / "times.csv";
    if (!std::filesystem::is_regular_file(sidecar)) sidecar.clear();
    time_photos(photos, sidecar, info);

    info.container = "folder";
    info.codec = all_of(photos, [](const ImageInfo& i) { return i.format; });
    info.color_description = all_of(photos, [](const ImageInfo& i) { return i.color; });
    info.camera = all_of(photos, [](const ImageInfo& i) { return i.camera; });
    auto sequence = std::make_shared<PhotoSequence>();
    for (const Photo& photo : photos) sequence->files.push_back(folder / photo.name);
    sequence->times = info.times;
    sequence->format = info.format;
    sequence->threads = options.decode_threads;
    return Recording(std::move(info),
                     std::make_shared<PhotoSource>(std::move(sequence), std::move(sidecar)));
}

}  // namespace verdigris
