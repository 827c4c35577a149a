// SPDX-License-Identifier: MIT
#include "verdigris/reproduce/ours.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "verdigris/error.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/files/csv.h"

namespace verdigris {
namespace fs = std::filesystem;
namespace {
using Json = nlohmann::ordered_json;

const double kNone = std::numeric_limits<double>::quiet_NaN();

double number(const Json& json) {
    return json.is_number() ? json.get<double>() : kNone;
}
double number(const Json& object, const char* key) {
    return object.is_object() && object.contains(key) ? number(object.at(key)) : kNone;
}
std::optional<double> optional_number(const Json& object, const char* key) {
    const double value = number(object, key);
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
}
std::vector<double> numbers(const Json& json) {
    std::vector<double> list;
    if (json.is_array())
        for (const Json& v : json) list.push_back(number(v));
    return list;
}
std::optional<Interval> interval(const Json& json) {
    if (!json.is_array() || json.size() != 2) return {};
    return Interval{number(json[0]), number(json[1])};
}

Resolved resolved_from(double gain, const Json& block, const Json& blocks) {
    Resolved r;
    r.value = gain;
    r.block = interval(block);
    for (const Json& b : blocks)
        r.blocks.push_back(
            {b.at("first_start"), b.at("last_start"), b.at("windows"), number(b, "gain")});
    for (const BlockGain& b : r.blocks) r.windows += b.windows;
    return r;
}
/// As results/resolved.h writes it.
Resolved resolved_from(const Json& json) {
    if (!json.is_object()) return {kNone, 0, {}, {}};
    return resolved_from(number(json, "gain"), json.at("interval"), json.at("blocks"));
}

OursCorrelation correlation(const Json& json) {
    return {number(json, "r"), number(json, "standard_error")};
}

/// Reads `file` and hands it to `use`; what is not as it should be is told with its name.
template <class Use>
auto from_json(const fs::path& file, const Use& use) {
    const std::string text = read_text(file, std::size_t(1) << 28);
    try {
        return use(Json::parse(text));
    } catch (const nlohmann::json::exception&) {
        throw Error(ErrorCode::bad_input, "is not what this version writes", file.string());
    }
}

/// Which of two is there alone cannot be told, and a number in the wrong place is worse than none.
void check_directions(const fs::path& file, std::size_t there, std::size_t wanted) {
    if (there == wanted) return;
    throw Error(ErrorCode::bad_input,
                "has " + std::to_string(there) + " of the " + std::to_string(wanted) +
                    " directions; its own report says why",
                file.string());
}

OursDirection direction(const Json& d) {
    OursDirection out{d.at("label"), d.at("windows"), {}};
    for (const auto& [name, s] : d.at("forecasters").items()) {
        OursForecaster f;
        f.name = name;
        f.mean = number(s.at("error"), "mean");
        f.errors = numbers(s.at("error").at("per_horizon"));
        f.delta_e = number(s, "delta_e");
        if (s.contains("gain")) {
            f.gains = numbers(s.at("gain_per_horizon"));
            f.gain =
                resolved_from(number(s, "gain"), s.at("intervals").at("block"), s.at("blocks"));
            f.naive = interval(s.at("intervals").at("naive"));
        }
        out.forecasters.push_back(std::move(f));
    }
    return out;
}

OursMaterial material(const std::string& name, const Json& row) {
    OursMaterial out{name, {}, {}, {}};
    for (const Json& h : row.at("horizons")) {
        const int horizon = h.at("horizon");
        out.flip[horizon] = number(h, "flip");
        out.lpips[horizon] = number(h, "lpips");
        if (h.contains("gain")) out.gain[horizon] = resolved_from(h.at("gain"));
    }
    return out;
}

}  // namespace

const OursForecaster* OursDirection::find(const std::string& name) const {
    const auto found = std::ranges::find(forecasters, name, &OursForecaster::name);
    return found == forecasters.end() ? nullptr : &*found;
}

OursEvaluation read_ours_evaluation(const fs::path& folder) {
    return from_json(folder / "evaluation.json", [](const Json& json) {
        // Recording i is held out in direction i; into the second is the paper's first.
        return OursEvaluation{direction(json.at("directions").at(1)),
                              direction(json.at("directions").at(0))};
    });
}

OursDirection read_ours_single(const fs::path& folder) {
    return from_json(folder / "evaluation.json",
                     [](const Json& json) { return direction(json.at("directions").at(0)); });
}

OursCharacterization read_ours_characterization(const fs::path& folder, std::size_t directions) {
    const fs::path file = folder / "characterization.json";
    return from_json(file, [&](const Json& json) {
        std::vector<std::string> labels = json.at("directions").get<std::vector<std::string>>();
        check_directions(file, labels.size(), directions);
        std::ranges::reverse(labels);
        OursCharacterization out;
        for (const Json& row : json.at("rows")) {
            OursSetting s{row.at("axis"), row.at("setting"), row.at("context"), {}};
            for (const std::string& label : labels) {
                const Json& cell = row.at("directions").at(label);
                s.cells.push_back(
                    {number(cell, "error"), number(cell, "persistence"), resolved_from(cell)});
            }
            out.settings.push_back(std::move(s));
        }
        for (const std::string& label : labels) {
            const Json& far = json.at("long_horizons").at(label);
            out.far.push_back({numbers(far.at("moved")), numbers(far.at("outside")),
                               numbers(far.at("persistence")), numbers(far.at("unclamped"))});
        }
        return out;
    });
}

std::vector<OursDrift> read_ours_drift(const fs::path& folder) {
    return from_json(folder / "drift.json", [](const Json& json) {
        std::vector<OursDrift> list;
        for (const auto& [name, r] : json.at("recordings").items()) {
            OursDrift d;
            d.recording = name;
            const Json& movement = r.at("movement");
            d.specimen = optional_number(movement, "specimen");
            d.reference = optional_number(movement, "reference");
            d.ratio = optional_number(movement, "ratio");
            d.correlation = optional_number(movement, "smooth_correlation");
            for (const auto& [correction, gain] : r.at("gains").at("affinergb").items())
                d.gains[correction] = resolved_from(gain);
            list.push_back(std::move(d));
        }
        return list;
    });
}

std::vector<OursSeries> read_ours_series(const fs::path& folder) {
    const fs::path file = folder / "tables" / "drift_series.csv";
    const CsvTable table = read_csv(file);
    const int name = table.column("recording");
    if (name < 0) throw Error(ErrorCode::bad_input, "lacks the column recording", file.string());
    std::vector<OursSeries> list;
    for (const auto& row : table.rows) {
        if (list.empty() || list.back().recording != row[std::size_t(name)])
            list.push_back({row[std::size_t(name)], {}});
        for (std::size_t c = 0; c < row.size(); ++c) {
            if (!table.header[c].starts_with("specimen_") &&
                !table.header[c].starts_with("reference_"))
                continue;
            double value = kNone;
            std::from_chars(row[c].data(), row[c].data() + row[c].size(), value);
            list.back().values[table.header[c]].push_back(value);
        }
    }
    return list;
}

OursSusceptibility read_ours_susceptibility(const fs::path& folder) {
    return from_json(folder / "susceptibility.json", [](const Json& json) {
        OursSusceptibility out;
        for (const Json& w : json.at("within")) {
            const std::size_t i = w.at("learned_from").get<bool>() ? 0 : 1;
            out.recordings[i] = w.at("recording");
            out.within[i] = correlation(w.at("windows").at("specimen"));
            out.change[i] = correlation(w.at("change").at("specimen"));
        }
        out.cross = correlation(json.at("cross").at(0).at("windows").at("specimen"));
        return out;
    });
}

OursMaterials read_ours_materials(const fs::path& folder) {
    const fs::path file = folder / "materials.json";
    return from_json(file, [&](const Json& json) {
        OursMaterials out;
        check_directions(file, json.at("directions").size(), 2);
        out.control = json.at("control");
        if (json.contains("lpips_unavailable") && json.at("lpips_unavailable").is_string())
            out.no_lpips = json.at("lpips_unavailable");
        for (std::size_t d = 0; d < 2; ++d) {
            const Json& direction = json.at("directions").at(1 - d);
            out.labels[d] = direction.at("label");
            for (const auto& [name, row] : direction.at("forecasters").items())
                out.forecasters[d].push_back(material(name, row));
        }
        return out;
    });
}

OursTraining read_ours_training(const fs::path& run) {
    const fs::path file = run / "metrics.jsonl";
    std::istringstream lines(read_text(file));
    OursTraining best;
    best.validation = kNone;
    try {
        for (std::string line; std::getline(lines, line);) {
            const Json epoch = Json::parse(line);
            ++best.epochs;
            const double error = number(epoch, "validation_error");
            if (std::isfinite(best.validation) && !(error < best.validation)) continue;
            best.validation = error;
            best.persistence = number(epoch, "validation_persistence");
            best.epoch = epoch.at("epoch");
        }
    } catch (const nlohmann::json::exception&) {
        throw Error(ErrorCode::bad_input, "is not what this version writes", file.string());
    }
    return best;
}

}  // namespace verdigris
