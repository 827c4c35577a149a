// SPDX-License-Identifier: MIT
// Based on: [Gltf20] 3.9 (Materials), 3.7 (Meshes); KHR_materials_variants [GltfVariants].
#include "verdigris/deliver/gltf.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "verdigris/deliver/encoded_maps.h"
#include "verdigris/deliver/glb.h"
#include "verdigris/deliver/json_text.h"
#include "verdigris/deliver/source_type.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/files/png.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

using Json = nlohmann::ordered_json;

// Numbers of the glTF schema.
constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;
constexpr int kFloat = 5126, kUnsignedShort = 5123;
constexpr int kLinear = 9729, kLinearMipmapLinear = 9987, kClampToEdge = 33071;

// chosen: a hand-sized sample; the recording does not say how large the specimen is.
constexpr float kLongSideMeters = 0.1f;

struct Vertex {
    float position[3], normal[3], uv[2], tangent[4];
};
static_assert(sizeof(Vertex) == 48);

int add_view(Json& gltf, GlbBuffer& buffer, std::span<const std::byte> bytes) {
    const GlbBuffer::Part part = buffer.append(bytes);
    gltf["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", part.offset}, {"byteLength", part.length}});
    return int(gltf["bufferViews"].size()) - 1;
}

int add_accessor(Json& gltf, Json accessor) {
    gltf["accessors"].push_back(std::move(accessor));
    return int(gltf["accessors"].size()) - 1;
}

// The quad: UV (0, 0) is the top-left texel, the tangent runs along +X (= +U), so the bitangent
// n x t is +Y and a normal map with +Y up needs no flip.
Json quad_primitive(Json& gltf, GlbBuffer& buffer, int width, int height) {
    const float meters = kLongSideMeters / float(std::max(width, height));
    const float x = 0.5f * meters * float(width), y = 0.5f * meters * float(height);
    const std::array<Vertex, 4> vertices{{{{-x, -y, 0}, {0, 0, 1}, {0, 1}, {1, 0, 0, 1}},
                                          {{x, -y, 0}, {0, 0, 1}, {1, 1}, {1, 0, 0, 1}},
                                          {{x, y, 0}, {0, 0, 1}, {1, 0}, {1, 0, 0, 1}},
                                          {{-x, y, 0}, {0, 0, 1}, {0, 0}, {1, 0, 0, 1}}}};
    const std::array<std::uint16_t, 6> indices{0, 1, 2, 0, 2, 3};

    const int view = add_view(gltf, buffer, std::as_bytes(std::span(vertices)));
    gltf["bufferViews"][std::size_t(view)]["byteStride"] = sizeof(Vertex);
    gltf["bufferViews"][std::size_t(view)]["target"] = kArrayBuffer;
    const auto attribute = [&](std::size_t offset, const char* type) {
        return Json{{"bufferView", view},
                    {"byteOffset", offset},
                    {"componentType", kFloat},
                    {"count", vertices.size()},
                    {"type", type}};
    };
    Json position = attribute(offsetof(Vertex, position), "VEC3");
    position["min"] = Json::array({-x, -y, 0.0f});
    position["max"] = Json::array({x, y, 0.0f});
    Json attributes;
    attributes["POSITION"] = add_accessor(gltf, std::move(position));
    attributes["NORMAL"] = add_accessor(gltf, attribute(offsetof(Vertex, normal), "VEC3"));
    attributes["TEXCOORD_0"] = add_accessor(gltf, attribute(offsetof(Vertex, uv), "VEC2"));
    attributes["TANGENT"] = add_accessor(gltf, attribute(offsetof(Vertex, tangent), "VEC4"));

    const int index_view = add_view(gltf, buffer, std::as_bytes(std::span(indices)));
    gltf["bufferViews"][std::size_t(index_view)]["target"] = kElementArrayBuffer;
    const int index_accessor = add_accessor(gltf, {{"bufferView", index_view},
                                                   {"byteOffset", 0},
                                                   {"componentType", kUnsignedShort},
                                                   {"count", indices.size()},
                                                   {"type", "SCALAR"}});
    return {{"attributes", std::move(attributes)}, {"indices", index_accessor}, {"mode", 4}};
}

int add_texture(Json& gltf, GlbBuffer& buffer, std::span<const std::byte> png,
                const std::string& name) {
    const int view = add_view(gltf, buffer, png);
    gltf["images"].push_back({{"name", name}, {"mimeType", "image/png"}, {"bufferView", view}});
    gltf["textures"].push_back(
        {{"name", name}, {"sampler", 0}, {"source", int(gltf["images"].size()) - 1}});
    return int(gltf["textures"].size()) - 1;
}

