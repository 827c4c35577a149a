// SPDX-License-Identifier: MIT
#include "verdigris/files/npy_header.h"

#include <array>
#include <charconv>
#include <cstdint>
#include <string_view>

namespace verdigris {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";
// [NumpyFormat] aligns the data to 64 bytes.
constexpr std::size_t kAlignment = 64;
// chosen: NumPy's own headers are below 200 bytes; a megabyte of header is an attack or an
// accident.
constexpr std::size_t kMaxHeader = std::size_t(1) << 16;

std::string_view descriptor(NpyType type) {
    switch (type) {
        case NpyType::u8:
            return "|u1";
        case NpyType::u16:
            return "<u2";
        case NpyType::f32:
            return "<f4";
        case NpyType::f64:
            return "<f8";
    }
    return "";
}

// The header is a Python dictionary literal with three known keys. This reads exactly that and
// nothing else of Python.
class HeaderParser {
  public:
    HeaderParser(const InputFile& file, std::string_view text) : file_(file), rest_(text) {}

    NpyLayout parse() {
        NpyLayout layout;
        bool have_descr = false, have_order = false, have_shape = false;
        expect('{');
        while (!accept('}')) {
            const std::string key = quoted();
            expect(':');
            if (key == "descr" && !have_descr) {
                layout.type = type(quoted());
                have_descr = true;
            } else if (key == "fortran_order" && !have_order) {
                if (boolean()) file_.refuse("is in Fortran order, only C order is read");
                have_order = true;
            } else if (key == "shape" && !have_shape) {
                layout.shape = tuple();
                have_shape = true;
            } else {
                malformed();
            }
            if (!accept(',')) {
                expect('}');
                break;
            }
        }
        skip();
        if (!rest_.empty() || !have_descr || !have_order || !have_shape) malformed();
        return layout;
    }

  private:
    [[noreturn]] void malformed() const { file_.refuse("has a .npy header that cannot be read"); }

    void skip() {
        while (!rest_.empty() && (rest_[0] == ' ' || rest_[0] == '\n')) rest_.remove_prefix(1);
    }
    bool accept(char c) {
        skip();
        if (rest_.empty() || rest_[0] != c) return false;
        rest_.remove_prefix(1);
        return true;
    }
    void expect(char c) {
        if (!accept(c)) malformed();
    }
    std::string quoted() {
        const char quote = accept('\'') ? '\'' : '"';
        if (quote == '"') expect('"');
        const std::size_t end = rest_.find(quote);
        if (end == std::string_view::npos) malformed();
        std::string text(rest_.substr(0, end));
        rest_.remove_prefix(end + 1);
        return text;
    }
    bool boolean() {
        skip();
        for (const std::string_view word : {"True", "False"}) {
            if (rest_.substr(0, word.size()) == word) {
                rest_.remove_prefix(word.size());
                return word == "True";
            }
        }
        malformed();
    }
    std::vector<std::size_t> tuple() {
        std::vector<std::size_t> shape;
        expect('(');
        while (!accept(')')) {
            skip();
            std::size_t value = 0;
            // from_chars into an unsigned type refuses signs and overflow.
            const auto [end, error] =
                std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
            if (error != std::errc()) file_.refuse("has an impossible shape");
            rest_.remove_prefix(std::size_t(end - rest_.data()));
            shape.push_back(value);
            if (!accept(',')) {
                expect(')');
                break;
            }
        }
        return shape;
    }
    NpyType type(const std::string& text) {
        for (const NpyType t : {NpyType::u8, NpyType::u16, NpyType::f32, NpyType::f64}) {
            if (text == descriptor(t) || (t == NpyType::u8 && (text == "<u1" || text == ">u1"))) {
                return t;
            }
        }
        if (!text.empty() && text[0] == '>') {
            file_.refuse("is big-endian (" + text + "), only little-endian is read");
        }
        file_.refuse("holds values of type '" + text +
                     "'; uint8, uint16, float32 and float64 are read");
    }

