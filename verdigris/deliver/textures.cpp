// SPDX-License-Identifier: MIT
#include "verdigris/deliver/textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <mutex>
#include <utility>

#include "verdigris/deliver/encoded_maps.h"
#include "verdigris/deliver/source_type.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

namespace fs = std::filesystem;

// A file of a pack: where, and how to make its bytes. Made only when its turn comes, so that no
// more maps are in memory than threads at work.
struct PackFile {
    fs::path path;
    std::function<std::vector<std::byte>()> bytes;
};

template <class Master>
void add_map(std::vector<PackFile>& files, const fs::path& pack, const std::string& prefix,
             const char* map, const PngOptions& options, Master master) {
    const std::string name = prefix + "_" + map + ".png";
    files.push_back({pack / name, [=] { return encode_png(eight_bit(master()).view(), options); }});
    files.push_back(
        {pack / "masters16" / name, [=] { return encode_png(master().view(), options); }});
}

// `material` must outlive the result.
std::vector<PackFile> pack_files(const Delivery& delivery, const DeliveredState& state,
                                 const Material& material) {
    const int width = material.albedo.width(), height = material.albedo.height();
    const std::string prefix = texture_prefix(delivery, state, width, height);
    const fs::path pack = delivery.stem + "_" + state.label;
    // The observed color is a photograph; every other map is computed from it.
    const SourceType computed = forecast_source(*delivery.forecast);
    const PngOptions color = png_options(state.observed() ? SourceType::capture : computed);
    const PngOptions data = png_options(state.observed() ? SourceType::algorithm : computed);
    const Material* m = &material;

    std::vector<PackFile> files;
    add_map(files, pack, prefix, "Color", color, [m] { return color_master(*m); });
    add_map(files, pack, prefix, "NormalGL", data, [m] { return normal_master(*m); });
    add_map(files, pack, prefix, "Roughness", data, [m] { return gray_master(m->roughness); });
    add_map(files, pack, prefix, "Metalness", data, [m] { return gray_master(m->metallic); });
    add_map(files, pack, prefix, "ORM", data, [m] { return orm_master(*m); });
    // Height bands at 8 bits, so it has no 8-bit version.
    const auto height_bytes = [m, data] { return encode_png(gray_master(m->height).view(), data); };
    files.push_back({pack / (prefix + "_Displacement.png"), height_bytes});
    files.push_back({pack / "masters16" / (prefix + "_Displacement.png"), height_bytes});
    // In a folder of its own: Node Wrangler reads both names as "normal".
    files.push_back({pack / "dx" / (prefix + "_NormalDX.png"), [m, data] {
                         return encode_png(flip_green(eight_bit(normal_master(*m))).view(), data);
                     }});
    files.push_back({pack / "dx" / "masters16" / (prefix + "_NormalDX.png"),
                     [m, data] { return encode_png(flip_green(normal_master(*m)).view(), data); }});
    files.push_back(
        {pack / "README.txt", [text = texture_readme(delivery, state, prefix, width, height)] {
             const auto* first = reinterpret_cast<const std::byte*>(text.data());
             return std::vector<std::byte>(first, first + text.size());
         }});
    return files;
}

}  // namespace

std::string texture_prefix(const Delivery& delivery, const DeliveredState& state, int width,
                           int height) {
    const std::string prefix = delivery.stem + "_" + state.label;
    const int side = std::max(width, height);
    for (int k = 1; k <= 16; k *= 2) {
        if (side == 1024 * k) return fmt::format("{}_{}K", prefix, k);
    }
    return prefix;
}

std::vector<fs::path> write_textures(const Delivery& delivery, const fs::path& folder,
                                     const Progress& progress) {
    const std::vector<DeliveredState> states = delivered_states(delivery);
    std::vector<fs::path> written;
    std::mutex reporting;
    std::int64_t done = 0, total = 0;
    Material material;
    for (const DeliveredState& state : states) {
        materialize(*delivery.recipe, *delivery.forecast, state.horizon, material);
        const std::vector<PackFile> files = pack_files(delivery, state, material);
        total = std::int64_t(files.size() * states.size());
        report(progress, "deliver", done, total);
        parallel_for(int(files.size()), [&](int i) {
            const PackFile& file = files[std::size_t(i)];
            write_file(folder / file.path, file.bytes());
            const std::scoped_lock lock(reporting);
            report(progress, "deliver", ++done, total);
        });
        for (const PackFile& file : files) written.push_back(file.path);
    }
    return written;
}

}  // namespace verdigris
