// SPDX-License-Identifier: MIT
#include "verdigris/render/model.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <string>

#include "verdigris/files/atomic_file.h"
#include "verdigris/files/testing.h"
#include "verdigris/render/settings.h"
#include "verdigris/render/vector.h"

namespace verdigris {
namespace {

/// A GLB from its parts, as hostile as wanted.
std::string glb(std::string json, std::string data) {
    while (json.size() % 4 != 0) json += ' ';
    while (data.size() % 4 != 0) data += '\0';
    const auto number = [](std::size_t v) {
        std::string text;
        for (int i = 0; i < 4; ++i) text += char(v >> (8 * i) & 0xff);
        return text;
    };
    return "glTF" + number(2) + number(28 + json.size() + data.size()) + number(json.size()) +
           "JSON" + json + number(data.size()) + std::string("BIN\0", 4) + data;
}

template <class T>
void append(std::string& data, std::initializer_list<T> values) {
    for (const T v : values) data.append(reinterpret_cast<const char*>(&v), sizeof v);
}

/// One quad: positions at 0, coordinates at 48, indices (u16) at 80: 92 bytes.
struct Quad {
    std::string data = [] {
        std::string d;
        append<float>(d, {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0});
        append<float>(d, {0, 1, 1, 1, 1, 0, 0, 0});
        append<std::uint16_t>(d, {0, 1, 2, 0, 2, 3});
        return d;
    }();
    std::string node = R"({"mesh":0})";
    std::string attributes = R"("POSITION":0,"TEXCOORD_0":1)";
    std::string primitive = R"(,"indices":2)";
    std::string position_count = "4";
    std::string extra;
    std::string json() const {
        return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[)" + node +
               R"(],"meshes":[{"primitives":[{"attributes":{)" + attributes + "}" + primitive +
               R"(}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":)" +
               position_count +
               R"(,"type":"VEC3"},)"
               R"({"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"},)"
               R"({"bufferView":2,"componentType":5123,"count":6,"type":"SCALAR"}],)"
               R"("bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},)"
               R"({"buffer":0,"byteOffset":48,"byteLength":32},)"
               R"({"buffer":0,"byteOffset":80,"byteLength":12}],)"
               R"("buffers":[{"byteLength":92}])" +
               extra + "}";
    }
    std::string bytes() const { return glb(json(), data); }
};

class Model : public testing::Test {
  protected:
    Shape read(const std::string& bytes) {
        put_bytes(folder_ / "model.glb", std::as_bytes(std::span(bytes)));
        return read_model(folder_ / "model.glb");
    }
    void expect_refused(const std::string& bytes, const std::string& pattern) {
        const Error error = error_of([&] { read(bytes); });
        EXPECT_EQ(error.code(), ErrorCode::bad_input) << pattern;
        EXPECT_NE(std::string(error.what()).find(pattern), std::string::npos) << error.what();
        EXPECT_NE(error.where().find("model.glb"), std::string::npos);
    }
    ScratchFolder folder_;
};

TEST_F(Model, AQuadWithoutNormalsAndTangentsGetsThem) {
    const Shape s = read(Quad().bytes());
    ASSERT_EQ(s.triangles.size(), 2u);
    EXPECT_EQ(s.vertex_count(), 4u);
    for (std::size_t i = 0; i < s.vertex_count(); ++i) {
        EXPECT_EQ(s.normals[i], (Vec3F{0, 0, 1}));
        EXPECT_NEAR(s.tangents[i].direction.x, 1, 1e-6f);
        EXPECT_EQ(s.tangents[i].sign, 1);
    }
    EXPECT_EQ(s.beyond, Beyond::repeat);
}

TEST_F(Model, NodesMoveAndMirrorWhatIsInThem) {
    Quad quad;
    quad.node = R"({"children":[1],"translation":[10,0,0]},{"mesh":0,"scale":[-2,1,1]})";
    const Shape s = read(quad.bytes());
    for (std::size_t i = 0; i < s.vertex_count(); ++i) {
        EXPECT_NEAR(std::abs(s.positions[i].x - 10), 2, 1e-5f);
        EXPECT_NEAR(s.normals[i].z, 1, 1e-6f);
        EXPECT_EQ(s.tangents[i].sign, -1);  // the map is mirrored with the mesh
        EXPECT_NEAR(s.tangents[i].direction.x, -1, 1e-5f);
    }
    quad.node = R"({"mesh":0,"rotation":[0,0.70710678,0,0.70710678]})";  // a quarter around +Y
    EXPECT_NEAR(read(quad.bytes()).normals[0].x, 1, 1e-5f);
}

