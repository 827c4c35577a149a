// SPDX-License-Identifier: MIT
// Safetensors files that lie. Each gets one sentence; none is read beyond what it holds.
#include <gtest/gtest.h>

#include <random>
#include <set>
#include <string>
#include <vector>

#include "verdigris/files/atomic_file.h"
#include "verdigris/files/safetensors.h"
#include "verdigris/files/safetensors_testing.h"

namespace verdigris {
namespace {

// The sentence with which both ways of reading refuse the file.
std::string sentence_for(const std::string& text, const SafetensorsLimits& limits = {}) {
    static const ScratchFolder folder;
    const auto path = folder / "a.safetensors";
    put_text(path, text);
    const Error error = error_of([&] { read_safetensors(path, limits); });
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    EXPECT_EQ(error.where(), path.string());
    EXPECT_LT(error.sentence().size(), 400u);
    EXPECT_EQ(error.sentence().find('\n'), std::string::npos);
    const Error again = error_of([&] { read_safetensors_metadata(path, limits); });
    EXPECT_EQ(again.sentence(), error.sentence());
    return error.sentence();
}

// For the tensor "w" with the fields given and 16 bytes of data.
std::string sentence_for_fields(const std::string& fields) {
    return sentence_for(safetensors_text("{\"w\":{" + fields + "}}", std::string(16, '\0')));
}
std::string sentence_for_shape(const std::string& shape) {
    return sentence_for_fields(R"("dtype":"I32","data_offsets":[0,16],"shape":)" + shape);
}
std::string sentence_for_offsets(const std::string& offsets) {
    return sentence_for_fields(R"("dtype":"I32","shape":[2,2],"data_offsets":)" + offsets);
}
std::string entry(const std::string& name, int begin, int end) {
    return "\"" + name + R"(":{"dtype":"U8","shape":[)" + std::to_string(end - begin) +
           R"(],"data_offsets":[)" + std::to_string(begin) + "," + std::to_string(end) + "]}";
}

TEST(SafetensorsHostile, Starts) {
    EXPECT_EQ(sentence_for(""),
              "is no safetensors file or is truncated: it has 0 bytes, and the length of the "
              "header alone takes 8");
    EXPECT_EQ(sentence_for("1234567"),
              "is no safetensors file or is truncated: it has 7 bytes, and the length of the "
              "header alone takes 8");
    const std::string good = R"({"test":{"dtype":"I32","shape":[2,2],"data_offsets":[0,16]}})";
    EXPECT_EQ(sentence_for(std::string("<\0\0\0\0\xff\xff\xff", 8) + good + std::string(16, '\0')),
              "is no safetensors file or is truncated: its first bytes promise a header of "
              "18446742974197923900 bytes, 76 follow");
    EXPECT_EQ(sentence_for(std::string("\xff\xff\xff\xff\xff\xff\xff\xff", 8)),
              "is no safetensors file or is truncated: its first bytes promise a header of "
              "18446744073709551615 bytes, 0 follow");
    EXPECT_EQ(sentence_for(std::string("\x03\0\0\0\0\0\0\0{}", 10)),
              "is no safetensors file or is truncated: its first bytes promise a header of 3 "
              "bytes, 2 follow");
    EXPECT_EQ(sentence_for(std::string(8, '\0')),
              "is no safetensors file: its header is not a JSON object");
    EXPECT_EQ(sentence_for("A text that somebody renamed.").find("is no safetensors file"), 0u);
}

TEST(SafetensorsHostile, HeaderOverTheLimitOfTheFormat) {
    const ScratchFolder folder;
    put_text(folder / "a", std::string("\x01\xe1\xf5\x05\0\0\0\0{}", 10));  // 100,000,001
    std::filesystem::resize_file(folder / "a", 200'000'000);
    const Error error = error_of([&] { read_safetensors(folder / "a"); });
    EXPECT_EQ(error.sentence(), "has a header of 100000001 bytes, the format allows 100000000");
}

TEST(SafetensorsHostile, Json) {
    const std::string no_json = "is no safetensors file or is damaged: ";
    const std::string cut[]{"{", "{\"", "{\"a", "{\"a\"", "{\"a\":", "{\"a\":{"};
    const std::string wrong[]{"{,}", "{}}", "{} {}", "{}x", "{}//", "{'a':1}", "{\"a\":NaN}"};
    // A raw line end, an unknown escape; stray, overlong and surrogate UTF-8; text without quotes.
    const std::string text[]{"{\"a\n\":1}",   "{\"\\x\":1}",       "{\"\\ud800\":1}",
                             "{\"a\xff\":1}", "{\"a\xc0\x80\":1}", "{\"\xed\xa0\x80\":1}",
                             "{\xc3\xa9}"};
    for (const std::span<const std::string> headers :
         {std::span<const std::string>(cut), std::span<const std::string>(wrong),
          std::span<const std::string>(text)}) {
        for (const std::string& header : headers) {
            EXPECT_EQ(sentence_for(safetensors_text(header)).find(no_json), 0u) << header;
        }
    }
    EXPECT_EQ(sentence_for(safetensors_text("{\"a\":")),
              no_json + "byte 6 of its header does not belong into JSON in UTF-8");
    // What a reader stops at, another may read on behind.
    EXPECT_EQ(sentence_for(safetensors_text(std::string("{}\0{}", 5))),
              no_json + "its header has a zero byte");
    for (const std::string header :
         {"\xef\xbb\xbf{}", "[]", "\"{}\"", "1", "null", " ", "/**/{}"}) {
        EXPECT_EQ(sentence_for(safetensors_text(header)),
                  "is no safetensors file: its header is not a JSON object");
    }
}

TEST(SafetensorsHostile, Structure) {
    const auto sentence = [](const std::string& header) {
        return sentence_for(safetensors_text(header));
    };
    EXPECT_EQ(sentence(R"({"a":1})"), "the tensor \"a\" is a number, not an object");
    EXPECT_EQ(sentence(R"({"a":[]})"), "the tensor \"a\" is a list, not an object");
    EXPECT_EQ(sentence(R"({"a":null})"), "the tensor \"a\" is null, not an object");
    EXPECT_EQ(sentence(R"({"a":{}})"), "the tensor \"a\" has no dtype");
    EXPECT_EQ(sentence(R"({"a":{"dtype":"U8"}})"), "the tensor \"a\" has no shape");
    EXPECT_EQ(sentence(R"({"a":{"dtype":"U8","shape":[0]}})"),
              "the tensor \"a\" has no data_offsets");
    EXPECT_EQ(sentence(R"({"a":{"offsets":[0,1]}})"),
              "the tensor \"a\" has a field \"offsets\", which the format lacks");
    EXPECT_EQ(sentence(R"({"__metadata__":null})"), "__metadata__ is null, not an object");
    EXPECT_EQ(sentence(R"({"__metadata__":["a"]})"), "__metadata__ is a list, not an object");
    for (const auto& [value, name] : std::vector<std::pair<std::string, std::string>>{
             {"1", "a number"},
             {"-1", "a negative number"},
             {"true", "true or false"},
             {"null", "null"},
             {"{}", "an object"},
             {"[]", "a list"},
             {"1.5", "a number that is not whole or too large"}}) {
        EXPECT_EQ(sentence(R"({"__metadata__":{"epoch":)" + value + "}}"),
                  "the metadata \"epoch\" is " + name + ", not a text");
    }
    // Depth costs nothing: the first bracket too many ends it.
    const std::string deep(1'000'000, '[');
    EXPECT_EQ(sentence("{\"a\":" + deep), "the tensor \"a\" is a list, not an object");
    EXPECT_EQ(sentence("{\"a\":{\"shape\":" + deep), "the tensor \"a\" has a list in its shape");
    std::string objects;
    for (int i = 0; i < 100'000; ++i) objects += "{\"a\":";
    EXPECT_EQ(sentence(objects).find("the tensor \"a\" has a field"), 0u);
}

TEST(SafetensorsHostile, Duplicates) {
    const auto sentence = [](const std::string& header) {
        return sentence_for(safetensors_text(header, "12345678"));
    };
    EXPECT_EQ(sentence("{" + entry("a", 0, 4) + "," + entry("a", 4, 8) + "}"),
              "has the tensor \"a\" twice");
    EXPECT_EQ(sentence("{" + entry("a", 0, 4) + "," + entry("b", 4, 8) + "," +
                       entry("\\u0061", 4, 4) + "}"),
              "has the tensor \"a\" twice");
    EXPECT_EQ(sentence(R"({"__metadata__":{},"__metadata__":{}})"), "has __metadata__ twice");
    EXPECT_EQ(sentence(R"({"__metadata__":{"a":"1","\u0061":"1"}})"),
              "has the metadata \"a\" twice");
    EXPECT_EQ(sentence_for_fields(R"("dtype":"U8","dtype":"U8")"),
              "the tensor \"w\" has dtype twice");
    EXPECT_EQ(sentence_for_fields(R"("shape":[],"shape":[])"), "the tensor \"w\" has shape twice");
    EXPECT_EQ(sentence_for_fields(R"("data_offsets":[0,0],"data_offsets":[0,0])"),
              "the tensor \"w\" has data_offsets twice");
}

TEST(SafetensorsHostile, Types) {
    for (const std::string type : {"F128", "f32", "", "float32", "F32 "}) {
        EXPECT_EQ(sentence_for_fields(R"("shape":[],"data_offsets":[0,0],"dtype":")" + type + "\""),
                  "the tensor \"w\" has the type \"" + type + "\", which is not known");
    }
    EXPECT_EQ(sentence_for_fields(R"("dtype":4)"), "the tensor \"w\" has a number as its dtype");
    EXPECT_EQ(sentence_for_fields(R"("dtype":["U8"])"), "the tensor \"w\" has a list as its dtype");
}

TEST(SafetensorsHostile, Shapes) {
    const std::string size =
        "the tensor \"w\" has a shape whose size is no whole number of bytes "
        "or overflows";
    EXPECT_EQ(sentence_for_shape("[2,18446744073709551614]"),
              "the tensor \"w\" has a dimension that is too large");
    EXPECT_EQ(sentence_for_shape("[2,9223372036854775807]"), size);
    EXPECT_EQ(sentence_for_shape("[4294967296,4294967296,4]"), size);
    EXPECT_EQ(sentence_for_shape("[0,4294967296,4294967296]"), size);
    EXPECT_EQ(sentence_for_shape("[18446744073709551616]"),
              "the tensor \"w\" has a number that is not whole or too large in its shape");
    EXPECT_EQ(sentence_for_shape("[1e999]"),
              "the tensor \"w\" has a number that is not whole or too large in its shape");
    EXPECT_EQ(sentence_for_shape("[2.0,2]"),
              "the tensor \"w\" has a number that is not whole or too large in its shape");
    EXPECT_EQ(sentence_for_shape("[-2,-2]"), "the tensor \"w\" has a negative number in its shape");
    EXPECT_EQ(sentence_for_shape("[-0]"), "the tensor \"w\" has a negative number in its shape");
    EXPECT_EQ(sentence_for_shape("[\"4\"]"), "the tensor \"w\" has a text in its shape");
    EXPECT_EQ(sentence_for_shape("[null]"), "the tensor \"w\" has null in its shape");
    EXPECT_EQ(sentence_for_shape("4"), "the tensor \"w\" has a number as its shape");
    EXPECT_EQ(sentence_for_shape("{}"), "the tensor \"w\" has an object as its shape");
    EXPECT_EQ(sentence_for_shape("[3]"),
              "the tensor \"w\" has 16 bytes of data where its type I32 and shape [3] need 12");
    EXPECT_EQ(sentence_for_shape("[2,0]"),
              "the tensor \"w\" has 16 bytes of data where its type I32 and shape [2,0] need 0");
    EXPECT_EQ(sentence_for_fields(R"("dtype":"F4","shape":[1,3],"data_offsets":[0,2])"), size);
    std::string ones = "[4";
    for (int i = 0; i < 64; ++i) ones += ",1";
    EXPECT_EQ(sentence_for_shape(ones + "]"), "the tensor \"w\" has more than 64 dimensions");
}

TEST(SafetensorsHostile, Offsets) {
    const std::string two = "the tensor \"w\" has data_offsets that are not two numbers";
    EXPECT_EQ(sentence_for_offsets("[16]"), two);
    EXPECT_EQ(sentence_for_offsets("[]"), two);
    EXPECT_EQ(sentence_for_offsets("[0,8,16]"), two);
    EXPECT_EQ(sentence_for_offsets("[-16,0]"),
              "the tensor \"w\" has a negative number in its data_offsets");
    EXPECT_EQ(sentence_for_offsets("[16,0]"),
              "the tensor \"w\" has data that end before they begin");
    EXPECT_EQ(sentence_for_offsets("[4,20]"),
              "the tensor \"w\" has data up to byte 20, but only 16 bytes follow the header: the "
              "file is truncated or damaged");
    EXPECT_EQ(sentence_for_offsets("[18446744073709551600,18446744073709551615]"),
              "the tensor \"w\" has data up to byte 18446744073709551615, but only 16 bytes follow "
              "the header: the file is truncated or damaged");
    EXPECT_EQ(sentence_for_offsets("[0,4]"),
              "the tensor \"w\" has 4 bytes of data where its type I32 and shape [2,2] need 16");
}

TEST(SafetensorsHostile, CoverOfTheData) {
    const auto sentence = [](const std::string& entries, std::size_t bytes) {
        return sentence_for(safetensors_text("{" + entries + "}", std::string(bytes, '\1')));
    };
    EXPECT_EQ(sentence(entry("a", 0, 4) + "," + entry("b", 2, 6), 6),
              "the data of the tensors \"a\" and \"b\" overlap");
    EXPECT_EQ(sentence(entry("a", 0, 4) + "," + entry("b", 0, 4), 4),
              "the data of the tensors \"a\" and \"b\" overlap");
    EXPECT_EQ(sentence(entry("a", 0, 4) + "," + entry("nothing", 2, 2), 4),
              "the data of the tensors \"a\" and \"nothing\" overlap");
    EXPECT_EQ(sentence(entry("b", 5, 8) + "," + entry("a", 0, 4), 8),
              "1 bytes of data before the tensor \"b\" belong to no tensor");
    EXPECT_EQ(sentence(entry("a", 2, 8), 8),
              "2 bytes of data before the tensor \"a\" belong to no tensor");
    EXPECT_EQ(sentence(entry("a", 0, 4), 7), "3 bytes of data at its end belong to no tensor");
    EXPECT_EQ(sentence("", 34), "34 bytes of data at its end belong to no tensor");
    EXPECT_EQ(sentence("\"__metadata__\":{}", 1), "1 bytes of data at its end belong to no tensor");
}

TEST(SafetensorsHostile, Counts) {
    std::string header = "{";
    for (int i = 0; i < 1'000'000; ++i) {
        header += (i ? "," : "") + entry(std::to_string(i), 0, 0);
    }
    header += "}";
    EXPECT_EQ(sentence_for(safetensors_text(header)), "holds more than 100000 tensors");
    std::string metadata;
    for (int i = 0; i < 10'001; ++i) {
        metadata += (i ? ",\"" : "\"") + std::to_string(i) + "\":\"\"";
    }
    EXPECT_EQ(sentence_for(safetensors_text("{\"__metadata__\":{" + metadata + "}}")),
              "has more than 10000 entries of metadata");
    const std::string two = "{" + entry("a", 0, 0) + "," + entry("b", 0, 0) + "}";
    EXPECT_EQ(sentence_for(safetensors_text(two), {.tensors = 1}), "holds more than 1 tensors");
}

// A name is shown so that it cannot steer a terminal, and not at any length.
TEST(SafetensorsHostile, Names) {
    const auto sentence = [](const std::string& name) {
        return sentence_for(safetensors_text("{\"" + name + "\":{}}"));
    };
    EXPECT_EQ(sentence("\\u001b[2J\\n\\\"\xc3\xa9\x7f"),
              "the tensor \"\\u001b[2J\\n\\\"\\u00e9\\u007f\" has no dtype");
    EXPECT_EQ(sentence(std::string(1'000'000, 'n')),
              "the tensor \"" + std::string(80, 'n') + "\"... has no dtype");
    EXPECT_EQ(sentence(std::string(79, 'n') + "\xc3\xa9"),
              "the tensor \"" + std::string(79, 'n') + "\\ufffd\"... has no dtype");
}

// Returns whether the file was read; anything but a whole file or an Error fails the test.
bool survives(const std::filesystem::path& path, const std::string& text) {
    put_text(path, text);
    try {
        const SafetensorsFile file = read_safetensors(path);
        std::set<std::string> names;
        std::size_t bytes = 0, bits = 0;
        for (const Tensor& tensor : file.tensors) {
            EXPECT_TRUE(names.insert(tensor.name).second);
            bytes += tensor.bytes.size();
            std::size_t count = bit_size(tensor.type);
            for (const std::int64_t n : tensor.shape) count *= std::size_t(n);
            bits += count;
        }
        std::uint64_t header = 0;
        for (std::size_t i = 8; i-- > 0;) header = header << 8 | std::uint8_t(text[i]);
        EXPECT_EQ(8 + header + bytes, text.size());
        EXPECT_EQ(bits, 8 * bytes);
        EXPECT_EQ(read_safetensors_metadata(path), file.metadata);
        return true;
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_input);
        EXPECT_EQ(error.where(), path.string());
        EXPECT_FALSE(error.sentence().empty());
        return false;
    }
}

std::string small_file() {
    return safetensors_text(
        R"({"__metadata__":{"seed":"7"},"w":{"dtype":"F32","shape":[2,1],"data_offsets":[0,8]},)"
        R"("b":{"dtype":"BF16","shape":[],"data_offsets":[8,10]}} )",
        "0123456789");
}

TEST(SafetensorsHostile, EveryTruncationIsRefused) {
    const ScratchFolder folder;
    const std::string valid = small_file();
    ASSERT_TRUE(survives(folder / "a", valid));
    for (std::size_t length = 0; length < valid.size(); ++length) {
        EXPECT_FALSE(survives(folder / "a", valid.substr(0, length))) << length;
    }
    EXPECT_FALSE(survives(folder / "a", valid + "x"));
}

TEST(SafetensorsHostile, EveryFlippedByteIsReadOrRefused) {
    const ScratchFolder folder;
    const std::string valid = small_file();
    int read = 0, refused = 0;
    for (std::size_t at = 0; at < valid.size(); ++at) {
        for (const int flip : {0xff, 0x80, 0x01, 0x02, 0x04, 0x10, 0x20, 0x5c, 0x22}) {
            std::string broken = valid;
            broken[at] = char(broken[at] ^ flip);
            ++(survives(folder / "a", broken) ? read : refused);
        }
    }
    // Names, metadata and data may be anything; the rest may not.
    EXPECT_GT(read, 100);
    EXPECT_GT(refused, 1000);
}

// Headers put together from the format's own words, so that the damage gets past the JSON reader.
TEST(SafetensorsHostile, RandomHeadersAreReadOrRefused) {
    const ScratchFolder folder;
    std::mt19937 random(20250);
    const auto pick = [&](const std::vector<std::string>& words) {
        return words[random() % words.size()];
    };
    const std::vector<std::string> odd{"-1",
                                       "1.5",
                                       "null",
                                       "[",
                                       "{}",
                                       "\"x\"",
                                       "1e400",
                                       "]",
                                       "",
                                       "18446744073709551615",
                                       "9223372036854775807"};
    const auto number = [&](std::uint64_t right) {
        const unsigned dice = random() % 100;
        return dice == 0 ? pick(odd) : std::to_string(dice < 3 ? random() % 9 : right);
    };
    int read = 0, refused = 0;
    for (int turn = 0; turn < 20'000; ++turn) {
        std::string header = random() % 40 ? "{" : pick(odd);
        if (random() % 3 == 0) header += R"("__metadata__":{"a":"b"},)";
        std::uint64_t end = 0;
        const unsigned count = 1 + random() % 3;
        for (unsigned i = 0; i < count; ++i) {
            const std::uint64_t rows = random() % 3, columns = 1 + random() % 2;
            const bool wide = random() % 2;
            const std::uint64_t begin = std::exchange(end, end + rows * columns * (wide ? 4 : 1));
            std::vector<std::string> fields{
                std::string(R"("dtype":)") + (wide ? "\"F32\"" : "\"I8\""),
                "\"shape\":[" + number(rows) + "," + number(columns) + "]",
                "\"data_offsets\":[" + number(begin) + "," + number(end) + "]"};
            std::shuffle(fields.begin(), fields.end(), random);
            if (random() % 50 == 0) fields[random() % 3] = pick(odd);
            const std::string name(1, char('a' + (random() % 30 ? i : 0)));
            header += (i ? ",\"" : "\"") + name + "\":{" + fields[0] + "," + fields[1] + "," +
                      fields[2] + "}";
        }
        header += "}";
        if (random() % 30 == 0) header.resize(random() % header.size());
        if (random() % 30 == 0) header[random() % header.size()] = char(random());
        if (random() % 50 == 0) ++end;
        ++(survives(folder / "a", safetensors_text(header, std::string(end, 'd'))) ? read
                                                                                   : refused);
    }
    EXPECT_GT(read, 2000);
    EXPECT_GT(refused, 2000);
}

}  // namespace
}  // namespace verdigris
