// SPDX-License-Identifier: MIT
#include "verdigris/files/exif.h"

#include <fmt/format.h>
#include <libexif/exif-data.h>

#include <cmath>
#include <memory>
#include <string_view>
#include <vector>

#include "verdigris/error.h"
#include "verdigris/files/csv.h"

namespace verdigris {
namespace {

std::string trimmed(std::string_view text) {
    text = text.substr(0, text.find('\0'));
    const auto first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return {};
    return std::string(text.substr(first, text.find_last_not_of(" \t") - first + 1));
}

class Entries {
  public:
    explicit Entries(std::span<const std::byte> data) : data_(exif_data_new()) {
        if (!data_) return;
        // "Repairs" would invent tags and move them.
        exif_data_unset_option(data_.get(), EXIF_DATA_OPTION_FOLLOW_SPECIFICATION);
        // libexif wants the prefix that JPEG has and that PNG and TIFF have not.
        std::vector<unsigned char> bytes{'E', 'x', 'i', 'f', 0, 0};
        const auto* start = reinterpret_cast<const unsigned char*>(data.data());
        bytes.insert(bytes.end(), start, start + data.size());
        exif_data_load_data(data_.get(), bytes.data(), unsigned(bytes.size()));
        order_ = exif_data_get_byte_order(data_.get());
    }

    std::string text(ExifIfd ifd, ExifTag tag) const {
        const ExifEntry* e = entry(ifd, tag, EXIF_FORMAT_ASCII, 1);
        return e ? trimmed({reinterpret_cast<const char*>(e->data), e->size}) : std::string();
    }
    int number(ExifIfd ifd, ExifTag tag) const {
        if (const ExifEntry* e = entry(ifd, tag, EXIF_FORMAT_SHORT, 2)) {
            return exif_get_short(e->data, order_);
        }
        if (const ExifEntry* e = entry(ifd, tag, EXIF_FORMAT_LONG, 4)) {
            return int(exif_get_long(e->data, order_) & 0x7fffffff);
        }
        return 0;
    }
    double ratio(ExifIfd ifd, ExifTag tag) const {
        const ExifEntry* e = entry(ifd, tag, EXIF_FORMAT_RATIONAL, 8);
        if (!e) return 0;
        const ExifRational r = exif_get_rational(e->data, order_);
        return r.denominator == 0 ? 0 : double(r.numerator) / double(r.denominator);
    }

  private:
    const ExifEntry* entry(ExifIfd ifd, ExifTag tag, ExifFormat format, unsigned size) const {
        if (!data_) return nullptr;
        const ExifEntry* e = exif_content_get_entry(data_->ifd[ifd], tag);
        return e && e->data && e->format == format && e->size >= size ? e : nullptr;
    }
    struct Release {
        void operator()(ExifData* data) const { exif_data_unref(data); }
    };
    std::unique_ptr<ExifData, Release> data_;
    ExifByteOrder order_ = EXIF_BYTE_ORDER_INTEL;
};

}  // namespace

std::optional<double> ExifFacts::taken() const {
    if (date.empty()) return std::nullopt;
    std::string text = date;
    if (!subseconds.empty()) text += "." + subseconds;
    for (const std::string& whole : {text + offset, text, date + offset, date}) {
        try {
            // Damaged companions must not cost the date itself.
            return seconds_from_text(whole);
        } catch (const Error&) {
        }
    }
    return std::nullopt;
}

std::string ExifFacts::camera() const {
    // Many makers repeat their name in the model.
    std::string text = model.rfind(make, 0) == 0 ? model : trimmed(make + " " + model);
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
    if (iso > 0) add(fmt::format("ISO {}", iso));
    if (exposure_seconds > 0) {
        // Below 0.3 s cameras and people speak of fractions.
        add(exposure_seconds < 0.3 ? fmt::format("1/{} s", std::lround(1 / exposure_seconds))
                                   : fmt::format("{:g} s", exposure_seconds));
    }
    if (f_number > 0) add(fmt::format("f/{:g}", f_number));
    return text;
}

ExifFacts read_exif(std::span<const std::byte> data) {
    ExifFacts facts;
    if (data.empty()) return facts;
    const Entries entries(data);
    const int orientation = entries.number(EXIF_IFD_0, EXIF_TAG_ORIENTATION);
    if (orientation >= 1 && orientation <= 8) facts.orientation = orientation;
    facts.date = entries.text(EXIF_IFD_EXIF, EXIF_TAG_DATE_TIME_ORIGINAL);
    facts.subseconds = entries.text(EXIF_IFD_EXIF, EXIF_TAG_SUB_SEC_TIME_ORIGINAL);
    facts.offset = entries.text(EXIF_IFD_EXIF, EXIF_TAG_OFFSET_TIME_ORIGINAL);
    facts.make = entries.text(EXIF_IFD_0, EXIF_TAG_MAKE);
    facts.model = entries.text(EXIF_IFD_0, EXIF_TAG_MODEL);
    facts.iso = entries.number(EXIF_IFD_EXIF, EXIF_TAG_ISO_SPEED_RATINGS);
    facts.exposure_seconds = entries.ratio(EXIF_IFD_EXIF, EXIF_TAG_EXPOSURE_TIME);
    facts.f_number = entries.ratio(EXIF_IFD_EXIF, EXIF_TAG_FNUMBER);
    facts.color_space = entries.number(EXIF_IFD_EXIF, EXIF_TAG_COLOR_SPACE);
    return facts;
}

}  // namespace verdigris
