// SPDX-License-Identifier: MIT
#include "verdigris/deliver/gltf.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>

#include "verdigris/deliver/encoded_maps.h"
#include "verdigris/deliver/glb.h"
#include "verdigris/deliver/testing.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

using Json = nlohmann::json;

std::uint32_t u32_at(std::span<const std::byte> bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t k = 4; k-- > 0;) {
        value = value << 8 | std::to_integer<std::uint32_t>(bytes[at + k]);
    }
    return value;
}

// A GLB taken apart by the letter of the specification.
struct Parts {
    Json json;
    std::vector<std::byte> buffer;

    explicit Parts(std::span<const std::byte> glb) {
        EXPECT_EQ(std::memcmp(glb.data(), "glTF", 4), 0);
        EXPECT_EQ(u32_at(glb, 4), 2u);
        EXPECT_EQ(u32_at(glb, 8), glb.size());
        const std::size_t json_length = u32_at(glb, 12);
        EXPECT_EQ(json_length % 4, 0u);
        EXPECT_EQ(std::memcmp(glb.data() + 16, "JSON", 4), 0);
        json =
            Json::parse(std::string(reinterpret_cast<const char*>(glb.data()) + 20, json_length));
        const std::size_t bin = 20 + json_length;
        const std::size_t bin_length = u32_at(glb, bin);
        EXPECT_EQ(bin_length % 4, 0u);
        EXPECT_EQ(std::memcmp(glb.data() + bin + 4, "BIN\0", 4), 0);
        EXPECT_EQ(bin + 8 + bin_length, glb.size());
        buffer.assign(glb.begin() + std::ptrdiff_t(bin + 8), glb.end());
    }

    std::span<const std::byte> view(int index) const {
        const Json& v = json["bufferViews"][std::size_t(index)];
        return std::span(buffer).subspan(v["byteOffset"].get<std::size_t>(),
                                         v["byteLength"].get<std::size_t>());
    }
    // The picture behind a texture, decoded from a file so that the codec is not ours alone.
    Image<SrgbU8> picture(int texture, const ScratchFolder& folder) const {
        const int image = json["textures"][std::size_t(texture)]["source"];
        const Json& entry = json["images"][std::size_t(image)];
        EXPECT_EQ(entry["mimeType"], "image/png");
        EXPECT_FALSE(entry.contains("uri"));
        write_file(folder / "picture.png", view(entry["bufferView"]));
        ImageFile file = read_image(folder / "picture.png");
        return std::move(std::get<Image<SrgbU8>>(file.pixels));
    }
    // Vertex `i` of an accessor, through offset and stride.
    std::vector<float> vertex(const char* attribute, int i) const {
        const int accessor = json["meshes"][0]["primitives"][0]["attributes"][attribute];
        const Json& a = json["accessors"][std::size_t(accessor)];
        EXPECT_EQ(a["componentType"], 5126);
        const std::string type = a["type"];
        std::vector<float> values(std::size_t(type[3] - '0'));
        const int v = a["bufferView"];
        const auto stride = json["bufferViews"][std::size_t(v)]["byteStride"].get<std::size_t>();
        EXPECT_EQ(stride % 4, 0u);
        std::memcpy(values.data(),
                    view(v).data() + a["byteOffset"].get<std::size_t>() + stride * std::size_t(i),
                    values.size() * sizeof(float));
        return values;
    }
};

template <class Code>
void expect_codes(const Image<SrgbU8>& picture, const Image<Code>& expected) {
    ASSERT_TRUE(picture.same_size(expected));
    EXPECT_EQ(std::memcmp(picture.row(0), expected.row(0), expected.byte_count()), 0);
}

TEST(Gltf, ContainerAndViewsAreAligned) {
    const MadeDelivery made;
    const Parts parts(encode_gltf(made.delivery));
    std::size_t end = 0;
    for (const Json& view : parts.json["bufferViews"]) {
        const auto offset = view["byteOffset"].get<std::size_t>();
        EXPECT_EQ(offset % 4, 0u);
        EXPECT_GE(offset, end);
        end = offset + view["byteLength"].get<std::size_t>();
    }
    EXPECT_LE(end, parts.json["buffers"][0]["byteLength"].get<std::size_t>());
    EXPECT_LE(parts.json["buffers"][0]["byteLength"].get<std::size_t>(), parts.buffer.size());
    EXPECT_LT(parts.buffer.size() - parts.json["buffers"][0]["byteLength"].get<std::size_t>(), 4u);
}

