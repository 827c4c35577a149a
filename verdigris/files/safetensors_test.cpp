// SPDX-License-Identifier: MIT
#include "verdigris/files/safetensors.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "verdigris/files/atomic_file.h"
#include "verdigris/files/safetensors_testing.h"

namespace verdigris {
namespace {

using Shape = std::vector<std::int64_t>;

template <class T>
std::vector<std::byte> bytes_of(const std::vector<T>& values) {
    const auto bytes = std::as_bytes(std::span(values));
    return {bytes.begin(), bytes.end()};
}

std::string written(const SafetensorsFile& file) {
    const ScratchFolder folder;
    write_safetensors(folder / "a.safetensors", file);
    EXPECT_EQ(entry_count(folder.path()), 1);
    return read_text(folder / "a.safetensors");
}

SafetensorsFile read(const std::string& text) {
    const ScratchFolder folder;
    put_text(folder / "a.safetensors", text);
    EXPECT_EQ(read_safetensors_metadata(folder / "a.safetensors"),
              read_safetensors(folder / "a.safetensors").metadata);
    return read_safetensors(folder / "a.safetensors");
}

// The bytes that the tests of the reference implementation expect [Safetensors]: attn.0 fills its
// header, attn0 is padded, and a file may hold nothing or metadata alone.
TEST(Safetensors, WritesAndReadsThePublishedBytes) {
    const std::vector<float> values{0, 1, 2, 3, 4, 5};
    const std::string data("\0\0\0\0\0\0\x80\x3f\0\0\0\x40\0\0\x40\x40\0\0\x80\x40\0\0\xa0\x40",
                           24);

    const SafetensorsFile exact{{}, {float_tensor("attn.0", {1, 2, 3}, values)}};
    const std::string exact_text =
        std::string("\x40\0\0\0\0\0\0\0", 8) +
        R"({"attn.0":{"dtype":"F32","shape":[1,2,3],"data_offsets":[0,24]}})" + data;
    EXPECT_EQ(written(exact), exact_text);
    EXPECT_EQ(read(exact_text).tensors, exact.tensors);

    const SafetensorsFile padded{{}, {float_tensor("attn0", {1, 1, 2, 3}, values)}};
    const std::string padded_text =
        std::string("\x48\0\0\0\0\0\0\0", 8) +
        R"({"attn0":{"dtype":"F32","shape":[1,1,2,3],"data_offsets":[0,24]}}       )" + data;
    EXPECT_EQ(written(padded), padded_text);
    EXPECT_EQ(read(padded_text).tensors, padded.tensors);

    const std::string nothing = std::string("\x08\0\0\0\0\0\0\0", 8) + "{}      ";
    EXPECT_EQ(written({}), nothing);
    EXPECT_TRUE(read(nothing).tensors.empty());

    const SafetensorsFile strings{{{"framework", "pt"}}, {}};
    const std::string strings_text =
        std::string("\x28\0\0\0\0\0\0\0", 8) + R"({"__metadata__":{"framework":"pt"}}     )";
    EXPECT_EQ(written(strings), strings_text);
    EXPECT_EQ(read(strings_text).metadata, strings.metadata);

    const SafetensorsFile small{{}, {{"attn.0", TensorType::f4, {1, 2}, {std::byte(0)}}}};
    const std::string small_text =
        std::string("\x40\0\0\0\0\0\0\0", 8) +
        R"({"attn.0":{"dtype":"F4","shape":[1,2],"data_offsets":[0,1]}}    )" +
        std::string(1, '\0');
    EXPECT_EQ(written(small), small_text);
    EXPECT_EQ(read(small_text).tensors, small.tensors);
}

// Also from the reference's tests: files that must be read.
TEST(Safetensors, ReadsWhatTheReferenceReads) {
    const auto scalar = read(safetensors_text(
        R"({"test":{"dtype":"I32","shape":[],"data_offsets":[0,4]}})", "\1\2\3\4"));
    ASSERT_NE(scalar.find("test"), nullptr);
    EXPECT_EQ(scalar.find("test")->shape, Shape{});
    EXPECT_EQ(scalar.find("test")->type, TensorType::i32);
    EXPECT_EQ(scalar.find("test")->bytes, bytes_of<std::uint32_t>({0x04030201}));
    EXPECT_EQ(scalar.find("other"), nullptr);

    const auto empty =
        read(safetensors_text(R"({"test":{"dtype":"I32","shape":[2,0],"data_offsets":[0, 0]}})"));
    EXPECT_EQ(empty.tensors.at(0).shape, (Shape{2, 0}));
    EXPECT_TRUE(empty.tensors.at(0).bytes.empty());

    EXPECT_TRUE(read(safetensors_text("{}\r \t\n")).tensors.empty());
    EXPECT_TRUE(read(safetensors_text("\t\n{}\r ")).tensors.empty());
}

// Written by hand from the format's text: wide types first, then names, metadata by key, escapes.
TEST(Safetensors, LaysOutByTypeThenName) {
    SafetensorsFile file;
    file.metadata = {{"seed", "7"}, {"config", "{\"width\": 8}\n"}, {"Größe", "\x01/\x7f"}};
    file.tensors = {
        {"b", TensorType::boolean, {1}, {std::byte(1)}},
        {"z", TensorType::f32, {1}, bytes_of<float>({1.5f})},
        {"a", TensorType::f32, {}, bytes_of<float>({-2.f})},
        {"none", TensorType::f32, {0, 3}, {}},
        {"n", TensorType::i64, {1}, bytes_of<std::int64_t>({-1})},
        {"h \"\\", TensorType::f16, {2, 1}, bytes_of<std::uint16_t>({0x3c00, 0x0001})},
    };
    std::string header = R"({"__metadata__":{"Größe":"\u0001/)"
                         "\x7f"
                         R"(","config":"{\"width\": 8}\n","seed":"7"},)"
                         R"("n":{"dtype":"I64","shape":[1],"data_offsets":[0,8]},)"
                         R"("a":{"dtype":"F32","shape":[],"data_offsets":[8,12]},)"
                         R"("none":{"dtype":"F32","shape":[0,3],"data_offsets":[12,12]},)"
                         R"("z":{"dtype":"F32","shape":[1],"data_offsets":[12,16]},)"
                         R"("h \"\\":{"dtype":"F16","shape":[2,1],"data_offsets":[16,20]},)"
                         R"("b":{"dtype":"BOOL","shape":[1],"data_offsets":[20,21]}})";
    header.resize((header.size() + 7) / 8 * 8, ' ');
    const std::string data("\xff\xff\xff\xff\xff\xff\xff\xff\0\0\0\xc0\0\0\xc0\x3f\0\x3c\x01\0\x01",
                           21);
    EXPECT_EQ(written(file), safetensors_text(header, data));

    const SafetensorsFile back = read(safetensors_text(header, data));
    EXPECT_EQ(back.metadata, file.metadata);
    ASSERT_EQ(back.tensors.size(), file.tensors.size());
    for (const Tensor& tensor : file.tensors) EXPECT_EQ(*back.find(tensor.name), tensor);

    // The same bytes from any order, and from what was read.
    std::reverse(file.tensors.begin(), file.tensors.end());
    EXPECT_EQ(written(file), safetensors_text(header, data));
    EXPECT_EQ(written(back), safetensors_text(header, data));
}