// Base color must be 8-bit here ([Gltf20] 3.9.2); the 16-bit masters are in the texture packs.
std::array<std::vector<std::byte>, 3> state_images(const Delivery& delivery,
                                                   const DeliveredState& state,
                                                   const Material& material) {
    const SourceType computed = forecast_source(*delivery.forecast);
    std::array<std::vector<std::byte>, 3> images;
    parallel_for(3, [&](int i) {
        std::vector<std::byte>& image = images[std::size_t(i)];
        const PngOptions data = png_options(state.observed() ? SourceType::algorithm : computed);
        if (i == 0) {
            image = encode_png(eight_bit(color_master(material)).view(),
                               state.observed() ? png_options(SourceType::capture) : data);
        } else if (i == 1) {
            image = encode_png(eight_bit(orm_master(material)).view(), data);
        } else {
            image = encode_png(eight_bit(normal_master(material)).view(), data);
        }
    });
    return images;
}

Json asset_description(const Delivery& delivery) {
    // Nothing about the variants themselves: Blender's round trip breaks on variant data in extras
    // (glTF-Blender-IO#2431).
    return {{"version", "2.0"},
            {"generator", "verdigris " + writer_version()},
            {"copyright", "Rights remain with the owner of the recording: " + delivery.title},
            {"extras",
             {{"units", kUnitSentence},
              {"forecaster", delivery.forecast->forecaster},
              {"unitsObserved", delivery.units_observed},
              {"scale", "The quad's size is nominal; the recording states none."}}}};
}

}  // namespace

std::vector<std::byte> encode_gltf(const Delivery& delivery, const Progress& progress) {
    const std::vector<DeliveredState> states = delivered_states(delivery);
    Json gltf;
    gltf["asset"] = asset_description(delivery);
    gltf["extensionsUsed"] = Json::array({"KHR_materials_variants"});
    gltf["scene"] = 0;
    gltf["scenes"] = Json::array({{{"name", delivery.title}, {"nodes", Json::array({0})}}});
    gltf["nodes"] = Json::array({{{"name", delivery.title}, {"mesh", 0}}});
    gltf["samplers"] = Json::array({{{"magFilter", kLinear},
                                     {"minFilter", kLinearMipmapLinear},
                                     {"wrapS", kClampToEdge},
                                     {"wrapT", kClampToEdge}}});
    GlbBuffer buffer;
    Json primitive, variants = Json::array(), mappings = Json::array();
    Material material;
    for (std::size_t i = 0; i < states.size(); ++i) {
        const DeliveredState& state = states[i];
        report(progress, "deliver", std::int64_t(i), std::int64_t(states.size()));
        materialize(*delivery.recipe, *delivery.forecast, state.horizon, material);
        if (i == 0) {
            primitive =
                quad_primitive(gltf, buffer, material.albedo.width(), material.albedo.height());
            primitive["material"] = 0;
        }
        const std::string name = delivery.stem + "_" + state.label;
        const auto images = state_images(delivery, state, material);
        const int color = add_texture(gltf, buffer, images[0], name + "_Color");
        const int orm = add_texture(gltf, buffer, images[1], name + "_ORM");
        const int normal = add_texture(gltf, buffer, images[2], name + "_NormalGL");
        gltf["materials"].push_back({{"name", name},
                                     {"pbrMetallicRoughness",
                                      {{"baseColorTexture", {{"index", color}}},
                                       {"metallicRoughnessTexture", {{"index", orm}}}}},
                                     {"normalTexture", {{"index", normal}}},
                                     {"occlusionTexture", {{"index", orm}}},
                                     {"doubleSided", true}});
        variants.push_back({{"name", state.name}});
        mappings.push_back({{"material", int(i)}, {"variants", Json::array({int(i)})}});
    }
    primitive["extensions"]["KHR_materials_variants"]["mappings"] = std::move(mappings);
    gltf["meshes"] = Json::array(
        {{{"name", delivery.title}, {"primitives", Json::array({std::move(primitive)})}}});
    gltf["extensions"]["KHR_materials_variants"]["variants"] = std::move(variants);
    gltf["buffers"] = Json::array({{{"byteLength", buffer.bytes().size()}}});
    return glb_file(json_text(gltf), buffer.bytes());
}

void write_gltf(const Delivery& delivery, const std::filesystem::path& file,
                const Progress& progress) {
    const std::vector<std::byte> bytes = encode_gltf(delivery, progress);
    report(progress, "deliver", 1, 1);
    write_file(file, bytes);
}

}  // namespace verdigris
