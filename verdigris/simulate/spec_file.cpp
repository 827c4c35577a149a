// SPDX-License-Identifier: MIT
#include "verdigris/simulate/spec_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <sstream>
#include <type_traits>

#include "verdigris/copper/optical_constants.h"
#include "verdigris/copper/spectrum.h"
#include "verdigris/error.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/simulate/spec_fields.h"

namespace verdigris {
namespace {

// Edits that turn one word into another [Levenshtein1966]: to name the key that was meant.
std::size_t distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t(0));
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0]++;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t up = row[j + 1];
            row[j + 1] = std::min({up + 1, row[j] + 1, diagonal + (a[i] == b[j] ? 0 : 1)});
            diagonal = up;
        }
    }
    return row.back();
}

// chosen: a spec with every key is 7 kB.
constexpr std::size_t kMostBytes = std::size_t(1) << 20;

// The parser nests a table for every dot of a key and takes them down by recursion: tens of
// thousands of them would end the program. No honest line has a hundred.
void check_dots(std::string_view text, const std::filesystem::path& path) {
    int line = 1, dots = 0;
    bool comment = false;
    for (const char c : text) {
        if (c == '\n') ++line, dots = 0, comment = false;
        if (c == '#') comment = true;
        if (c != '.' || comment || ++dots < 100) continue;
        throw Error(ErrorCode::bad_input,
                    "is not a spec: a line has a hundred dots; allowed are keys under [section]",
                    fmt::format("{}, line {}", path.string(), line));
    }
}

// What the user wrote, short and harmless on a terminal.
std::string shown(std::string_view text) {
    std::string out;
    for (const char c : text.substr(0, 60))
        out += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
    return text.size() > 60 ? out + "..." : out;
}

class Reader {
  public:
    Reader(const std::filesystem::path& path, SimulationSpec& spec)
        : path_(path), spec_(spec), fields_(spec_fields(spec)) {}

    void read(const toml::table& file) {
        for (const auto& [key, node] : file) {
            if (key.str() == "preset") continue;
            if (const toml::table* table = node.as_table()) {
                if (!is_section(key.str())) unknown(key.source(), "section", key.str(), sections());
                for (const auto& [inner, value] : *table) set(key.str(), inner, value);
            } else if (is_section(key.str())) {
                fail(key.source(), fmt::format("{0} is no value; allowed is a section, [{0}] with "
                                               "its keys below",
                                               key.str()));
            } else {
                set("", key, node);
            }
        }
    }

    [[noreturn]] void fail(const toml::source_region& at, const std::string& sentence) const {
        throw Error(ErrorCode::bad_input, sentence,
                    fmt::format("{}, line {}", path_.string(), at.begin.line));
    }

    /// Two keys that do not go together: the line of the one that the sentence begins with, if the
    /// file has it.
    void check_together() const {
        try {
            check_spec(spec_);
        } catch (const Error& e) {
            const auto line = lines_.find(e.sentence().substr(0, e.sentence().find(' ')));
            if (line != lines_.end()) fail(line->second, e.sentence());
            throw Error(ErrorCode::bad_input, e.sentence(), path_.string());
        }
    }

  private:
    bool is_section(std::string_view name) const {
        return std::any_of(fields_.begin(), fields_.end(),
                           [&](const SpecField& f) { return f.section == name; });
    }
    std::vector<std::string_view> sections() const {
        std::vector<std::string_view> names;
        for (const SpecField& f : fields_) {
            if (!f.section.empty() && (names.empty() || names.back() != f.section))
                names.push_back(f.section);
        }
        return names;
    }

    [[noreturn]] void unknown(const toml::source_region& at, const char* what,
                              std::string_view name,
                              const std::vector<std::string_view>& known) const {
        if (name.size() > 60) name = name.substr(0, 60);  // the comparison is quadratic
        const auto near = std::min_element(known.begin(), known.end(), [&](auto a, auto b) {
            return distance(a, name) < distance(b, name);
        });
        const bool close = near != known.end() && distance(*near, name) <= 3;
        fail(at, fmt::format("there is no {} '{}'{}; allowed are {}", what, shown(name),
                             close ? fmt::format(" (did you mean '{}'?)", *near) : "",
                             fmt::join(known, ", ")));
    }