// The order of entries in the header is free; that of the data counts.
TEST(Safetensors, ReadsEntriesInAnyOrder) {
    const auto file = read(
        safetensors_text(R"({"b":{"shape":[1],"data_offsets":[2,3],"dtype":"U8"},)"
                         R"("e":{"data_offsets":[2,2],"dtype":"U8","shape":[0]},"__metadata__":{},)"
                         R"( "\u0061":{"dtype":"U8","shape":[2],"data_offsets":[0,2]}})",
                         "\1\2\3"));
    ASSERT_EQ(file.tensors.size(), 3u);
    EXPECT_EQ(file.tensors[0].name, "a");
    EXPECT_EQ(file.tensors[0].bytes, bytes_of<std::uint8_t>({1, 2}));
    EXPECT_EQ(file.tensors[1].name, "e");
    EXPECT_EQ(file.tensors[2].bytes, bytes_of<std::uint8_t>({3}));
    EXPECT_TRUE(file.metadata.empty());
}

// Names and sizes as in the reference implementation.
TEST(Safetensors, RoundTripsEveryType) {
    const std::vector<std::pair<std::string, std::size_t>> expected{
        {"BOOL", 8},        {"F4", 4},      {"F6_E2M3", 6}, {"F6_E3M2", 6}, {"U8", 8},
        {"I8", 8},          {"F8_E5M2", 8}, {"F8_E4M3", 8}, {"F8_E8M0", 8}, {"F8_E4M3FNUZ", 8},
        {"F8_E5M2FNUZ", 8}, {"I16", 16},    {"U16", 16},    {"F16", 16},    {"BF16", 16},
        {"I32", 32},        {"U32", 32},    {"F32", 32},    {"C64", 64},    {"F64", 64},
        {"I64", 64},        {"U64", 64}};
    SafetensorsFile file;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const auto type = TensorType(i);
        EXPECT_EQ(to_string(type), expected[i].first);
        EXPECT_EQ(bit_size(type), expected[i].second);
        std::vector<std::byte> bytes(expected[i].second * 3 * 4 / 8);
        for (std::size_t k = 0; k < bytes.size(); ++k) bytes[k] = std::byte(i * 31 + k * 7);
        file.tensors.push_back({expected[i].first, type, {3, 4}, bytes});
    }
    const SafetensorsFile back = read(written(file));
    ASSERT_EQ(back.tensors.size(), file.tensors.size());
    for (const Tensor& tensor : file.tensors) EXPECT_EQ(*back.find(tensor.name), tensor);
}

