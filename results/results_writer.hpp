// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "grids/evidential_grid.hpp"
#include "localization/localization.hpp"
#include "perception/scene.hpp"
#include "results/localization_table.hpp"
#include "results/map_folder.hpp"
#include "tracking/track.hpp"

namespace credo::results {

/// Writes what a run leaves behind (docs/dataset-format.md, "Results") into a folder that appears whole or not at all.
class ResultsWriter {
 public:
  /// \throws std::runtime_error as stage_results
  ResultsWriter(const std::filesystem::path& target, bool replace);
  ~ResultsWriter();
  ResultsWriter(ResultsWriter&&) noexcept;
  ResultsWriter& operator=(ResultsWriter&&) noexcept;

  /// One acquisition: a row of trajectory.tum and of localization.csv, and the rows of the other tables.
  void add(const perception::Scene& scene, const localization::Localization& localization,
           std::span<const tracking::Track> tracks);
  /// The files of write_map_folder(). \returns as that
  bool add_map(const grids::EvidentialGrid& grid, const MapFolderParams& params = {});
  void add_config(const std::string& yaml);
  /// calibration.yaml
  void add_calibration(const std::string& yaml);

  /// Where further files (pictures) may be put before finish().
  [[nodiscard]] const std::filesystem::path& working_folder() const;

  /// Writes the tables and gives the folder its place. Nothing may be added afterwards.
  /// \throws std::runtime_error if a file could not be written whole
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace credo::results
