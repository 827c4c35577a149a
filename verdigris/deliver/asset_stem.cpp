// SPDX-License-Identifier: MIT
#include "verdigris/deliver/asset_stem.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace verdigris {
namespace {

// chosen: with label, resolution and map name a file name stays far below the 255 bytes of common
// file systems, and below 100, where some unzip tools stop.
constexpr std::size_t kMaxStem = 48;

bool is_upper(char c) {
    return c >= 'A' && c <= 'Z';
}
bool is_lower(char c) {
    return c >= 'a' && c <= 'z';
}
bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
char lower(char c) {
    return is_upper(c) ? char(c - 'A' + 'a') : c;
}
char upper(char c) {
    return is_lower(c) ? char(c - 'a' + 'A') : c;
}
std::string lower(std::string_view text) {
    std::string result(text);
    for (char& c : result) c = lower(c);
    return result;
}

// UTF-8 to ASCII: the letters of Latin-1 lose their accents, everything else separates words.
std::string ascii_from_utf8(std::string_view text) {
    // U+00C0 to U+00FF; '_' for the two signs among them.
    static constexpr std::string_view kLetters =
        "AAAAAAACEEEEIIIIDNOOOOO_OUUUUYTsaaaaaaaceeeeiiiidnooooo_ouuuuyty";
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        if (byte < 0x80) {
            result += text[i];
        } else if (byte == 0xC3 && i + 1 < text.size()) {
            result += kLetters[static_cast<unsigned char>(text[++i]) & 0x3F];
        } else if (byte >= 0xC0) {
            result += '_';  // continuation bytes follow and add nothing
        }
    }
    return result;
}

// Words as the eye sees them: split at whatever is no letter or digit, and at aB.
std::vector<std::string> words_of(std::string_view ascii) {
    std::vector<std::string> words(1);
    char before = 0;
    for (char c : ascii) {
        const bool separator = !is_upper(c) && !is_lower(c) && !is_digit(c);
        if (separator || (is_upper(c) && (is_lower(before) || is_digit(before)))) {
            words.emplace_back();
        }
        if (!separator) words.back() += c;
        before = c;
    }
    std::erase(words, std::string());
    return words;
}

bool sorts_wrongly(std::string_view stem) {
    const std::vector<std::string> words = node_wrangler_words(stem);
    return std::any_of(words.begin(), words.end(), names_a_map);
}

// Windows refuses files of these names whatever their extension.
bool is_device_name(const std::string& stem) {
    static constexpr std::string_view kDevices[] = {"con", "prn", "aux", "nul"};
    const std::string name = lower(stem);
    if (std::find(std::begin(kDevices), std::end(kDevices), name) != std::end(kDevices)) {
        return true;
    }
    return name.size() == 4 && (name.starts_with("com") || name.starts_with("lpt")) &&
           is_digit(name[3]);
}

}  // namespace

std::vector<std::string> node_wrangler_words(std::string_view name) {
    std::vector<std::string> words(1);
    char before = 0;
    for (char c : name) {
        if (is_digit(c)) continue;
        const bool separator = c == '_' || c == '.' || c == '-' || c == '#' || c == ' ';
        if (separator || (is_lower(before) && is_upper(c))) words.emplace_back();
        if (!separator) words.back() += lower(c);
        before = c;
    }
    std::erase(words, std::string());
    return words;
}

bool names_a_map(std::string_view word) {
    // The defaults of Node Wrangler's preferences, Blender 2.8 to 4.x, all sockets
    // [NodeWrangler].
    static constexpr std::string_view kWords[] = {
        "diffuse",   "diff",         "albedo",     "base",         "col",          "color",
        "basecolor", "sss",          "subsurface", "metallic",     "metalness",    "metal",
        "mtl",       "specularity",  "specular",   "spec",         "spc",          "roughness",
        "rough",     "rgh",          "gloss",      "glossy",       "glossiness",   "glossyness",
        "normal",    "nor",          "nrm",        "nrml",         "norm",         "bump",
        "bmp",       "displacement", "displace",   "disp",         "dsp",          "height",
        "heightmap", "alpha",        "opacity",    "transparency", "transmission", "emission",
        "emissive",  "emit",         "ao",         "ambient",      "occlusion"};
    return std::find(std::begin(kWords), std::end(kWords), word) != std::end(kWords);
}

std::string asset_stem(const std::string& name) {
    static const std::string kFallback = "Specimen";
    std::string stem;
    for (std::string word : words_of(ascii_from_utf8(name))) {
        // Two all-capital words run together ("A", "O" -> "AO"), so the whole is judged anew
        // after each word, and a word that would make it sort wrongly is left out.
        word.front() = upper(word.front());
        const bool starts = stem.empty() && is_digit(word.front());
        const std::string longer = (starts ? kFallback : stem) + word;
        if (longer.size() <= kMaxStem && !sorts_wrongly(longer)) stem = longer;
    }
    if (stem.empty()) stem = kFallback;
    if (is_device_name(stem)) stem = kFallback + stem;
    return stem;
}

}  // namespace verdigris