// All 65536 values against the definition of binary16.
TEST(SafetensorsFloats, ConvertHalfExactly) {
    std::vector<std::uint16_t> bits(65536);
    for (std::size_t i = 0; i < bits.size(); ++i) bits[i] = std::uint16_t(i);
    const auto values = floats({"h", TensorType::f16, {65536}, bytes_of(bits)});
    int wrong = 0;
    for (std::size_t i = 0; i < bits.size(); ++i) {
        const int exponent = int(i >> 10 & 31), mantissa = int(i & 1023);
        if (exponent == 31 && mantissa != 0) {
            wrong += !std::isnan(values[i]);
            continue;
        }
        float expected = exponent == 0    ? std::ldexp(float(mantissa), -24)
                         : exponent == 31 ? INFINITY
                                          : std::ldexp(float(mantissa + 1024), exponent - 25);
        if (i >> 15) expected = -expected;
        wrong += values[i] != expected || std::signbit(values[i]) != bool(i >> 15);
    }
    EXPECT_EQ(wrong, 0);
}

TEST(SafetensorsFloats, ConvertTheOtherTypes) {
    using Floats = std::vector<float>;
    const Tensor brain{
        "x", TensorType::bf16, {4}, bytes_of<std::uint16_t>({0x3f80, 0xc049, 0x7f80, 0x0001})};
    EXPECT_EQ(floats(brain), (Floats{1, -3.140625f, INFINITY, std::ldexp(1.f, -133)}));
    const Tensor wide{"x", TensorType::f64, {2, 2}, bytes_of<double>({0.1, -1e300, 1e-300, 3})};
    EXPECT_EQ(floats(wide), (Floats{0.1f, -INFINITY, 0, 3}));
    const Floats values{-0.f, 1e-40f, std::numeric_limits<float>::max()};
    EXPECT_EQ(floats(float_tensor("x", {3}, values)), values);
    EXPECT_EQ(floats(float_tensor("x", {}, Floats{2})), Floats{2});
    EXPECT_TRUE(floats(float_tensor("x", {0, 5}, {})).empty());
    const Floats not_a_number = floats(float_tensor("x", {1}, Floats{NAN}));
    EXPECT_TRUE(std::isnan(not_a_number.at(0)));
}

