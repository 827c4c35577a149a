// SPDX-License-Identifier: MIT
// manifest.json: how all of it came to be, so that a delivery can be checked and made again.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "verdigris/deliver/delivery.h"

namespace verdigris {

/// manifest.json: resolved options, input hash, version, noise, guards, per-map origin, files.
///
///   {"format": "verdigris-manifest/1", "version": ..., <facts in their order>, "title", "stem",
///    "forecaster", "explanation", "context", "units_observed", "unit", "horizons": [...],
///    "uncertainty": [{"horizon", "mean_80", "mean_95", "pixel_80", "pixel_95"}] or null,
///    "guards": [{"id", "severity", "sentence"}], "origins": [{"map", "origin", "sentence"}],
///    "noise": {"tau"}, "files": [{"path", "bytes", "sha256"}]}
///
/// `files` are relative to the manifest's folder (or absolute, then made relative to it), and are
/// listed in the given order. A fact named "noise" replaces the default one; a fact with any other
/// name of the schema is left out. No time of day: same delivery, same bytes.
/// Throws Error{failed} (a fact that is not JSON, disk full), Error{bad_input} (a missing file).
void write_manifest(const Delivery& delivery, const std::vector<std::filesystem::path>& files,
                    const std::filesystem::path& file);

}  // namespace verdigris