    void set(std::string_view section, const toml::key& key, const toml::node& node) {
        std::vector<std::string_view> known;
        for (SpecField& field : fields_) {
            if (field.section != section) continue;
            if (field.key == key.str()) return take(field, node);
            known.push_back(field.key);
        }
        if (section.empty()) {
            known.push_back("preset");
            for (const std::string_view s : sections()) known.push_back(s);
        }
        const std::string what = section.empty() ? "key" : fmt::format("key in [{}]", section);
        unknown(key.source(), what.c_str(), key.str(), known);
    }

    [[noreturn]] void refuse(const SpecField& field, const toml::node& node) const {
        // A list of three numbers of which one is wrong is shown, not called a list.
        const toml::array* list = node.as_array();
        if (list && std::holds_alternative<std::array<double, 3>*>(field.value) &&
            list->size() != 3) {
            fail(node.source(), fmt::format("{} is a list of {}; allowed are {}", field.name(),
                                            list->size(), allowed(field)));
        }
        if (list && list->size() == 3 && list->is_homogeneous<double>())
            if (const std::string text = complaint(field); !text.empty()) fail(node.source(), text);
        std::ostringstream text;
        node.visit([&](const auto& value) {
            using T = std::decay_t<decltype(value)>;
            if constexpr (toml::is_value<T>)
                text << toml::node_view<const toml::node>(node);
            else
                text << (toml::is_array<T> ? "a list" : "a table");
        });
        fail(node.source(), fmt::format("{} is {}; allowed are {}", field.name(), shown(text.str()),
                                        allowed(field)));
    }

    void take(SpecField& field, const toml::node& node) {
        lines_[field.name()] = node.source();
        std::visit([&](auto& value) { take_as(field, node, value); }, field.value);
        if (!complaint(field).empty()) refuse(field, node);
    }

    void take_as(const SpecField& field, const toml::node& node, double* value) const {
        if (!node.is_number()) refuse(field, node);
        *value = *node.value<double>();
    }
    void take_as(const SpecField& field, const toml::node& node, int* value) const {
        const auto number = node.value_exact<std::int64_t>();
        if (!number || double(*number) < field.least || double(*number) > field.most)
            refuse(field, node);
        *value = int(*number);
    }
    void take_as(const SpecField& field, const toml::node& node, std::uint64_t* value) const {
        const auto number = node.value_exact<std::int64_t>();
        if (!number || *number < 0 || double(*number) > field.most) refuse(field, node);
        *value = std::uint64_t(*number);
    }
    void take_as(const SpecField& field, const toml::node& node, bool* value) const {
        const auto flag = node.value_exact<bool>();
        if (!flag) refuse(field, node);
        *value = *flag;
    }
    void take_as(const SpecField& field, const toml::node& node,
                 std::array<double, 3>* value) const {
        const toml::array* array = node.as_array();
        if (!array || array->size() != 3) refuse(field, node);
        for (std::size_t i = 0; i < 3; ++i) {
            if (!(*array)[i].is_number()) refuse(field, node);
            (*value)[i] = *(*array)[i].value<double>();
        }
    }
    void take_as(const SpecField& field, const toml::node& node,
                 std::filesystem::path* value) const {
        const auto text = node.value_exact<std::string>();
        if (!text) refuse(field, node);
        // Absolute, so that the resolved spec means the same wherever it is written.
        *value = text->empty()
                     ? std::filesystem::path()
                     : std::filesystem::absolute(path_.parent_path() / *text).lexically_normal();
        if (value->empty()) return;
        try {
            // All of the visible range, as the optics will ask for it.
            const OpticalConstants table = read_optical_constants(*value);
            for (int band = 0; band < kBands; ++band) table.at(band_nm(band));
        } catch (const Error& e) {
            fail(node.source(), fmt::format("{} cannot be used: {}; allowed are {}", field.name(),
                                            e.what(), allowed(field)));
        }
    }
    void take_as(const SpecField& field, const toml::node& node, SpecChoice& value) const {
        const auto text = node.value_exact<std::string>();
        for (std::size_t i = 0; text && i < value.words.size(); ++i) {
            if (value.words[i] == *text) return value.set(int(i));
        }
        refuse(field, node);
    }

