// SPDX-License-Identifier: MIT
#include "verdigris/deliver/manifest.h"

#include "verdigris/deliver/json_text.h"
#include "verdigris/deliver/status_json.h"
#include "verdigris/deliver/uncertainty_map.h"
#include "verdigris/error.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/files/sha256.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json file_entries(const std::vector<fs::path>& files, const fs::path& folder) {
    std::vector<Json> entries(files.size());
    parallel_for(int(files.size()), [&](int i) {
        const fs::path& file = files[std::size_t(i)];
        const fs::path relative = file.is_absolute() ? file.lexically_relative(folder) : file;
        const fs::path whole = folder / relative;
        const std::string hash = sha256_of_file(whole);
        entries[std::size_t(i)] = {
            {"path", relative.generic_string()}, {"bytes", fs::file_size(whole)}, {"sha256", hash}};
    });
    return entries;
}

Json parsed_fact(const std::string& name, const std::string& text) {
    Json value = Json::parse(text, nullptr, false);
    if (value.is_discarded()) {
        throw Error(ErrorCode::failed, "the manifest's fact '" + name + "' is not JSON");
    }
    return value;
}

}  // namespace

void write_manifest(const Delivery& delivery, const std::vector<fs::path>& files,
                    const fs::path& file) {
    delivered_states(delivery);  // throws if the delivery is not complete
    Json rest;
    rest["title"] = delivery.title;
    rest["stem"] = delivery.stem;
    rest["forecaster"] = delivery.forecast->forecaster;
    rest["explanation"] = delivery.forecast->explanation;
    rest["context"] = delivery.forecast->context_length;
    rest["units_observed"] = delivery.units_observed;
    rest["unit"] = kUnitSentence;
    rest["horizons"] = delivery.horizons;
    rest["uncertainty"] = uncertainty_json(delivery);
    // What the maps of sheet and viewer are drawn to; without a map there is nothing to say.
    if (const double full = uncertainty_full_codes(delivery); full > 0) {
        rest["uncertainty_full_codes"] = full;
    }
    rest["guards"] = guards_json(delivery.guards);
    rest["origins"] = origins_json(*delivery.forecast, *delivery.recipe);
    rest["noise"] = {{"tau", delivery.recipe->tau}};
    rest["files"] = file_entries(files, fs::absolute(file).parent_path());

    Json manifest;
    manifest["format"] = "verdigris-manifest/1";
    manifest["version"] = writer_version();
    for (const auto& [name, text] : delivery.facts) {
        if (name == "noise") {
            rest["noise"] = parsed_fact(name, text);
        } else if (!rest.contains(name) && !manifest.contains(name)) {
            manifest[name] = parsed_fact(name, text);
        }
    }
    for (auto& [name, value] : rest.items()) manifest[name] = std::move(value);
    write_file(file, json_text(manifest, 2) + "\n");
}

}  // namespace verdigris
