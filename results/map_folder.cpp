// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "results/map_folder.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "datasets/grid_file.hpp"

namespace credo::results {
namespace {

/// ln of the commonalities of a normalised mass; what is not positive is set to the smallest that a float holds.
evidence::FixedLogCommonality cell_of(const std::array<float, 4>& pixel) {
  constexpr double kLeast = 1e-38;
  const double empty = pixel[0], occupied = pixel[1], unknown = std::max<double>(pixel[3], kLeast);
  const auto log_q = [](double q) { return std::min(0.0, std::log(q)); };
  return evidence::quantise({log_q(empty + unknown), log_q(occupied + unknown), log_q(unknown)});
}

grids::EvidentialGrid read_pictures(const std::filesystem::path& folder) {
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

}  // namespace

bool write_map_folder(const grids::EvidentialGrid& grid, const std::filesystem::path& folder,
                      const MapFolderParams& params) {
  datasets::write_grid(grid, folder / "map.cgrid");
  if (!grids::fits_a_picture(grid.bounding_box())) return false;
  datasets::write_map(params.mode == datasets::MapMode::kTrinary ? datasets::to_occupancy(grid, params.decision)
                                                                 : datasets::to_probabilities(grid, params.decision),
                      folder / "map.yaml", params.mode);
  write_belief_tiff(belief_image(grid, params.channels), folder / "map_belief.tiff");
  return true;
}

grids::EvidentialGrid read_map_folder(const std::filesystem::path& folder) {
  const std::filesystem::path whole = folder / "map.cgrid";
  return std::filesystem::exists(whole) ? datasets::GridFile(whole).read() : read_pictures(folder);
}

}  // namespace credo::results