TEST_F(Model, WithoutCoordinatesOneSentence) {
    Quad quad;
    quad.attributes = R"("POSITION":0)";
    expect_refused(quad.bytes(), "without texture coordinates");
}

TEST_F(Model, DamageIsNamed) {
    const Quad good;
    expect_refused("", "is not a GLB");
    expect_refused("just a letter, nothing else in it", "is not a GLB");
    Quad quad = good;
    quad.position_count = "5";
    expect_refused(quad.bytes(), "lie outside of the file");
    quad.position_count = "4294967297";
    expect_refused(quad.bytes(), "lie outside of the file");
    quad.position_count = "3";
    expect_refused(quad.bytes(), "differ in length");
    quad = good;
    quad.data[80] = 9;  // the first index
    expect_refused(quad.bytes(), "vertex that is not there");
    quad = good;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::memcpy(quad.data.data() + 4, &nan, 4);
    expect_refused(quad.bytes(), "not finite");
    quad = good;
    quad.node = R"({"mesh":0,"scale":[1e38,1,1]})";
    expect_refused(quad.bytes(), "no number");
    quad.node = R"({"children":[0]})";
    expect_refused(quad.bytes(), "circle");
    quad.node = R"({"mesh":7})";
    expect_refused(quad.bytes(), "no such mesh");
    quad = good;
    quad.primitive = R"(,"indices":2,"mode":1)";  // lines
    expect_refused(quad.bytes(), "no triangles");
    quad.primitive = R"(,"indices":2,"extensions":{"KHR_draco_mesh_compression":{}})";
    expect_refused(quad.bytes(), "compressed");
    quad = good;
    quad.extra = R"(,"extras":)" + std::string(100000, '[') + std::string(100000, ']');
    expect_refused(quad.bytes(), "nested too deep");
}

TEST_F(Model, WhatItCannotDoWithoutIsReadOrRefused) {
    Quad quad;
    const auto needs = [&](const std::string& name) {
        quad.extra = R"(,"extensionsRequired":[")" + name + "\"]";
        return quad.bytes();
    };
    expect_refused(needs("KHR_draco_mesh_compression"), "compressed (KHR_draco_mesh_compression)");
    expect_refused(needs("EXT_meshopt_compression"), "compressed (EXT_meshopt_compression)");
    expect_refused(needs("EXT_mesh_gpu_instancing"), "needs 'EXT_mesh_gpu_instancing'");
    // Escape sequences of a terminal do not get through, nor a page of text.
    expect_refused(needs("X\\u001b[31m" + std::string(5000, 'y')), "needs 'X?[31myyy");
    for (const char* fine : {"KHR_mesh_quantization", "KHR_materials_clearcoat",
                             "KHR_texture_basisu", "EXT_texture_webp"}) {
        EXPECT_EQ(read(needs(fine)).triangles.size(), 2u) << fine;
    }
}

TEST_F(Model, NoOtherFileIsRead) {
    Quad quad;
    const auto kept_in = [&](const std::string& uri) {
        std::string json = quad.json();
        json.replace(json.find(R"({"byteLength":92})"), 17,
                     R"({"byteLength":92,"uri":")" + uri + "\"}");
        return glb(json, quad.data);
    };
    put_bytes(folder_ / "beside.bin", std::as_bytes(std::span(quad.data)));
    for (const char* uri : {"beside.bin", "/etc/passwd", "../../etc/hostname", "http://127.0.0.1/"})
        expect_refused(kept_in(uri), fmt::format("in another file ('{}'), which is not read", uri));
    // Escape sequences of a terminal do not get through here either.
    expect_refused(kept_in("x\\u001b[31m" + std::string(500, 'y')), "('x?[31myyy");
    expect_refused(glb("{\"asset\": \"\x1b[31m", {}), "is not a valid GLB");
    const Error error = error_of([&] { read(glb("{\"asset\": \"\x1b[31m", {})); });
    EXPECT_EQ(std::string(error.what()).find('\x1b'), std::string::npos);
}

TEST_F(Model, WithoutAreaOneSentence) {
    Quad quad;
    quad.node = R"({"mesh":0,"scale":[0,0,0]})";
    expect_refused(quad.bytes(), "no triangle with an area");
    quad.node = R"({"mesh":0,"scale":[1,0,0]})";
    expect_refused(quad.bytes(), "no triangle with an area");
    // However small: it is scaled to the same radius before it is looked at.
    quad.node = R"({"mesh":0,"scale":[1e-30,1e-30,1e-30],"translation":[0,0,0]})";
    const Setting small = make_setting(read(quad.bytes()));
    for (const Vec3F& p : small.shape.positions) EXPECT_NEAR(length(p), 1, 1e-5f);
}