    std::filesystem::path path_;
    SimulationSpec& spec_;
    std::vector<SpecField> fields_;
    std::map<std::string, toml::source_region> lines_;  ///< of the keys that the file has
};

std::string text_of(const SpecField& field) {
    return std::visit(
        [](const auto& value) -> std::string {
            using T = std::decay_t<decltype(value)>;
            if constexpr (std::is_same_v<T, SpecChoice>) {
                return fmt::format("\"{}\"", value.words[std::size_t(value.get())]);
            } else if constexpr (std::is_same_v<T, std::filesystem::path*>) {
                std::ostringstream text;  // escaped as TOML asks
                text << toml::value<std::string>(value->string());
                return text.str();
            } else if constexpr (std::is_same_v<T, std::array<double, 3>*>) {
                return fmt::format("[{}]", fmt::join(*value, ", "));
            } else {
                return fmt::format("{}", *value);
            }
        },
        field.value);
}

}  // namespace

SimulationSpec read_spec(const std::filesystem::path& path, const std::string& fallback) {
    const std::string text = read_text(path, kMostBytes);
    check_dots(text, path);
    toml::table file;
    try {
        file = toml::parse(text, path.string());
    } catch (const toml::parse_error& e) {
        throw Error(ErrorCode::bad_input,
                    fmt::format("is not TOML ({}); allowed are lines `key = value` under [section]",
                                e.description()),
                    fmt::format("{}, line {}", path.string(), e.source().begin.line));
    }
    std::string preset = fallback;
    const toml::node* named = file.get("preset");
    SimulationSpec spec;
    if (named) {
        const auto name = named->value_exact<std::string>();
        const auto& names = preset_names();
        if (!name || std::find(names.begin(), names.end(), *name) == names.end()) {
            Reader(path, spec)
                .fail(named->source(), fmt::format("preset is {}; allowed are \"{}\"",
                                                   name ? "'" + shown(*name) + "'" : "no word",
                                                   fmt::join(names, "\", \"")));
        }
        preset = *name;
    }
    spec = preset_spec(preset);
    Reader reader(path, spec);
    reader.read(file);
    reader.check_together();
    return spec;
}

std::string spec_text(const SimulationSpec& spec) {
    SimulationSpec copy = spec;
    std::string text = fmt::format(
        "# Every number of a simulated specimen. Change what you like, leave out what you do not:\n"
        "# what is missing comes from the preset. docs/models/simulate.md says what all of it "
        "does.\n"
        "#   verdigris simulate --spec THIS_FILE -o specimen.mp4\n"
        "preset = \"{}\"\n",
        spec.preset);
    std::string_view section;
    for (const SpecField& field : spec_fields(copy)) {
        if (field.section != section) {
            section = field.section;
            text += fmt::format("\n[{}]\n", section);
        }
        std::string about(field.meaning);
        const bool bounded = field.least < field.most && !field.key.ends_with("seed") &&
                             !std::holds_alternative<bool*>(field.value);
        if (bounded) about += fmt::format("{}{}", about.empty() ? "" : "; ", allowed(field));
        if (std::holds_alternative<SpecChoice>(field.value)) about += "; " + allowed(field);
        const std::string line = fmt::format("{} = {}", field.key, text_of(field));
        text += about.empty() ? line + "\n" : fmt::format("{:<31} # {}\n", line, about);
    }
    return text;
}

}  // namespace verdigris