TEST(Gltf, TheQuadHasThePicturesAspectAndFacesTheViewer) {
    const MadeDelivery made(40, 24);
    const Parts parts(encode_gltf(made.delivery));
    const float x = 0.05f, y = 0.03f;
    const std::array<std::array<float, 2>, 4> corners{{{-x, -y}, {x, -y}, {x, y}, {-x, y}}};
    for (int i = 0; i < 4; ++i) {
        const std::vector<float> position = parts.vertex("POSITION", i);
        const std::vector<float> uv = parts.vertex("TEXCOORD_0", i);
        EXPECT_FLOAT_EQ(position[0], corners[std::size_t(i)][0]);
        EXPECT_FLOAT_EQ(position[1], corners[std::size_t(i)][1]);
        EXPECT_EQ(position[2], 0);
        EXPECT_NEAR(uv[0], position[0] / (2 * x) + 0.5f, 1e-6);  // left of the image is left
        EXPECT_NEAR(uv[1], 0.5f - position[1] / (2 * y), 1e-6);  // top row is v = 0
        EXPECT_EQ(parts.vertex("NORMAL", i), (std::vector<float>{0, 0, 1}));
        EXPECT_EQ(parts.vertex("TANGENT", i), (std::vector<float>{1, 0, 0, 1}));
    }
    const Json& primitive = parts.json["meshes"][0]["primitives"][0];
    const Json& position =
        parts.json["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
    // Exactly the stored floats, or loaders that trust them cull wrongly.
    EXPECT_EQ(position["min"].get<std::vector<float>>(), parts.vertex("POSITION", 0));
    EXPECT_EQ(position["max"].get<std::vector<float>>(), parts.vertex("POSITION", 2));
    // Counter-clockwise seen from +Z.
    const Json& indices = parts.json["accessors"][primitive["indices"].get<std::size_t>()];
    std::array<std::uint16_t, 6> order{};
    std::memcpy(order.data(), parts.view(indices["bufferView"]).data(), sizeof order);
    for (std::size_t t = 0; t < 6; t += 3) {
        const auto &a = corners[order[t]], &b = corners[order[t + 1]], &c = corners[order[t + 2]];
        EXPECT_GT((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]), 0);
    }
}

TEST(Gltf, OneVariantPerStateAndTheObservedIsTheDefault) {
    const MadeDelivery made;
    const Parts parts(encode_gltf(made.delivery));
    EXPECT_EQ(parts.json["extensionsUsed"], Json::array({"KHR_materials_variants"}));
    EXPECT_FALSE(parts.json.contains("extensionsRequired"));
    const Json& variants = parts.json["extensions"]["KHR_materials_variants"]["variants"];
    ASSERT_EQ(variants.size(), 3u);
    EXPECT_EQ(variants[0]["name"], "observed (last frame)");
    EXPECT_EQ(variants[1]["name"], "+5 units (forecast)");
    EXPECT_EQ(variants[2]["name"], "+20 units (forecast)");
    const Json& primitive = parts.json["meshes"][0]["primitives"][0];
    EXPECT_EQ(primitive["material"], 0);
    const Json& mappings = primitive["extensions"]["KHR_materials_variants"]["mappings"];
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(mappings[std::size_t(i)]["material"], i);
        EXPECT_EQ(mappings[std::size_t(i)]["variants"], Json::array({i}));
        EXPECT_EQ(parts.json["materials"][std::size_t(i)]["doubleSided"], true);
    }
    const Json& asset = parts.json["asset"];
    EXPECT_EQ(asset["version"], "2.0");
    EXPECT_NE(asset["extras"]["units"].get<std::string>().find("not calendar time"),
              std::string::npos);
    EXPECT_EQ(asset["extras"].dump().find("ariant"), std::string::npos);
}