TEST_F(Model, WhatLiesElsewhereIsNamedAndNotRead) {
    Quad quad;
    const std::string buffer = R"({"byteLength":92})";
    const auto with = [&](const std::string& other) {
        std::string json = quad.json();
        return glb(json.replace(json.find(buffer), buffer.size(), other), quad.data);
    };
    write_file(folder_ / "numbers.bin", quad.data);
    expect_refused(with(R"({"byteLength":92,"uri":"numbers.bin"})"),
                   "another file ('numbers.bin'), which is not read");
    expect_refused(with(R"({"byteLength":92,"uri":"\u001b[31m"})"), "another file ('?[31m')");
    expect_refused(with(R"({"byteLength":0})"), "is not a valid GLB: its parts do not fit");
}

// Otherwise a file of a megabyte whose nodes show one mesh often takes all memory.
TEST_F(Model, VerticesWithoutTrianglesAreLeftOut) {
    Quad quad;
    quad.attributes = R"("POSITION":0,"TEXCOORD_0":1,"NORMAL":0,"TANGENT":3)";
    quad.node = R"({"children":[1,1]},{"mesh":0})";
    std::string json = quad.json();
    const auto replace = [&](const std::string& old, const std::string& by) {
        ASSERT_NE(json.find(old), std::string::npos) << old;
        json.replace(json.find(old), old.size(), by);
    };
    replace(R"("count":6,"type":"SCALAR"})",
            R"("count":3,"type":"SCALAR"},)"
            R"({"bufferView":3,"componentType":5126,"count":4,"type":"VEC4"})");
    replace(R"("byteOffset":80,"byteLength":12})",
            R"("byteOffset":80,"byteLength":12},{"buffer":0,"byteOffset":92,"byteLength":64})");
    replace(R"("byteLength":92})", R"("byteLength":156})");
    for (int i = 0; i < 4; ++i) append<float>(quad.data, {1, 0, 0, 1});
    quad.data[82] = 3;  // the second index: vertex 1 has no triangle
    const Shape s = read(glb(json, quad.data));
    ASSERT_EQ(s.triangles.size(), 2u);
    ASSERT_EQ(s.vertex_count(), 6u);
    EXPECT_EQ(s.triangles[1], (std::array<std::uint32_t, 3>{3, 5, 4}));
    EXPECT_EQ(s.positions[5], (Vec3F{-1, 1, 0})) << "the fourth";
    EXPECT_EQ(s.coordinates[5].v, 0);
}

TEST_F(Model, PartsWithoutTrianglesAreCountedToo) {
    Quad quad;
    std::string lines, children = "1";
    for (int i = 0; i < 2000; ++i) lines += R"(,{"attributes":{"POSITION":0},"mode":1})";
    for (int i = 0; i < 600; ++i) children += ",1";
    quad.node = R"({"children":[)" + children + R"(]},{"mesh":0})";
    std::string json = quad.json();
    const std::string end = R"("indices":2})";
    json.insert(json.find(end) + end.size(), lines);
    expect_refused(glb(json, quad.data), "more nodes and meshes than can be drawn");
}

TEST_F(Model, StripsAndFansAreTriangles) {
    Quad quad;
    quad.primitive = R"(,"mode":6)";  // a fan of the four corners
    EXPECT_EQ(read(quad.bytes()).triangles.size(), 2u);
    quad.primitive = R"(,"mode":5)";
    EXPECT_EQ(read(quad.bytes()).triangles.size(), 2u);
}

TEST_F(Model, AFileCutAnywhereIsRefused) {
    const std::string whole = Quad().bytes();
    for (std::size_t size = 0; size < whole.size(); ++size) {
        const Error error = error_of([&] { read(whole.substr(0, size)); });
        EXPECT_EQ(error.code(), ErrorCode::bad_input) << size;
    }
}

TEST_F(Model, AByteChangedAnywhereIsReadOrRefused) {
    const std::string whole = Quad().bytes();
    int refused = 0;
    for (std::size_t at = 0; at < whole.size(); ++at) {
        for (const char with : {'\0', '\xff', '9', '"', '-'}) {
            std::string changed = whole;
            changed[at] = with;
            try {
                const Shape s = read(changed);
                for (const auto& t : s.triangles) {
                    for (const std::uint32_t i : t) ASSERT_LT(i, s.vertex_count());
                }
            } catch (const Error& error) {
                EXPECT_EQ(error.code(), ErrorCode::bad_input);
                ++refused;
            }
        }
    }
    EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace verdigris
