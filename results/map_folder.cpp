// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "results/map_folder.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>

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

/// The masses of a rule: {m(empty), m(occupied), m(conflict), m(unknown)}.
evidence::FixedLogCommonality cell_of_rule(const std::array<float, 4>& pixel) {
  const double sum = static_cast<double>(pixel[0]) + pixel[1] + pixel[2] + pixel[3];  // 1 but for the floats' rounding
  const auto normal = evidence::without_conflict(
      {.empty = pixel[0] / sum, .occupied = pixel[1] / sum, .conflict = pixel[2] / sum, .unknown = pixel[3] / sum});
  if (!normal) return {};
  constexpr double kMost = evidence::FixedLogCommonality::kMaxReliability;
  const double least_unknown = 1.0 - kMost;
  return evidence::fixed_increment(*normal, normal->unknown < least_unknown ? kMost : 1.0);
}

grids::EvidentialGrid read_pictures(const std::filesystem::path& folder) {
  const auto [georeference, image] = read_belief_picture(folder);
  const bool of_rule = is_rule_map(folder);
  grids::EvidentialGrid grid(georeference);
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      const auto& pixel =
          image.pixels[static_cast<std::size_t>(image.height - 1 - row) * static_cast<std::size_t>(image.width) +
                       static_cast<std::size_t>(column)];
      const double conflict = of_rule ? pixel[2] : 0.0;
      const double sum = pixel[0] + pixel[1] + conflict + pixel[3], least = std::ranges::min(pixel);
      if (!(std::abs(sum - 1.0) < 1e-3 && least >= 0.0)) {
        throw std::runtime_error(
            (folder / "map_belief.tiff").string() +
            ": empty, occupied and unknown are no shares that sum to 1: was it written with --readout raw?");
      }
      const evidence::FixedLogCommonality cell = of_rule ? cell_of_rule(pixel) : cell_of(pixel);
      if (cell != evidence::FixedLogCommonality{}) grid.add({column, row}, cell);
    }
  }
  return grid;
}

}  // namespace

BeliefPicture read_belief_picture(const std::filesystem::path& folder) {
  const datasets::OccupancyMap where = datasets::read_map(folder / "map.yaml");
  if (where.origin_yaw_rad != 0.0)
    throw std::runtime_error((folder / "map.yaml").string() + ": the origin's yaw is " +
                             std::to_string(where.origin_yaw_rad) +
                             ": expected 0, as a map of credo map is not turned");
  BeliefPicture picture{
      {.resolution_m = where.resolution_m, .origin_x_m = where.origin_x_m, .origin_y_m = where.origin_y_m},
      read_belief_tiff(folder / "map_belief.tiff")};
  if (picture.image.width != where.width || picture.image.height != where.height)
    throw std::runtime_error((folder / "map_belief.tiff").string() + ": is " + std::to_string(picture.image.width) +
                             " x " + std::to_string(picture.image.height) + ", but map.yaml's picture is " +
                             std::to_string(where.width) + " x " + std::to_string(where.height));
  return picture;
}

bool is_rule_map(const std::filesystem::path& folder) {
  std::ifstream config(folder / "config.yaml");
  for (std::string line; std::getline(config, line);)
    if (line.starts_with("rule: ")) return true;
  return false;
}

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
