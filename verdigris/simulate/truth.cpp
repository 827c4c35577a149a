// SPDX-License-Identifier: MIT
#include "verdigris/simulate/truth.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "verdigris/files/atomic_file.h"
#include "verdigris/files/csv.h"
#include "verdigris/files/image_file.h"

namespace verdigris {
namespace {
using Json = nlohmann::ordered_json;

std::vector<float> floats(const Image<double>& cells) {
    return {cells.pixels().begin(), cells.pixels().end()};
}

void append(NpyWriter& writer, const Image<double>& cells) {
    const std::vector<float> values = floats(cells);
    writer.append(std::as_bytes(std::span(values)));
}

template <class T>
void write_plane(const std::filesystem::path& path, NpyType type, const Image<T>& plane) {
    write_npy(path, type, {std::size_t(plane.height()), std::size_t(plane.width())},
              std::as_bytes(std::span(plane.pixels())));
}

std::string number(double v) {
    return fmt::format("{:.9g}", v);
}

}  // namespace

TruthWriter::TruthWriter(const SimulationSpec& spec, const std::filesystem::path& folder)
    : spec_(spec), folder_(folder), grid_(specimen_grid(spec)) {
    const std::vector<std::size_t> shape{std::size_t(grid_.rows), std::size_t(grid_.columns)};
    const auto path = folder_.path() / "cells";
    coverage_ = std::make_unique<NpyWriter>(path / "coverage.npy", NpyType::f32, shape);
    film_ = std::make_unique<NpyWriter>(path / "film_nm.npy", NpyType::f32, shape);
    patina_ = std::make_unique<NpyWriter>(path / "patina_um.npy", NpyType::f32, shape);
}

void TruthWriter::add(const Specimen& specimen) {
    if (units_.empty()) write_maps(specimen);
    units_.push_back(specimen.unit());
    append(*coverage_, specimen.coverage());
    append(*film_, specimen.film_nm());
    append(*patina_, specimen.patina_um());
}

void TruthWriter::write_maps(const Specimen& specimen) {
    const auto& to = folder_.path();
    const std::vector<std::size_t> shape{std::size_t(grid_.rows), std::size_t(grid_.columns)};
    const auto cells = [&](const char* name, const Image<double>& map) {
        const std::vector<float> values = floats(map);
        write_npy(to / "cells" / name, NpyType::f32, shape, std::as_bytes(std::span(values)));
    };
    cells("susceptibility.npy", specimen.susceptibility());
    cells("wetness.npy", specimen.wetness());
    const Scene scene(spec_, grid_);
    from_frame_ = scene.specimen_from_frame();
    write_plane(to / "light.npy", NpyType::f32, scene.light());
    const Image<float> rho = scene.seen(specimen.susceptibility());
    write_plane(to / "susceptibility.npy", NpyType::f32, rho);
    write_exr(to / "susceptibility.exr", rho);
    write_plane(to / "wetness.npy", NpyType::f32, scene.seen(specimen.wetness()));
    write_plane(to / "specimen.npy", NpyType::u8, scene.specimen());
    write_plane(to / "mount.npy", NpyType::u8, scene.mount());
    write_plane(to / "reference.npy", NpyType::u8, scene.reference());
}

void TruthWriter::commit(const SimulationResult& result, const std::string& recording) {
    coverage_->commit();
    film_->commit();
    patina_->commit();
    const auto& to = folder_.path();
    write_npy(to / "cells" / "units.npy", NpyType::f64, {units_.size()},
              std::as_bytes(std::span(units_)));

    CsvTable gains;
    gains.header = {"frame", "unit"};
    for (const char* name :
         {"linear_r", "linear_g", "linear_b", "exposure", "light", "jitter", "balance_r",
          "balance_g", "balance_b", "flicker_phase", "encoded_gain_r", "encoded_gain_g",
          "encoded_gain_b", "encoded_offset_r", "encoded_offset_g", "encoded_offset_b"}) {
        gains.header.emplace_back(name);
    }
    for (std::size_t i = 0; i < result.gains.size(); ++i) {
        const FrameGains& g = result.gains[i];
        std::vector<std::string> row{std::to_string(i), number(g.unit)};
        const auto add = [&](std::span<const double> values) {
            for (const double v : values) row.push_back(number(v));
        };
        add(g.linear);
        add(std::array{g.exposure, g.light, g.jitter});
        add(g.balance);
        add(std::array{g.flicker_phase});
        add(g.encoded_gain);
        add(g.encoded_offset);
        gains.rows.push_back(std::move(row));
    }
    write_csv(to / "gains.csv", gains);

    const Scene::Affine& m = from_frame_;
    const auto file = [](const char* name, const char* meaning, Json shape) {
        return Json{{"file", name}, {"meaning", meaning}, {"shape", std::move(shape)}};
    };
    const Json frame = {spec_.frames.height, spec_.frames.width};
    const Json cell = {grid_.rows, grid_.columns};
    const Json cell_t = {units_.size(), grid_.rows, grid_.columns};
    const Json index = {
        {"recording", recording},
        {"simulated", true},
        {"preset", spec_.preset},
        {"seed", spec_.seed},
        {"specimen_seed", spec_.pattern_seed()},
        {"frames", spec_.frames.count},
        {"units", spec_.frames.units},
        {"flicker", {{"amplitude", spec_.camera.flicker}, {"bands", spec_.camera.flicker_bands}}},
        {"arrays",
         {file("light.npy",
               "lamp times brushing on the specimen: linear light is this times the "
               "color of the cells, plus the sheen",
               frame),
          file("susceptibility.npy", "rho as the camera sees it, mean 1 over the cells", frame),
          file("susceptibility.exr", "the same", frame),
          file("wetness.npy", "wetness as the camera sees it, mean 1 over the cells", frame),
          file("specimen.npy", "255 where the specimen fills at least half of a pixel", frame),
          file("mount.npy", "255 where the mount does", frame),
          file("reference.npy", "255 on backdrop away from specimen and mount", frame),
          file("cells/units.npy", "times of the states below, accelerated units",
               Json{units_.size()}),
          file("cells/susceptibility.npy", "rho", cell), file("cells/wetness.npy", "wetness", cell),
          file("cells/coverage.npy", "theta, share of a cell whose film grows, 0 to 1", cell_t),
          file("cells/film_nm.npy", "thickness of the oxide, nm", cell_t),
          file("cells/patina_um.npy", "thickness of the green layer, um", cell_t),
          file("gains.csv", "what multiplied linear light and shifted encoded values, per frame",
               Json{result.gains.size()})}},
        // Cell (column, row) of pixel (x, y), centers at +0.5: the specimen's coordinates over the
        // side of a cell, less a half.
        {"specimen_from_frame", {{m.a, m.b, m.c}, {m.d, m.e, m.f}}},
        {"cell_side", grid_.cell},
        {"cells", {{"columns", grid_.columns}, {"rows", grid_.rows}}},
    };
    write_file(to / "truth.json", index.dump(2) + "\n");
    folder_.commit("truth.json");
}

}  // namespace verdigris
