// SPDX-License-Identifier: MIT
// What a recording cannot show and a simulation knows, on disk.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "verdigris/files/npy.h"
#include "verdigris/files/staged_folder.h"
#include "verdigris/simulate/simulate.h"

namespace verdigris {

/// Into a folder, which appears whole on commit():
///   susceptibility.npy/.exr   rho as the camera sees it, (H, W) float32, 0 off the specimen
///   light.npy                 lamp times brushing on the specimen, the same shape
///   wetness.npy               the same of the wetness
///   specimen.npy, mount.npy, reference.npy   masks, (H, W) uint8, 255 inside
///   cells/*.npy               on the cells: susceptibility, wetness (rows, columns);
///                             coverage, film_nm, patina_um (T, rows, columns), units (T,)
///   gains.csv                 what multiplied and shifted each frame
///   truth.json                index: shapes, units of measure, where the cells lie in the frame
class TruthWriter {
  public:
    /// Throws Error{failed}: no permission, disk full.
    TruthWriter(const SimulationSpec& spec, const std::filesystem::path& folder);
    /// Give it to SimulationSinks::state.
    void add(const Specimen& specimen);
    /// `recording` is the name the index shows. Throws Error{failed}.
    void commit(const SimulationResult& result, const std::string& recording);

  private:
    void write_maps(const Specimen& specimen);

    SimulationSpec spec_;
    StagedFolder folder_;
    std::unique_ptr<NpyWriter> coverage_, film_, patina_;
    std::vector<double> units_;
    CellGrid grid_;
    Scene::Affine from_frame_{};
};

}  // namespace verdigris
