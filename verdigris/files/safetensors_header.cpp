// SPDX-License-Identifier: MIT
// The layout is that of [Safetensors]; the JSON is read event by event, because a document tree
// would silently keep the last of two tensors of one name and take many times the header's size.
#include "verdigris/files/safetensors_header.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace verdigris {
namespace {

using Json = nlohmann::json;

struct TypeRow {
    std::string_view name;
    std::size_t bits;
};
// In the order of TensorType.
constexpr std::array<TypeRow, 22> kTypes{{
    {"BOOL", 8},        {"F4", 4},      {"F6_E2M3", 6}, {"F6_E3M2", 6}, {"U8", 8},
    {"I8", 8},          {"F8_E5M2", 8}, {"F8_E4M3", 8}, {"F8_E8M0", 8}, {"F8_E4M3FNUZ", 8},
    {"F8_E5M2FNUZ", 8}, {"I16", 16},    {"U16", 16},    {"F16", 16},    {"BF16", 16},
    {"I32", 32},        {"U32", 32},    {"F32", 32},    {"C64", 64},    {"F64", 64},
    {"I64", 64},        {"U64", 64},
}};
static_assert(std::size_t(TensorType::u64) + 1 == kTypes.size());

// Events in, tensors out. Whatever the format does not allow at a place ends the reading there, so
// that neither depth nor length of a hostile header costs anything.
class HeaderReader : public nlohmann::json_sax<Json> {
  public:
    HeaderReader(const InputFile& file, const SafetensorsLimits& limits)
        : file_(file), limits_(limits) {}

    SafetensorsHeader take() { return std::move(header_); }

    bool start_object(std::size_t) override {
        if (place_ == Place::outside) {
            place_ = Place::header;
        } else if (place_ == Place::header && key_ == kSafetensorsMetadataKey) {
            if (metadata_seen_) refuse("has __metadata__ twice");
            metadata_seen_ = true;
            place_ = Place::metadata;
        } else if (place_ == Place::header) {
            if (header_.tensors.size() == limits_.tensors) {
                refuse(fmt::format("holds more than {} tensors", limits_.tensors));
            }
            header_.tensors.emplace_back().name = key_;
            type_seen_ = shape_seen_ = false;
            offset_count_ = 0;
            offsets_seen_ = false;
            place_ = Place::tensor;
        } else {
            misplaced("an object");
        }
        return true;
    }
    bool key(std::string& key) override {
        if (place_ == Place::tensor && key != "dtype" && key != "shape" && key != "data_offsets") {
            refuse(tensor() + " has a field " + quoted_name(key) + ", which the format lacks");
        }
        if (place_ == Place::metadata && header_.metadata.contains(key)) {
            refuse("has the metadata " + quoted_name(key) + " twice");
        }
        key_ = key;
        return true;
    }
    bool end_object() override {
        if (place_ == Place::tensor) {
            if (!type_seen_) refuse(tensor() + " has no dtype");
            if (!shape_seen_) refuse(tensor() + " has no shape");
            if (!offsets_seen_) refuse(tensor() + " has no data_offsets");
        }
        place_ = place_ == Place::header ? Place::outside : Place::header;
        return true;
    }
    bool start_array(std::size_t) override {
        if (place_ != Place::tensor || key_ == "dtype") misplaced("a list");
        bool& seen = key_ == "shape" ? shape_seen_ : offsets_seen_;
        if (seen) refuse(tensor() + " has " + key_ + " twice");
        seen = true;
        place_ = key_ == "shape" ? Place::shape : Place::offsets;
        return true;
    }
    bool end_array() override {
        if (place_ == Place::offsets && offset_count_ != 2) {
            refuse(tensor() + " has data_offsets that are not two numbers");
        }
        place_ = Place::tensor;
        return true;
    }
    bool string(std::string& value) override {
        if (place_ == Place::metadata) {
            if (header_.metadata.size() == limits_.metadata_entries) {
                refuse(
                    fmt::format("has more than {} entries of metadata", limits_.metadata_entries));
            }
            header_.metadata.emplace(key_, value);
            return true;
        }
        if (place_ != Place::tensor || key_ != "dtype") misplaced("a text");
        if (type_seen_) refuse(tensor() + " has dtype twice");
        const auto type = tensor_type_from(value);
        if (!type) {
            refuse(tensor() + " has the type " + quoted_name(value) + ", which is not known");
        }
        header_.tensors.back().type = *type;
        return type_seen_ = true;
    }
    bool number_unsigned(std::uint64_t value) override {
        if (place_ != Place::shape && place_ != Place::offsets) misplaced("a number");
        TensorEntry& entry = header_.tensors.back();
        if (place_ == Place::offsets) {
            (offset_count_++ == 0 ? entry.begin : entry.end) = value;
            return true;
        }
        if (entry.shape.size() == kSafetensorsRankLimit) {
            refuse(fmt::format("{} has more than {} dimensions", tensor(), kSafetensorsRankLimit));
        }
        if (value > std::uint64_t(std::numeric_limits<std::int64_t>::max())) {
            refuse(tensor() + " has a dimension that is too large");
        }
        entry.shape.push_back(std::int64_t(value));
        return true;
    }
    // Called for what begins with a minus: -0 too, which is no size.
    bool number_integer(std::int64_t) override { misplaced("a negative number"); }
    bool number_float(double, const std::string&) override {
        misplaced("a number that is not whole or too large");
    }
    bool boolean(bool) override { misplaced("true or false"); }
    bool null() override { misplaced("null"); }
    bool binary(Json::binary_t&) override { misplaced("bytes"); }
    bool parse_error(std::size_t position, const std::string&,
                     const nlohmann::detail::exception& error) override {
        constexpr int kNumberOverflow = 406;
        if (error.id == kNumberOverflow) misplaced("a number that is not whole or too large");
        refuse(
            fmt::format("is no safetensors file or is damaged: byte {} of its header does not "
                        "belong into JSON in UTF-8",
                        position));
    }

