// SPDX-License-Identifier: MIT
#include "verdigris/files/npy.h"

#include <gtest/gtest.h>

#include <cstring>
#include <numeric>
#include <stdexcept>

#include "verdigris/files/testing.h"

namespace verdigris {
namespace {

using Shape = std::vector<std::size_t>;

template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& values) {
    return std::as_bytes(std::span(values));
}

// A .npy file from its parts, as hostile as wanted.
std::string npy(const std::string& dictionary, const std::string& data, int version = 1) {
    std::string text("\x93NUMPY", 6);
    text += char(version);
    text += '\0';
    text += char(dictionary.size() & 0xff);
    text += char(dictionary.size() >> 8);
    if (version > 1) text += std::string(2, '\0');
    return text + dictionary + data;
}
std::string f32_dictionary(const std::string& shape) {
    return "{'descr': '<f4', 'fortran_order': False, 'shape': " + shape + ", }\n";
}

template <class T>
void round_trip(NpyType type, const Shape& shape) {
    const ScratchFolder folder;
    std::vector<T> values(
        std::accumulate(shape.begin(), shape.end(), std::size_t(1), std::multiplies<>()));
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = T(i * 3 + 1);
    write_npy(folder / "a.npy", type, shape, bytes_of(values));
    const NpyFile file(folder / "a.npy");
    EXPECT_EQ(file.type(), type);
    EXPECT_EQ(file.shape(), shape);
    const auto read = file.values<T>();
    EXPECT_TRUE(std::equal(read.begin(), read.end(), values.begin(), values.end()));
}

TEST(Npy, RoundTripsEveryTypeAndRank) {
    round_trip<std::uint8_t>(NpyType::u8, {2, 3, 4});
    round_trip<std::uint16_t>(NpyType::u16, {5});
    round_trip<float>(NpyType::f32, {2, 2, 3, 3});
    round_trip<double>(NpyType::f64, {});
    round_trip<float>(NpyType::f32, {3, 0, 2});
}

// The bytes that numpy.save writes for np.array([[1, 2, 3]], dtype=np.uint16).
TEST(Npy, WritesTheBytesOfNumpy) {
    const ScratchFolder folder;
    const std::vector<std::uint16_t> values{1, 2, 3};
    write_npy(folder / "a.npy", NpyType::u16, {1, 3}, bytes_of(values));
    std::string expected = "{'descr': '<u2', 'fortran_order': False, 'shape': (1, 3), }";
    expected.resize(117, ' ');
    expected = npy(expected + "\n", std::string("\1\0\2\0\3\0", 6));
    EXPECT_EQ(expected.size(), 134u);
    EXPECT_EQ(read_text(folder / "a.npy"), expected);
}

TEST(NpyWriter, CountsFramesAndAlignsTheData) {
    const ScratchFolder folder;
    NpyWriter writer(folder / "a.npy", NpyType::f32, {2, 3});
    for (int i = 0; i < 11; ++i) {
        const std::vector<float> frame(6, float(i));
        writer.append(bytes_of(frame));
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "a.npy"));
    EXPECT_EQ(writer.count(), 11u);
    EXPECT_THROW(writer.append(bytes_of(std::vector<float>(5))), std::invalid_argument);
    writer.commit();
    const NpyFile file(folder / "a.npy");
    EXPECT_EQ(file.shape(), (Shape{11, 2, 3}));
    const auto values = file.values<float>();
    for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(values[i], float(i / 6));
    EXPECT_EQ((std::filesystem::file_size(folder / "a.npy") - 66 * 4) % 64, 0u);
}

TEST(NpyWriter, AnEmptyArrayIsValid) {
    const ScratchFolder folder;
    NpyWriter writer(folder / "a.npy", NpyType::u8, {4});
    writer.commit();
    EXPECT_EQ(NpyFile(folder / "a.npy").shape(), (Shape{0, 4}));
    EXPECT_TRUE(NpyFile(folder / "a.npy").values<std::uint8_t>().empty());
}

TEST(NpyFile, CopiesShareTheMapping) {
    const ScratchFolder folder;
    write_npy(folder / "a.npy", NpyType::f64, {1}, bytes_of(std::vector<double>{2.5}));
    NpyFile copy;
    {
        const NpyFile file(folder / "a.npy");
        copy = file;
    }
    std::filesystem::remove(folder / "a.npy");
    EXPECT_EQ(copy.values<double>()[0], 2.5);
}