TEST(SafetensorsFloats, RefuseOtherTypesNamingFileAndTensor) {
    const Tensor whole{"steps", TensorType::i64, {1}, std::vector<std::byte>(8)};
    const Error error = error_of([&] { floats(whole, "net.safetensors"); });
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    EXPECT_STREQ(error.what(),
                 "net.safetensors: the tensor \"steps\" holds I64 values where F16, BF16, F32 or "
                 "F64 is expected");
    EXPECT_THROW(floats({"x", TensorType::f32, {2}, std::vector<std::byte>(4)}),
                 std::invalid_argument);
    EXPECT_THROW(float_tensor("x", {2}, std::vector<float>(3)), std::invalid_argument);
}

TEST(Safetensors, WritesNothingThatCannotBeRead) {
    const ScratchFolder folder;
    const auto refused = [&](const SafetensorsFile& file) {
        EXPECT_THROW(write_safetensors(folder / "a", file), std::invalid_argument);
        EXPECT_EQ(entry_count(folder.path()), 0);
    };
    const Tensor good{"x", TensorType::u8, {1}, {std::byte(1)}};
    Tensor other = good;
    refused({{}, {good, good}});
    other.name = "__metadata__";
    refused({{}, {other}});
    other.name = "\xff";
    refused({{}, {other}});
    refused({{{"\xc3", "a"}}, {}});
    for (const Shape& shape :
         {Shape{2}, Shape{0}, Shape{-1}, Shape{-1, -1}, Shape{1L << 62, 4}, Shape(65, 1)}) {
        other = good;
        other.shape = shape;
        refused({{}, {other}});
    }
    refused({{}, {{"x", TensorType::f4, {3}, std::vector<std::byte>(2)}}});
    // Six bytes each in JSON.
    refused({{{"a", std::string(16'700'000, '\1')}}, {}});
    SafetensorsFile many;
    for (int i = 0; i <= 10'000; ++i) many.metadata[std::to_string(i)];
    refused(many);
    many = {{}, std::vector<Tensor>(100'001, {"", TensorType::u8, {0}, {}})};
    for (std::size_t i = 0; i < many.tensors.size(); ++i) {
        many.tensors[i].name = std::to_string(i);
    }
    refused(many);
    // As many as are allowed come back.
    many.tensors.pop_back();
    write_safetensors(folder / "a", many);
    EXPECT_EQ(read_safetensors(folder / "a").tensors.size(), 100'000u);
}

TEST(Safetensors, ReplacesWhatIsNoUtf8InMetadata) {
    const auto back = read(written({{{"from", "a\xff.mp4"}}, {}}));
    EXPECT_EQ(back.metadata.at("from"), "a\xef\xbf\xbd.mp4");
}

TEST(Safetensors, KeepsTheOldFileWhenWritingFails) {
    const ScratchFolder folder;
    write_safetensors(folder / "net" / "a", {{{"version", "1"}}, {}});
    {
        std::filesystem::permissions(folder / "net", std::filesystem::perms(0555));
        const AsNobody nobody;
        const Error error = error_of([&] { write_safetensors(folder / "net" / "a", {}); });
        EXPECT_EQ(error.code(), ErrorCode::failed);
        EXPECT_EQ(error.where(), (folder / "net" / "a").string());
    }
    std::filesystem::permissions(folder / "net", std::filesystem::perms(0755));
    EXPECT_EQ(read_safetensors_metadata(folder / "net" / "a").at("version"), "1");
}

// Metadata come from the header alone: of a file over the limit too, whose data are a hole on disk.
TEST(Safetensors, ReadsMetadataWithoutTheData) {
    const ScratchFolder folder;
    const std::uint64_t data = std::uint64_t(1) << 33;
    put_text(
        folder / "a",
        safetensors_text(R"({"__metadata__":{"seed":"7"},"x":{"dtype":"U8","shape":[8589934592],)"
                         R"("data_offsets":[0,8589934592]}})"));
    std::filesystem::resize_file(folder / "a", std::filesystem::file_size(folder / "a") + data);
    EXPECT_EQ(read_safetensors_metadata(folder / "a").at("seed"), "7");
    const Error error = error_of([&] { read_safetensors(folder / "a"); });
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    EXPECT_NE(error.sentence().find("the limit is 4294967296"), std::string::npos);
}

}  // namespace
}  // namespace verdigris
