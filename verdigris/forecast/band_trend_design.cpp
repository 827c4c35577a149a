// SPDX-License-Identifier: MIT
#include "verdigris/forecast/band_trend_design.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <map>
#include <string_view>

#include "verdigris/error.h"

namespace verdigris {
namespace {

double number(const std::string& key, std::string_view value, double least) {
    double x = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), x);
    if (error != std::errc() || end != value.data() + value.size() || !std::isfinite(x) ||
        x < least || x > 1e6) {
        throw Error(ErrorCode::usage,
                    fmt::format("bandtrend's {} is a number from {:g} to 1000000, not '{}'", key,
                                least, value));
    }
    return x;
}

bool on_or_off(const std::string& key, std::string_view value) {
    if (value == "0" || value == "1") return value == "1";
    throw Error(ErrorCode::usage, fmt::format("bandtrend's {} is 0 or 1, not '{}'", key, value));
}

}  // namespace

BandTrendDesign band_trend_design(const std::string& text) {
    BandTrendDesign d;
    const std::map<std::string, bool*> parts{
        {"light", &d.light},           {"gray", &d.gray},         {"relight", &d.relight},
        {"global", &d.global},         {"split", &d.split},       {"two-parts", &d.prior.two_parts},
        {"local", &d.local},           {"bands", &d.bands},       {"slowing", &d.prior.slowing},
        {"bending", &d.prior.bending}, {"swing", &d.prior.swing}, {"noise", &d.prior.noise},
        {"walking", &d.prior.walking}};
    struct Number {
        double* value;
        double least;
    };
    const std::map<std::string, Number> numbers{
        {"events", {&d.prior.event, 0}},      {"doubt", {&d.prior.doubt, 0}},
        {"level", {&d.prior.level, 1e-6}},    {"confidence", {&d.confidence, 0}},
        {"caution", {&d.caution, 0}},         {"global-count", {&d.global_count, 1}},
        {"band-count", {&d.largest_count, 1}}};
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find(':', at + 1), text.size());
        const std::size_t equal = std::min(text.find('=', at), end);
        const std::string key = text.substr(at + 1, equal - std::min(equal, at + 1));
        const std::string_view value =
            std::string_view(text).substr(std::min(equal + 1, end), end - std::min(equal + 1, end));
        if (text[at] == ':' && parts.contains(key)) {
            *parts.at(key) = on_or_off(key, value);
        } else if (text[at] == ':' && numbers.contains(key)) {
            *numbers.at(key).value = number(key, value, numbers.at(key).least);
        } else {
            std::string keys;
            for (const auto& [name, part] : parts) keys += (keys.empty() ? "" : ", ") + name;
            for (const auto& [name, part] : numbers) keys += ", " + name;
            throw Error(ErrorCode::usage,
                        fmt::format("bandtrend has no '{}'; it has {}", key, keys));
        }
        at = end;
    }
    return d;
}

}  // namespace verdigris
