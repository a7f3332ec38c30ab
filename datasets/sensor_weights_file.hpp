// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace credo::datasets {

/// Reads the weights of a calibrated sonar model (docs/dataset-format.md, "Weights of sensor models").
/// \param count  that the model has
/// \throws FormatError with file and line: another number of weights, one that is not finite, an unknown key
[[nodiscard]] std::vector<double> read_sonar_weights(const std::filesystem::path& file, std::size_t count);

/// Writes them, by way of a temporary file beside it. \param source  where they are from, in one line
/// \throws std::runtime_error if the file cannot be written
void write_sonar_weights(const std::filesystem::path& file, std::span<const double> weights, const std::string& source);

/// A calibrated laser model as a file keeps it (docs/dataset-format.md, "Weights of sensor models").
struct LaserModelFile {
  /// Of evidence.
  struct Weights {
    double free_weight = 0.0;
    std::vector<double> hit_weights;
  };

  double free_margin_m = 0.0, free_margin_sigmas = 0.0;
  double half_width_m = 0.0, half_width_sigmas = 0.0;
  Weights summed, alone;
};

/// \param count  of the weights of a hit that the model has
/// \throws FormatError as read_sonar_weights
[[nodiscard]] LaserModelFile read_laser_weights(const std::filesystem::path& file, std::size_t count);
/// As write_sonar_weights.
void write_laser_weights(const std::filesystem::path& file, const LaserModelFile& model, const std::string& source);

}  // namespace credo::datasets
