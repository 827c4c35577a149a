// SPDX-License-Identifier: MIT
#include "verdigris/render/material_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <variant>
#include <vector>

#include "verdigris/color/convert.h"
#include "verdigris/error.h"
#include "verdigris/files/image_file.h"
#include "verdigris/pixels/parallel_rows.h"
#include "verdigris/render/vector.h"

namespace verdigris {
namespace {
namespace fs = std::filesystem;

constexpr int kRowsPerRun = 32;
using Endings = std::span<const std::string_view>;
constexpr std::array<std::string_view, 4> kColor{"_color", "_basecolor", "_albedo", "_diffuse"};
constexpr std::array<std::string_view, 2> kNormalUp{"_normalgl", "_normal"};
constexpr std::array<std::string_view, 1> kNormalDown{"_normaldx"}, kRoughness{"_roughness"};
constexpr std::array<std::string_view, 2> kMetallic{"_metalness", "_metallic"};
constexpr std::array<std::string_view, 1> kOrm{"_orm"};

[[noreturn]] void refuse(const fs::path& where, const std::string& sentence) {
    throw Error(ErrorCode::bad_input, sentence, where.string());
}

std::string lower(std::string text) {
    for (char& c : text) c = char(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

// The one file whose name ends so.
std::optional<fs::path> find(const fs::path& folder, Endings endings) {
    std::error_code error;
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        const std::string stem = lower(entry.path().stem().string());
        const std::string kind = lower(entry.path().extension().string());
        const bool picture = kind == ".png" || kind == ".jpg" || kind == ".jpeg" ||
                             kind == ".tif" || kind == ".tiff" || kind == ".exr";
        if (!picture || !entry.is_regular_file(error)) continue;
        if (std::any_of(endings.begin(), endings.end(),
                        [&](std::string_view e) { return stem.ends_with(e); })) {
            found.push_back(entry.path());
        }
    }
    if (error) refuse(folder, error.message());
    if (found.empty()) return std::nullopt;
    std::sort(found.begin(), found.end());
    if (found.size() > 1) {
        refuse(folder, fmt::format("has both {} and {}; a folder holds one material",
                                   found[0].filename().string(), found[1].filename().string()));
    }
    const fs::path master = folder / "masters16" / found[0].filename();
    return fs::is_regular_file(master, error) ? master : found[0];
}

// Samples in [0, 1] as stored; of an OpenEXR as they are.
struct Samples {
    fs::path path;
    ImageFile file;
    Vec3F at(int x, int y) const {
        return std::visit(
            [&](const auto& image) {
                const auto& c = image(x, y);
                using Channel = std::decay_t<decltype(c.r)>;
                constexpr float kScale = std::is_same_v<Channel, std::uint8_t>    ? 1.0f / 255
                                         : std::is_same_v<Channel, std::uint16_t> ? 1.0f / 65535
                                                                                  : 1.0f;
                return Vec3F{float(c.r) * kScale, float(c.g) * kScale, float(c.b) * kScale};
            },
            file.pixels);
    }
};

Samples read(const fs::path& path, const Image<SrgbF>* like) {
    const ImageInfo info = read_image_info(path);  // before anything large is decoded
    if (std::int64_t(info.width) * info.height > kMaxMaterialPixels) {
        refuse(path, fmt::format("has {} x {} pixels; a map may have 8192 x 8192", info.width,
                                 info.height));
    }
    if (like && !like->same_size(info.width, info.height)) {
        refuse(path, fmt::format("has {} x {} pixels, but the color has {} x {}", info.width,
                                 info.height, like->width(), like->height()));
    }
    return {path, read_image(path)};
}

template <class P, class Convert>
Image<P> filled(const Samples& samples, Convert convert) {
    const int width = samples.file.info.width, height = samples.file.info.height;
    auto out = Image<P>::for_overwrite(width, height);
    parallel_rows(height, kRowsPerRun, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            for (int x = 0; x < width; ++x) out(x, y) = convert(samples.at(x, y));
        }
    });
    return out;
}

float in_unit(float v) {
    return std::clamp(v, 0.0f, 1.0f);
}

template <class P>
Image<P> uniform(const Image<SrgbF>& like, P value) {
    auto out = Image<P>::for_overwrite(like.width(), like.height());
    std::fill(out.pixels().begin(), out.pixels().end(), value);
    return out;
}

}  // namespace

bool is_material_folder(const fs::path& folder) {
    std::error_code error;
    return fs::is_directory(folder, error) && find(folder, kColor).has_value();
}

std::vector<fs::path> maps_of_material_folder(const fs::path& folder) {
    std::vector<fs::path> maps;
    for (const Endings endings : {Endings(kColor), Endings(kNormalUp), Endings(kNormalDown),
                                  Endings(kRoughness), Endings(kMetallic), Endings(kOrm)}) {
        const auto read = find(folder, endings);
        if (!read) continue;
        maps.push_back(folder / read->filename());
        if (*read != maps.back()) maps.push_back(*read);
    }
    return maps;
}

Material read_material_folder(const fs::path& folder) {
    std::error_code error;
    if (!fs::is_directory(folder, error)) refuse(folder, "is not a folder of maps");
    const auto color = find(folder, kColor);
    if (!color) refuse(folder, "holds no map of colors (a picture named ..._Color)");
    const auto roughness = find(folder, kRoughness), metallic = find(folder, kMetallic);
    const auto orm = find(folder, kOrm);
    if (!roughness && !orm) {
        refuse(folder, "holds no roughness (a picture named ..._Roughness or ..._ORM)");
    }
    auto normal = find(folder, kNormalUp);
    const float up = normal ? 1.0f : -1.0f;
    if (!normal) normal = find(folder, kNormalDown);

    Material m;
    const Samples colors = read(*color, nullptr);
    const bool encoded = !colors.file.info.is_float;
    m.albedo = filled<SrgbF>(colors, [encoded](Vec3F c) {
        if (encoded) return SrgbF{c.x, c.y, c.z};
        return srgb_from_linear(LinearF{in_unit(c.x), in_unit(c.y), in_unit(c.z)});
    });
    if (roughness) {
        m.roughness =
            filled<float>(read(*roughness, &m.albedo), [](Vec3F v) { return in_unit(v.x); });
    }
    if (metallic) {
        m.metallic =
            filled<float>(read(*metallic, &m.albedo), [](Vec3F v) { return in_unit(v.x); });
    }
    if (orm && (!roughness || !metallic)) {
        const Samples packed = read(*orm, &m.albedo);
        if (!roughness) {
            m.roughness = filled<float>(packed, [](Vec3F v) { return in_unit(v.y); });
        }
        if (!metallic) m.metallic = filled<float>(packed, [](Vec3F v) { return in_unit(v.z); });
    }
    if (m.metallic.empty()) m.metallic = uniform(m.albedo, 0.0f);
    if (normal) {
        m.normal = filled<Vec3F>(read(*normal, &m.albedo), [up](Vec3F v) {
            const Vec3F n{2 * v.x - 1, up * (2 * v.y - 1), 2 * v.z - 1};
            return dot(n, n) > 1e-6f ? unit(n) : Vec3F{0, 0, 1};
        });
    } else {
        m.normal = uniform(m.albedo, Vec3F{0, 0, 1});
    }
    return m;
}

}  // namespace verdigris
