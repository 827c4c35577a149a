// SPDX-License-Identifier: MIT
#include "verdigris/results/protocol_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <optional>
#include <sstream>
#include <string_view>
#include <type_traits>
#include <variant>

#include "verdigris/error.h"
#include "verdigris/files/atomic_file.h"

namespace verdigris {
namespace {

/// One of two words.
struct Words {
    std::string_view first, second;
    bool second_is_set;
    void* target;
    void (*set)(void*, bool second);
};
using Target = std::variant<int*, std::optional<int>*, double*, std::optional<double>*, bool*,
                            std::uint64_t*, std::string*, Words>;
struct Field {
    std::string_view key;
    Target target;
    std::string_view meaning;
};

std::vector<Field> fields(EvaluationProtocol& p) {
    const Words mask{"union", "per-horizon", p.mask == MaskRule::per_horizon, &p.mask,
                     [](void* to, bool second) {
                         *static_cast<MaskRule*>(to) =
                             second ? MaskRule::per_horizon : MaskRule::union_of_horizons;
                     }};
    const Words area{"frame", "specimen", p.area == EvaluatedArea::specimen, &p.area,
                     [](void* to, bool second) {
                         *static_cast<EvaluatedArea*>(to) =
                             second ? EvaluatedArea::specimen : EvaluatedArea::frame;
                     }};
    return {
        {"grid", &p.grid, "samples a recording must have; 0: as many as it has"},
        {"trim_lead", &p.trim_lead, "samples left out at the start"},
        {"trim_tail", &p.trim_tail, "and at the end"},
        {"stride", &p.stride, "samples per unit"},
        {"context", &p.context, "observed frames n, one unit apart"},
        {"horizons", &p.horizons, "forecast frames K, one unit apart"},
        {"train_fraction", &p.train_fraction, "of the grid"},
        {"validation_fraction", &p.validation_fraction, "of the grid, behind the embargo"},
        {"embargo", &p.embargo, "samples between them that neither uses; default: a window's span"},
        {"min_foreground", &p.min_foreground, "windows with fewer changing pixels are skipped"},
        {"tau", &p.tau, "foreground threshold; default: 2.40 times the noise"},
        {"tau_floor", &p.tau_floor, "but at least this"},
        {"mask", mask, "of which horizons a pixel must have changed: union or per-horizon"},
        {"area", area, "where forecasts apply and foreground is looked for: frame or specimen"},
        {"max_windows", &p.max_windows, "evenly spaced among all; 0: all"},
        {"delta_e", &p.delta_e, "also CIEDE2000"},
        {"out_of_gamut", &p.out_of_gamut, "also the share of pixels that leave [0, 1]"},
        {"hash_frames", &p.hash_frames, "so that the audit sees a frame used twice"},
        {"bootstrap_draws", &p.bootstrap_draws, ""},
        {"seed", &p.seed, "of the bootstrap"},
        {"single", &p.single, "one recording by itself, training-free forecasters only"},
        {"hold_out", &p.hold_out, "name of the one recording to hold out; default: each in turn"},
    };
}

[[noreturn]] void fail(const std::filesystem::path& path, const toml::source_region& at,
                       const std::string& sentence) {
    throw Error(ErrorCode::bad_input, sentence,
                fmt::format("{}, line {}", path.string(), at.begin.line));
}

toml::table parsed(const std::filesystem::path& path) {
    // chosen: a file of this kind is a page. The parser recurses on dots, so long chains of them
    // must not reach it.
    const std::string text = read_text(path, 1 << 20);
    if (text.find(".a.a.a.a") != std::string::npos ||
        std::count(text.begin(), text.end(), '.') > 5000) {
        throw Error(ErrorCode::bad_input, "is not a file of keys and values", path.string());
    }
    try {
        return toml::parse(text, path.string());
    } catch (const toml::parse_error& e) {
        throw Error(
            ErrorCode::bad_input,
            fmt::format("is not TOML ({}); allowed are lines `key = value`", e.description()),
            fmt::format("{}, line {}", path.string(), e.source().begin.line));
    }
}

std::string allowed(const Target& target) {
    if (const Words* w = std::get_if<Words>(&target))
        return fmt::format("\"{}\" and \"{}\"", w->first, w->second);
    if (std::holds_alternative<bool*>(target)) return "true and false";
    if (std::holds_alternative<std::string*>(target)) return "names in quotes";
    if (std::holds_alternative<double*>(target) ||
        std::holds_alternative<std::optional<double>*>(target))
        return "numbers";
    return "whole numbers from 0 up";
}

bool take(const Target& target, const toml::node& node) {
    return std::visit(
        [&](auto value) {
            using T = decltype(value);
            if constexpr (std::is_same_v<T, Words>) {
                const auto text = node.value_exact<std::string>();
                if (!text || (*text != value.first && *text != value.second)) return false;
                value.set(value.target, *text == value.second);
                return true;
            } else if constexpr (std::is_same_v<T, bool*>) {
                const auto flag = node.value_exact<bool>();
                if (flag) *value = *flag;
                return flag.has_value();
            } else if constexpr (std::is_same_v<T, std::string*>) {
                const auto text = node.value_exact<std::string>();
                if (text) *value = *text;
                return text.has_value();
            } else if constexpr (std::is_same_v<T, double*> ||
                                 std::is_same_v<T, std::optional<double>*>) {
                if (!node.is_number()) return false;
                *value = *node.value<double>();
                return true;
            } else {
                const auto number = node.value_exact<std::int64_t>();
                if (!number || *number < 0 || *number > 1000000000) return false;
                *value = static_cast<
                    std::conditional_t<std::is_same_v<T, std::uint64_t*>, std::uint64_t, int>>(
                    *number);
                return true;
            }
        },
        target);
}

std::string shown(const Target& target) {
    return std::visit(
        [](auto value) -> std::string {
            using T = decltype(value);
            if constexpr (std::is_same_v<T, Words>) {
                return fmt::format("\"{}\"", value.second_is_set ? value.second : value.first);
            } else if constexpr (std::is_same_v<T, std::optional<int>*> ||
                                 std::is_same_v<T, std::optional<double>*>) {
                return *value ? fmt::format("{}", **value) : "";
            } else if constexpr (std::is_same_v<T, std::string*>) {
                if (value->empty()) return "";
                std::ostringstream quoted;  // escapes as TOML wants it
                quoted << toml::value<std::string>(*value);
                return quoted.str();
            } else {
                return fmt::format("{}", *value);
            }
        },
        target);
}

}  // namespace

EvaluationProtocol read_protocol(const std::filesystem::path& path) {
    EvaluationProtocol protocol;
    const toml::table file = parsed(path);
    const std::vector<Field> known = fields(protocol);
    for (const auto& [key, node] : file) {
        const std::string_view name = key.str();
        const auto field =
            std::find_if(known.begin(), known.end(), [&](const Field& f) { return f.key == name; });
        if (field == known.end()) {
            std::vector<std::string_view> names;
            for (const Field& f : known) names.push_back(f.key);
            fail(path, key.source(),
                 fmt::format("there is no key '{}'; allowed are {}", key.str().substr(0, 60),
                             fmt::join(names, ", ")));
        }
        if (!take(field->target, node))
            fail(path, node.source(),
                 fmt::format("{} cannot be this; allowed are {}", field->key,
                             allowed(field->target)));
    }
    try {
        check_protocol(protocol);
    } catch (const Error& e) {
        // The line of the first key that the sentence names.
        for (const auto& [key, node] : file) {
            if (e.sentence().find(key.str()) != std::string::npos)
                fail(path, node.source(), e.sentence());
        }
        throw Error(ErrorCode::bad_input, e.sentence(), path.string());
    }
    return protocol;
}

std::string protocol_text(const EvaluationProtocol& protocol) {
    EvaluationProtocol copy = protocol;
    std::string text = "# How forecasters are judged: docs/PROTOCOL.md\n";
    for (const Field& field : fields(copy)) {
        const std::string value = shown(field.target);
        const std::string line = value.empty() ? fmt::format("# {} =", field.key)
                                               : fmt::format("{} = {}", field.key, value);
        text +=
            field.meaning.empty() ? line + "\n" : fmt::format("{:<32}# {}\n", line, field.meaning);
    }
    return text;
}

std::vector<NamedBlock> read_blocks(const std::filesystem::path& path) {
    std::vector<NamedBlock> blocks;
    for (const auto& [recording, node] : parsed(path)) {
        const toml::table* section = node.as_table();
        if (!section)
            fail(path, recording.source(),
                 "allowed are sections, [recording], with lines name = [begin, end]");
        for (const auto& [name, value] : *section) {
            const toml::array* span = value.as_array();
            const bool pair =
                span && span->size() == 2 && (*span)[0].is_number() && (*span)[1].is_number();
            const double begin = pair ? *(*span)[0].value<double>() : 0;
            const double end = pair ? *(*span)[1].value<double>() : 0;
            if (!pair || !(begin >= 0) || !(end > begin) || !(end < 1e9))
                fail(path, name.source(),
                     fmt::format("{} is no block; allowed is [begin, end] in units, 0 <= begin < "
                                 "end",
                                 name.str()));
            for (const NamedBlock& b : blocks) {
                if (b.recording == recording.str() && begin < b.end && b.begin < end)
                    fail(path, name.source(),
                         fmt::format("{} overlaps {}; blocks may not", name.str(), b.name));
            }
            blocks.push_back({std::string(recording.str()), std::string(name.str()), begin, end});
        }
    }
    std::stable_sort(blocks.begin(), blocks.end(), [](const NamedBlock& a, const NamedBlock& b) {
        return a.recording != b.recording ? a.recording < b.recording : a.begin < b.begin;
    });
    return blocks;
}

}  // namespace verdigris