TEST(Gltf, ItsPicturesAreTheMapsExactly) {
    const ScratchFolder folder;
    const MadeDelivery made;
    const Parts parts(encode_gltf(made.delivery));
    const double horizons[] = {0, 5, 20};
    for (std::size_t i = 0; i < 3; ++i) {
        Material material;
        materialize(made.recipe, made.forecast, horizons[i], material);
        const Json& m = parts.json["materials"][i];
        const Json& pbr = m["pbrMetallicRoughness"];
        expect_codes(parts.picture(pbr["baseColorTexture"]["index"], folder),
                     eight_bit(color_master(material)));
        expect_codes(parts.picture(pbr["metallicRoughnessTexture"]["index"], folder),
                     eight_bit(orm_master(material)));
        expect_codes(parts.picture(m["normalTexture"]["index"], folder),
                     eight_bit(normal_master(material)));
        EXPECT_EQ(m["occlusionTexture"]["index"], pbr["metallicRoughnessTexture"]["index"]);
    }
}

TEST(Gltf, PicturesAreEightBitRgbAndOnlyBaseColorIsTagged) {
    const MadeDelivery made;
    const Parts parts(encode_gltf(made.delivery));
    for (const Json& image : parts.json["images"]) {
        const std::span<const std::byte> bytes = parts.view(image["bufferView"]);
        const auto chunks =
            png_chunks(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
        EXPECT_EQ(chunks.at(0).data.at(8), 8);  // bits
        EXPECT_EQ(chunks.at(0).data.at(9), 2);  // RGB without alpha
        const std::string name = image["name"];
        EXPECT_EQ(has_chunk(chunks, "sRGB"), name.ends_with("_Color")) << name;
    }
}

TEST(Glb, PadsAndRefusesTooMuch) {
    const std::array<std::byte, 3> three{};
    GlbBuffer buffer;
    buffer.append(three);
    EXPECT_EQ(buffer.append(three).offset, 4u);
    const std::vector<std::byte> file = glb_file("{}", buffer.bytes());
    EXPECT_EQ(file.size(), 12u + 8 + 4 + 8 + 8);
    EXPECT_EQ(file[22], std::byte(' '));
}

TEST(Gltf, SameBytesAtAnyThreadCount) {
    const MadeDelivery made(300, 200);
    set_thread_count(1);
    const auto one = encode_gltf(made.delivery);
    set_thread_count(0);
    EXPECT_EQ(encode_gltf(made.delivery), one);
}

// Khronos' own validator, where it is installed (npm ci in tests/gltf).
TEST(Gltf, KhronosValidatorFindsNothing) {
    const std::filesystem::path check = VERDIGRIS_GLTF_CHECK;
    if (!std::filesystem::exists(check / "node_modules" / "gltf-validator")) {
        GTEST_SKIP() << "gltf-validator is not installed: npm ci in tests/gltf";
    }
    const ScratchFolder folder;
    std::string files;
    const auto add = [&](const char* name, const Delivery& delivery) {
        write_gltf(delivery, folder / name);
        files += fmt::format(" '{}'", (folder / name).string());
    };
    MadeDelivery plain, hostile(7, 5), narrow(1, 9), still(16, 16, 0);
    hostile.delivery.title = "</script>\"'\n\t\xFF" + std::string(3000, 'x');
    hostile.delivery.stem = asset_stem(hostile.delivery.title);
    narrow.delivery.horizons = {7.5};
    still.delivery.horizons = {};
    add("plain.glb", plain.delivery);
    add("hostile.glb", hostile.delivery);
    add("narrow.glb", narrow.delivery);
    add("still.glb", still.delivery);
    const std::string command =
        fmt::format("node '{}'{} > '{}' 2>&1", (check / "validate.mjs").string(), files,
                    (folder / "log").string());
    EXPECT_EQ(std::system(command.c_str()), 0) << read_text(folder / "log");

    // The check itself must be able to fail: a quad without its indices' view.
    std::string broken = read_text(folder / "plain.glb");
    const std::size_t at = broken.find("\"VEC4\"");
    ASSERT_NE(at, std::string::npos);
    broken[at + 4] = '3';
    write_file(folder / "broken.glb", broken);
    const std::string refuse =
        fmt::format("node '{}' '{}' > /dev/null 2>&1", (check / "validate.mjs").string(),
                    (folder / "broken.glb").string());
    EXPECT_NE(std::system(refuse.c_str()), 0);
}

}  // namespace
}  // namespace verdigris