TEST(NpyFile, ReadsVersionTwoDoubleQuotesAndMisalignedData) {
    const ScratchFolder folder;
    const float value = 1.5f;
    std::string data(4, '\0');
    std::memcpy(data.data(), &value, 4);
    for (const int version : {1, 2, 3}) {
        for (const std::string pad : {"", " ", "  ", "   "}) {
            const std::string dictionary =
                "{\"shape\":(1,),\"descr\":\"<f4\",\"fortran_order\":False}" + pad + "\n";
            write_file(folder / "a.npy", npy(dictionary, data, version));
            EXPECT_EQ(NpyFile(folder / "a.npy").values<float>()[0], 1.5f);
        }
    }
}

TEST(NpyFile, RefusesAnotherType) {
    const ScratchFolder folder;
    write_npy(folder / "a.npy", NpyType::f32, {1}, bytes_of(std::vector<float>{1}));
    const NpyFile file(folder / "a.npy");
    EXPECT_EQ(error_of([&] { file.values<double>(); }).sentence(),
              "holds float32 values where float64 are expected");
    EXPECT_EQ(error_of([&] { NpyFile().values<float>(); }).code(), ErrorCode::bad_input);
}

TEST(NpyFile, RefusesHostileFilesWithASentence) {
    const ScratchFolder folder;
    const auto sentence = [&](const std::string& bytes) {
        write_file(folder / "a.npy", bytes);
        const Error error = error_of([&] { NpyFile file(folder / "a.npy"); });
        EXPECT_EQ(error.code(), ErrorCode::bad_input);
        EXPECT_EQ(error.where(), (folder / "a.npy").string());
        return error.sentence();
    };
    const std::string good = npy(f32_dictionary("(2,)"), "12345678");
    EXPECT_NO_THROW((write_file(folder / "a.npy", good), NpyFile(folder / "a.npy")));

    EXPECT_EQ(sentence(""), "is empty");
    EXPECT_EQ(sentence("frame,time\n0,1\n"), "is not a .npy file");
    EXPECT_EQ(sentence(good.substr(0, 4)), "is not a .npy file");
    EXPECT_EQ(sentence(good.substr(0, 30)), "is truncated: the .npy header ends early");
    EXPECT_EQ(sentence(good.substr(0, good.size() - 3)),
              "is truncated: 5 of 8 data bytes are there");
    EXPECT_EQ(sentence(good + "x"), "has 1 bytes more than its shape says");
    EXPECT_EQ(sentence(npy(f32_dictionary("(2,)"), "12345678", 9)),
              "is of .npy version 9; 1, 2 and 3 are read");

    const char* const impossible = "has an impossible shape";
    EXPECT_EQ(sentence(npy(f32_dictionary("(-2,)"), "12345678")), impossible);
    EXPECT_EQ(sentence(npy(f32_dictionary("(99999999999999999999,)"), "")), impossible);
    EXPECT_EQ(sentence(npy(f32_dictionary("(4294967296, 4294967296)"), "")), impossible);
    EXPECT_EQ(sentence(npy(f32_dictionary("(0, 4294967296, 4294967296)"), "")), impossible);
    EXPECT_EQ(sentence(npy(f32_dictionary("(4611686018427387904,)"), "")), impossible);
    EXPECT_EQ(sentence(npy(f32_dictionary("(x,)"), "")), impossible);

    const char* const malformed = "has a .npy header that cannot be read";
    EXPECT_EQ(sentence(npy(f32_dictionary("(2,"), "")), impossible);
    EXPECT_EQ(sentence(npy("{}", "")), malformed);
    EXPECT_EQ(sentence(npy("{'descr': '<f4', 'shape': (2,)}", "")), malformed);
    EXPECT_EQ(sentence(npy("{'descr': '<f4", "")), malformed);
    EXPECT_EQ(sentence(npy(f32_dictionary("(2,)") + "junk", "")), malformed);
    EXPECT_EQ(sentence(npy("{'descr': '<f4', 'descr': '<f8'}", "")), malformed);

    EXPECT_EQ(sentence(npy("{'descr': '>f4', 'fortran_order': False, 'shape': (2,)}", "12345678")),
              "is big-endian (>f4), only little-endian is read");
    EXPECT_EQ(sentence(npy("{'descr': '<f4', 'fortran_order': True, 'shape': (2,)}", "12345678")),
              "is in Fortran order, only C order is read");
    EXPECT_EQ(sentence(npy("{'descr': '|O', 'fortran_order': False, 'shape': (1,)}", "12345678")),
              "holds values of type '|O'; uint8, uint16, float32 and float64 are read");
}

TEST(WriteNpy, RefusesValuesThatDoNotFillTheShape) {
    const ScratchFolder folder;
    EXPECT_THROW(write_npy(folder / "a.npy", NpyType::u8, {3}, bytes_of(std::vector<char>(2))),
                 std::invalid_argument);
    EXPECT_EQ(entry_count(folder.path()), 0);
}

}  // namespace
}  // namespace verdigris