  private:
    enum class Place { outside, header, metadata, tensor, shape, offsets };

    std::string tensor() const { return "the tensor " + quoted_name(header_.tensors.back().name); }

    [[noreturn]] void misplaced(const std::string& what) const {
        switch (place_) {
            case Place::outside:
                refuse("is no safetensors file: its header is " + what + ", not an object");
            case Place::header:
                refuse((key_ == kSafetensorsMetadataKey ? std::string(kSafetensorsMetadataKey)
                                                        : "the tensor " + quoted_name(key_)) +
                       " is " + what + ", not an object");
            case Place::metadata:
                refuse("the metadata " + quoted_name(key_) + " is " + what + ", not a text");
            case Place::tensor:
                refuse(tensor() + " has " + what + " as its " + key_);
            case Place::shape:
                refuse(tensor() + " has " + what + " in its shape");
            case Place::offsets:
                refuse(tensor() + " has " + what + " in its data_offsets");
        }
        refuse("has a damaged header");
    }
    [[noreturn]] void refuse(const std::string& sentence) const { file_.refuse(sentence); }

    const InputFile& file_;
    const SafetensorsLimits& limits_;
    SafetensorsHeader header_;
    Place place_ = Place::outside;
    std::string key_;
    bool metadata_seen_ = false;
    bool type_seen_ = false, shape_seen_ = false, offsets_seen_ = false;
    int offset_count_ = 0;
};

// Each range is that of its shape and lies in the data.
void check_ranges(const InputFile& file, const std::vector<TensorEntry>& tensors,
                  std::uint64_t data_bytes) {
    for (const TensorEntry& t : tensors) {
        const auto refuse = [&](const std::string& sentence) {
            file.refuse("the tensor " + quoted_name(t.name) + " " + sentence);
        };
        const auto bytes = tensor_bytes(t.type, t.shape);
        if (!bytes) refuse("has a shape whose size is no whole number of bytes or overflows");
        if (t.begin > t.end) refuse("has data that end before they begin");
        if (t.end > data_bytes) {
            refuse(
                fmt::format("has data up to byte {}, but only {} bytes follow the header: the "
                            "file is truncated or damaged",
                            t.end, data_bytes));
        }
        if (t.end - t.begin != *bytes) {
            refuse(fmt::format("has {} bytes of data where its type {} and shape [{}] need {}",
                               t.end - t.begin, to_string(t.type), fmt::join(t.shape, ","),
                               *bytes));
        }
    }
}

// Sorted by their data. Together they are the data, each byte once: no file hides in another.
void check_cover(const InputFile& file, const std::vector<TensorEntry>& tensors,
                 std::uint64_t data_bytes) {
    std::uint64_t covered = 0;
    const TensorEntry* before = nullptr;
    for (const TensorEntry& t : tensors) {
        if (t.begin < covered) {
            file.refuse("the data of the tensors " + quoted_name(before->name) + " and " +
                        quoted_name(t.name) + " overlap");
        }
        if (t.begin > covered) {
            file.refuse(fmt::format("{} bytes of data before the tensor {} belong to no tensor",
                                    t.begin - covered, quoted_name(t.name)));
        }
        covered = t.end;
        before = &t;
    }
    if (covered != data_bytes) {
        file.refuse(
            fmt::format("{} bytes of data at its end belong to no tensor", data_bytes - covered));
    }
}

void refuse_duplicates(const InputFile& file, const std::vector<TensorEntry>& tensors) {
    std::vector<std::string_view> names;
    names.reserve(tensors.size());
    for (const TensorEntry& t : tensors) names.push_back(t.name);
    std::sort(names.begin(), names.end());
    const auto twice = std::adjacent_find(names.begin(), names.end());
    if (twice != names.end()) file.refuse("has the tensor " + quoted_name(*twice) + " twice");
}

std::string read_header_text(InputFile& file) {
    constexpr std::string_view kNoFile = "is no safetensors file or is truncated: ";
    std::array<std::byte, kSafetensorsLengthBytes> start{};
    if (file.read(start) < start.size()) {
        file.refuse(fmt::format("{}it has {} bytes, and the length of the header alone takes {}",
                                kNoFile, file.size(), start.size()));
    }
    std::uint64_t length = 0;
    for (std::size_t i = start.size(); i-- > 0;) length = length << 8 | std::uint64_t(start[i]);
    if (length > file.size() - start.size()) {
        file.refuse(fmt::format("{}its first bytes promise a header of {} bytes, {} follow",
                                kNoFile, length, file.size() - start.size()));
    }
    if (length > kSafetensorsHeaderLimit) {
        file.refuse(fmt::format("has a header of {} bytes, the format allows {}", length,
                                kSafetensorsHeaderLimit));
    }
    std::string text(std::size_t(length), '\0');
    if (file.read(std::as_writable_bytes(std::span(text))) < text.size()) {
        file.refuse("became shorter while it was read");
    }
    // The JSON reader takes a zero for the end and would not look at what stands behind it, and it
    // skips a byte-order mark.
    if (text.find('\0') != std::string::npos) {
        file.refuse("is no safetensors file or is damaged: its header has a zero byte");
    }
    // The text of the format wants "{" first; its authors' reader lets white space pass, for
    // writers that align the data by it.
    if (const std::size_t first = text.find_first_not_of(" \t\r\n");
        first == std::string::npos || text[first] != '{') {
        file.refuse("is no safetensors file: its header is not a JSON object");
    }
    return text;
}

std::string json_string(const std::string& text, Json::error_handler_t errors) {
    return Json(text).dump(-1, ' ', false, errors);
}

}  // namespace