    const InputFile& file_;
    std::string_view rest_;
};

}  // namespace

std::string npy_type_name(NpyType type) {
    switch (type) {
        case NpyType::u8:
            return "uint8";
        case NpyType::u16:
            return "uint16";
        case NpyType::f32:
            return "float32";
        case NpyType::f64:
            return "float64";
    }
    return "";
}

std::string npy_header(NpyType type, const std::vector<std::size_t>& shape, std::size_t reserve) {
    std::string text =
        "{'descr': '" + std::string(descriptor(type)) + "', 'fortran_order': False, 'shape': (";
    const std::size_t fixed = text.size();
    for (std::size_t i = 0; i < shape.size(); ++i) {
        if (i > 0) text += ' ';
        text += std::to_string(shape[i]);
        if (i + 1 < shape.size() || shape.size() == 1) text += ',';
    }
    text += "), }";
    std::size_t longest = text.size();
    if (reserve > 0 && !shape.empty()) {
        const std::size_t digits = text.find_first_not_of("0123456789", fixed) - fixed;
        longest += reserve - digits;
    }
    constexpr std::size_t kPreamble = kMagic.size() + 2 + 2;  // version and length
    const std::size_t total = (kPreamble + longest + 1 + kAlignment - 1) / kAlignment * kAlignment;
    text.resize(total - kPreamble - 1, ' ');
    text += '\n';

    std::string header(kMagic);
    header += '\x01';
    header += '\x00';
    header += char(text.size() & 0xff);
    header += char(text.size() >> 8);
    return header + text;
}

NpyLayout read_npy_layout(InputFile& file) {
    if (file.size() == 0) file.refuse("is empty");
    std::array<std::byte, 12> start{};
    const std::size_t got = file.read(start);
    const auto at = [&](std::size_t i) { return std::to_integer<std::size_t>(start[i]); };
    for (std::size_t i = 0; i < kMagic.size(); ++i) {
        if (i >= got || at(i) != std::uint8_t(kMagic[i])) file.refuse("is not a .npy file");
    }
    if (got < start.size()) file.refuse("is truncated: the .npy header ends early");
    const std::size_t version = at(6);
    if (version < 1 || version > 3) {
        file.refuse("is of .npy version " + std::to_string(version) + "; 1, 2 and 3 are read");
    }
    const std::size_t preamble = version == 1 ? 10 : 12;
    std::size_t length = at(8) | at(9) << 8;
    if (version > 1) length |= at(10) << 16 | at(11) << 24;
    if (length > kMaxHeader) file.refuse("has a .npy header that cannot be read");
    std::string text(length, '\0');
    file.seek(preamble);
    if (file.read(std::as_writable_bytes(std::span(text))) < length) {
        file.refuse("is truncated: the .npy header ends early");
    }

    NpyLayout layout = HeaderParser(file, text).parse();
    layout.data_offset = preamble + length;
    layout.data_bytes = byte_size(layout.type);
    bool overflow = false;
    // A zero anywhere makes the product zero, but a hostile shape must not hide behind it.
    std::size_t product = 1;
    for (const std::size_t n : layout.shape) {
        overflow |= __builtin_mul_overflow(product, n == 0 ? 1 : n, &product);
        layout.data_bytes = n == 0 ? 0 : layout.data_bytes;
    }
    overflow |= __builtin_mul_overflow(product, byte_size(layout.type), &product);
    if (overflow) file.refuse("has an impossible shape");
    if (layout.data_bytes != 0) layout.data_bytes = product;

    const std::uint64_t present = file.size() - layout.data_offset;
    if (present < layout.data_bytes) {
        file.refuse("is truncated: " + std::to_string(present) + " of " +
                    std::to_string(layout.data_bytes) + " data bytes are there");
    }
    if (present > layout.data_bytes) {
        file.refuse("has " + std::to_string(present - layout.data_bytes) +
                    " bytes more than its shape says");
    }
    return layout;
}

}  // namespace verdigris
