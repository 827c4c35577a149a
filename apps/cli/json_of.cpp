// SPDX-License-Identifier: MIT
#include "json_of.h"

namespace verdigris::cli {

std::string to_string(TimeSource source) {
    switch (source) {
        case TimeSource::sidecar:
            return "times.csv";
        case TimeSource::exif:
            return "EXIF";
        case TimeSource::container:
            return "container time stamps";
        case TimeSource::file_order:
            return "file order (no times recorded)";
    }
    return {};
}

Json json_of(const Status& s) {
    return {{"id", s.id}, {"severity", verdigris::to_string(s.severity)}, {"sentence", s.sentence}};
}
Json json_of(const Statuses& statuses) {
    Json list = Json::array();
    for (const Status& s : statuses) list.push_back(json_of(s));
    return list;
}
Json json_of(Rect r) {
    return {{"x", r.x}, {"y", r.y}, {"width", r.width}, {"height", r.height}};
}

Json json_of(const RecordingInfo& i) {
    return {{"name", i.path.filename().string()},
            {"kind", i.kind == RecordingKind::video ? "video" : "photographs"},
            {"width", i.width},
            {"height", i.height},
            {"frames", i.times.size()},
            {"duration_seconds", i.times.empty() ? 0.0 : i.times.back()},
            {"time_source", to_string(i.time_source)},
            {"variable_rate", i.variable_rate},
            {"container", i.container},
            {"codec", i.codec},
            {"color", i.color_description},
            {"rotation", i.format.rotation},
            {"camera", i.camera},
            {"notes", json_of(i.notes)}};
}

Json json_of(const Inspection& i) {
    return {{"frames", i.frames},
            {"duration_seconds", i.duration_seconds},
            {"median_step_seconds", i.median_step_seconds},
            {"longest_step_seconds", i.longest_step_seconds},
            {"units", i.units},
            {"samples_per_unit", i.samples_per_unit},
            {"noise_sigma", i.noise_sigma},
            {"specimen_change", i.specimen_change},
            {"exposure_drift", i.drift_known ? Json(i.exposure_drift) : Json(nullptr)},
            {"white_balance_drift", i.drift_known ? Json(i.white_balance_drift) : Json(nullptr)},
            {"clipped_share", i.clipped_share},
            {"largest_jump", i.largest_jump},
            {"largest_jump_frame", i.largest_jump_frame},
            {"crop", json_of(i.crop)},
            {"crop_sentence", i.crop_sentence},
            {"verdict", to_string(i.verdict)},
            {"verdict_sentence", i.verdict_sentence},
            {"findings", json_of(i.findings)}};
}

Json json_of(const Observation& o) {
    Json lost = nullptr;
    if (o.decode.lost > 0) {
        lost = {
            {"frames", o.decode.lost}, {"first", o.decode.first_lost}, {"reason", o.decode.reason}};
    }
    return {{"input", {{"name", o.source_name}, {"sha256", o.source_sha256}}},
            {"axis",
             {{"units", o.axis.units},
              {"samples", o.axis.samples},
              {"samples_per_unit", o.axis.samples_per_unit},
              {"seconds_per_unit", o.axis.seconds_per_unit}}},
            {"kept_samples", o.samples.size()},
            {"width", o.width()},
            {"height", o.height()},
            {"crop",
             {{"rect", json_of(o.crop.rect)},
              {"fills_frame", o.crop.fills_frame},
              {"area_share", o.crop.area_share},
              {"sentence", o.crop.sentence}}},
            {"noise",
             {{"sigma", o.noise.sigma},
              {"tau", o.noise.tau},
              {"tau_origin", o.noise.tau_given ? "given" : "measured"}}},
            {"frames_decoded", o.decode.decoded},
            {"lost", lost},
            {"notes", json_of(o.notes)}};
}

Json json_of(const Forecast& f) {
    Json j = {{"forecaster", f.forecaster},
              {"explanation", f.explanation},
              {"context", f.context_length},
              {"kind", f.is_trajectory() ? "trajectory" : "frames"},
              {"guards", json_of(f.guards)}};
    if (f.is_trajectory()) {
        j["order"] = f.trajectory.law.order;
        j["clamp"] = f.trajectory.clamp;
    }
    return j;
}

Json json_of(const ObserveArguments& arguments) {
    const ObserveOptions o = arguments.options();
    Json crop = "auto";
    if (o.crop.mode == CropMode::none) crop = "none";
    if (o.crop.mode == CropMode::manual) crop = json_of(o.crop.rect);
    return {{"crop", crop},
            {"size", o.size == 0 ? Json("native") : Json(o.size)},
            {"units", o.units ? Json(*o.units) : Json("auto")},
            {"tau", o.tau ? Json(*o.tau) : Json("measured")},
            {"trim", o.trim},
            {"keep", o.keep == Keep::every_sample ? "every_sample" : "unit_steps"},
            {"assume_matrix", arguments.assume_matrix.empty() ? "auto" : arguments.assume_matrix},
            {"assume_range", arguments.assume_range.empty() ? "auto" : arguments.assume_range}};
}

Json json_of(const ForecastArguments& a) {
    return {{"context", a.context}, {"horizons", a.sorted_horizons()}, {"forecaster", a.forecaster},
            {"ridge_k", a.ridge_k}, {"fit_pixels", a.fit_pixels},      {"clamp", !a.no_clamp}};
}

Json json_of(const MaterialArguments& arguments) {
    const MaterialOptions& o = arguments.options;
    return {{"clean_state", arguments.clean_state},
            {"coverage_exponent", o.coverage_exponent},
            {"normalizer_percentile", o.normalizer_percentile},
            {"roughness_clean", o.roughness_clean},
            {"roughness_patina", o.roughness_patina},
            {"roughness_gamma", o.roughness_gamma},
            {"micro_roughness", o.micro_roughness},
            {"micro_range", o.micro_range},
            {"micro_sigma", o.micro_sigma},
            {"metallic_patina", o.metallic_patina},
            {"metallic_clean", o.metallic_clean},
            {"metallic_gamma", o.metallic_gamma},
            {"height_patina_weight", o.height_patina_weight},
            {"height_sigma", o.height_sigma},
            {"normal_scale", o.normal_scale},
            {"normal_gain", o.normal_gain},
            {"reference_horizon", o.reference_horizon}};
}

}  // namespace verdigris::cli
