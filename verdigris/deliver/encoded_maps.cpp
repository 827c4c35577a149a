// SPDX-License-Identifier: MIT
#include "verdigris/deliver/encoded_maps.h"

#include <algorithm>

#include "verdigris/color/convert.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

// chosen: a row of 256 pixels takes about 1 us, so a run is about 30 us.
constexpr int kRowsPerRun = 32;

template <class To, class From, class Convert>
Image<To> converted(const Image<From>& source, const Convert& convert) {
    Image<To> result = Image<To>::for_overwrite(source.width(), source.height());
    parallel_rows(source.height(), kRowsPerRun, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            const From* from = source.row(y);
            std::transform(from, from + source.width(), result.row(y), convert);
        }
    });
    return result;
}

std::uint16_t encode_direction(float v) {
    const float code = v * 32767.5f + 32768.0f;  // + 32767.5, and + 0.5 to round
    return code > 0 ? std::uint16_t(std::min(code, 65535.0f)) : std::uint16_t(0);
}

}  // namespace

Image<SrgbU16> color_master(const Material& material) {
    return converted<SrgbU16>(material.albedo, [](SrgbF c) { return u16_from_srgb(c); });
}

Image<Vec3U16> normal_master(const Material& material) {
    return converted<Vec3U16>(material.normal, [](Vec3F n) {
        return Vec3U16{encode_direction(n.x), encode_direction(n.y), encode_direction(n.z)};
    });
}

Image<Vec3U16> orm_master(const Material& material) {
    const Image<float>& roughness = material.roughness;
    Image<Vec3U16> result = Image<Vec3U16>::for_overwrite(roughness.width(), roughness.height());
    parallel_rows(roughness.height(), kRowsPerRun, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            const float* rough = roughness.row(y);
            const float* metal = material.metallic.row(y);
            Vec3U16* out = result.row(y);
            for (int x = 0; x < roughness.width(); ++x) {
                out[x] = {65535, u16_from_unit(rough[x]), u16_from_unit(metal[x])};
            }
        }
    });
    return result;
}

Image<std::uint16_t> gray_master(const Image<float>& map) {
    return converted<std::uint16_t>(map, [](float v) { return u16_from_unit(v); });
}

Image<Vec3U16> flip_green(const Image<Vec3U16>& normal) {
    return converted<Vec3U16>(normal, [](Vec3U16 n) {
        return Vec3U16{n.x, std::uint16_t(65535 - n.y), n.z};
    });
}

Image<Vec3U8> flip_green(const Image<Vec3U8>& normal) {
    return converted<Vec3U8>(normal, [](Vec3U8 n) {
        return Vec3U8{n.x, std::uint8_t(255 - n.y), n.z};
    });
}

Image<SrgbU8> eight_bit(const Image<SrgbU16>& master) {
    return converted<SrgbU8>(master, [](SrgbU16 c) {
        return SrgbU8{u8_from_u16(c.r), u8_from_u16(c.g), u8_from_u16(c.b)};
    });
}

Image<Vec3U8> eight_bit(const Image<Vec3U16>& master) {
    return converted<Vec3U8>(master, [](Vec3U16 v) {
        return Vec3U8{u8_from_u16(v.x), u8_from_u16(v.y), u8_from_u16(v.z)};
    });
}

Image<std::uint8_t> eight_bit(const Image<std::uint16_t>& master) {
    return converted<std::uint8_t>(master, [](std::uint16_t v) { return u8_from_u16(v); });
}

}  // namespace verdigris
