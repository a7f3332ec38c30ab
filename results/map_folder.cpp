// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "results/map_folder.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "datasets/map_server.hpp"
#include "results/belief_tiff.hpp"

namespace credo::results {
namespace {

/// ln of the commonalities of a normalised mass; what is not positive is set to the smallest that a float holds.
evidence::FixedLogCommonality cell_of(const std::array<float, 4>& pixel) {
  constexpr double kLeast = 1e-38;
  const double empty = pixel[0], occupied = pixel[1], unknown = std::max<double>(pixel[3], kLeast);
  const auto log_q = [](double q) { return std::min(0.0, std::log(q)); };
  return evidence::quantise({log_q(empty + unknown), log_q(occupied + unknown), log_q(unknown)});
}

}  // namespace

grids::EvidentialGrid read_map_folder(const std::filesystem::path& folder) {
  const datasets::OccupancyMap where = datasets::read_map(folder / "map.yaml");
  const BeliefImage image = read_belief_tiff(folder / "map_belief.tiff");
  if (image.width != where.width || image.height != where.height) {
    throw std::runtime_error((folder / "map_belief.tiff").string() + ": is " + std::to_string(image.width) + " x " +
                             std::to_string(image.height) + ", but map.yaml says " + std::to_string(where.width) +
                             " x " + std::to_string(where.height));
  }
  grids::EvidentialGrid grid(
      {.resolution_m = where.resolution_m, .origin_x_m = where.origin_x_m, .origin_y_m = where.origin_y_m});
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      const auto& pixel =
          image.pixels[static_cast<std::size_t>(image.height - 1 - row) * static_cast<std::size_t>(image.width) +
                       static_cast<std::size_t>(column)];
      const double sum = pixel[0] + pixel[1] + pixel[3], least = std::min({pixel[0], pixel[1], pixel[3]});
      if (!(std::abs(sum - 1.0) < 1e-3 && least >= 0.0)) {
        throw std::runtime_error(
            (folder / "map_belief.tiff").string() +
            ": empty, occupied and unknown are no shares that sum to 1: was it written with --readout raw?");
      }
      const evidence::FixedLogCommonality cell = cell_of(pixel);
      if (cell != evidence::FixedLogCommonality{}) grid.add({column, row}, cell);
    }
  }
  return grid;
}

}  // namespace credo::results