std::string_view to_string(TensorType type) {
    return kTypes.at(std::size_t(type)).name;
}

std::size_t bit_size(TensorType type) {
    return kTypes.at(std::size_t(type)).bits;
}

std::optional<TensorType> tensor_type_from(std::string_view name) {
    const auto* found = std::find_if(kTypes.begin(), kTypes.end(),
                                     [&](const TypeRow& row) { return row.name == name; });
    if (found == kTypes.end()) return std::nullopt;
    return TensorType(found - kTypes.begin());
}

std::optional<std::uint64_t> tensor_bytes(TensorType type, std::span<const std::int64_t> shape) {
    // A signed product of what is not zero: strides are computed of it, also of empty tensors.
    auto bits = std::int64_t(bit_size(type));
    bool empty = false;
    for (const std::int64_t n : shape) {
        if (n < 0) return std::nullopt;
        empty |= n == 0;
        if (n != 0 && __builtin_mul_overflow(bits, n, &bits)) return std::nullopt;
    }
    if (empty) return 0;
    if (bits % 8 != 0) return std::nullopt;
    return std::uint64_t(bits / 8);
}

std::string quoted_name(std::string_view name) {
    constexpr std::size_t kShown = 80;  // chosen: a line
    const std::string shown(name.substr(0, kShown));
    return Json(shown).dump(-1, ' ', true, Json::error_handler_t::replace) +
           (name.size() > kShown ? "..." : "");
}

SafetensorsHeader read_safetensors_header(InputFile& file, const SafetensorsLimits& limits) {
    HeaderReader reader(file, limits);
    std::uint64_t data_bytes = 0;
    {
        const std::string text = read_header_text(file);
        data_bytes = file.size() - kSafetensorsLengthBytes - text.size();
        Json::sax_parse(text, &reader);
    }
    SafetensorsHeader header = reader.take();
    refuse_duplicates(file, header.tensors);
    check_ranges(file, header.tensors, data_bytes);
    std::sort(header.tensors.begin(), header.tensors.end(),
              [](const TensorEntry& a, const TensorEntry& b) {
                  return std::tie(a.begin, a.end, a.name) < std::tie(b.begin, b.end, b.name);
              });
    check_cover(file, header.tensors, data_bytes);
    return header;
}

std::string safetensors_header(const SafetensorsHeader& header) try {
    using Errors = Json::error_handler_t;
    std::string text = "{";
    const auto comma = [&] { return text.size() > 1 ? "," : ""; };
    if (!header.metadata.empty()) {
        std::string entries;
        for (const auto& [key, value] : header.metadata) {
            entries += (entries.empty() ? "" : ",") + json_string(key, Errors::strict) + ":" +
                       json_string(value, Errors::replace);
        }
        text += fmt::format("\"{}\":{{{}}}", kSafetensorsMetadataKey, entries);
    }
    for (const TensorEntry& t : header.tensors) {
        text += fmt::format("{}{}:{{\"dtype\":\"{}\",\"shape\":[{}],\"data_offsets\":[{},{}]}}",
                            comma(), json_string(t.name, Errors::strict), to_string(t.type),
                            fmt::join(t.shape, ","), t.begin, t.end);
    }
    text += "}";
    text.resize((text.size() + 7) / 8 * 8, ' ');
    if (text.size() > kSafetensorsHeaderLimit) {
        throw std::invalid_argument("safetensors: the header is over the format's limit");
    }
    std::string length;
    for (int i = 0; i < 8; ++i) length += char(std::uint64_t(text.size()) >> (8 * i) & 0xff);
    return length + text;
} catch (const Json::exception&) {
    throw std::invalid_argument("safetensors: a name that is no UTF-8");
}

}  // namespace verdigris
