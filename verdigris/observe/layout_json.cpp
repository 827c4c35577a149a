// SPDX-License-Identifier: MIT
#include "verdigris/observe/layout_json.h"

#include <array>
#include <string>
#include <utility>

#include "verdigris/error.h"

namespace verdigris {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::pair<Transfer, const char*>, 6> kTransfers{
    {{Transfer::display, "display"},
     {Transfer::linear, "linear"},
     {Transfer::gamma22, "gamma22"},
     {Transfer::gamma28, "gamma28"},
     {Transfer::pq, "pq"},
     {Transfer::hlg, "hlg"}}};
constexpr std::array<std::pair<Primaries, const char*>, 5> kPrimaries{
    {{Primaries::bt709, "bt709"},
     {Primaries::bt601_525, "bt601_525"},
     {Primaries::bt601_625, "bt601_625"},
     {Primaries::bt2020, "bt2020"},
     {Primaries::display_p3, "display_p3"}}};

template <class E, std::size_t N>
const char* name_of(E value, const std::array<std::pair<E, const char*>, N>& names) {
    for (const auto& [each, name] : names) {
        if (each == value) return name;
    }
    return "";
}

template <class E, std::size_t N>
E value_of(const std::string& name, const std::array<std::pair<E, const char*>, N>& names) {
    for (const auto& [value, each] : names) {
        if (each == name) return value;
    }
    throw Error(ErrorCode::bad_input, "does not know \"" + name + "\"");
}

Json json_of(Rect r) {
    return Json::array({r.x, r.y, r.width, r.height});
}

Rect rect_from(const Json& j) {
    const auto r = j.get<std::array<int, 4>>();
    return {r[0], r[1], r[2], r[3]};
}

}  // namespace

Json json_of(const SampleLayout& layout) {
    if (layout.is_rgb()) return {{"model", "srgb"}};
    const FrameFormat& f = layout.format;
    return {{"model", "ycbcr"},
            {"bits", f.bits},
            {"fraction_bits", f.fraction_bits},
            {"full_range", f.full_range},
            {"kr", f.kr},
            {"kb", f.kb},
            {"chroma_shift", {f.chroma_shift_x, f.chroma_shift_y}},
            {"chroma_site", {f.chroma_x, f.chroma_y}},
            {"transfer", name_of(f.transfer, kTransfers)},
            {"primaries", name_of(f.primaries, kPrimaries)},
            {"frame", {f.coded_width, f.coded_height}},
            {"rotation", f.rotation},
            {"stored", json_of(layout.coded)},
            {"shown", json_of(layout.shown)}};
}

SampleLayout layout_from(const Json& j) {
    SampleLayout layout;
    FrameFormat& f = layout.format;
    if (j.at("model") != "ycbcr") {
        throw Error(ErrorCode::bad_input, "does not know how the samples are stored");
    }
    f.model = PixelModel::yuv;
    f.type = SampleType::u16;
    f.bits = j.at("bits").get<int>();
    f.fraction_bits = j.at("fraction_bits").get<int>();
    f.full_range = j.at("full_range").get<bool>();
    f.kr = j.at("kr").get<double>();
    f.kb = j.at("kb").get<double>();
    const auto shift = j.at("chroma_shift").get<std::array<int, 2>>();
    f.chroma_shift_x = shift[0], f.chroma_shift_y = shift[1];
    const auto site = j.at("chroma_site").get<std::array<double, 2>>();
    f.chroma_x = site[0], f.chroma_y = site[1];
    f.transfer = value_of(j.at("transfer").get<std::string>(), kTransfers);
    f.primaries = value_of(j.at("primaries").get<std::string>(), kPrimaries);
    const auto size = j.at("frame").get<std::array<int, 2>>();
    f.coded_width = size[0], f.coded_height = size[1];
    f.rotation = j.at("rotation").get<int>();
    layout.coded = rect_from(j.at("stored"));
    layout.shown = rect_from(j.at("shown"));
    layout.check();
    return layout;
}

}  // namespace verdigris
