// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "geometry/floor_plan.hpp"
#include "grids/evidential_grid.hpp"

namespace credo::evaluation {

/// Walls that were extracted from a map against those of the true plan, by length.
struct PlanAccuracy {
  double extracted_m = 0.0;      ///< length of the extracted walls
  double right_m = 0.0;          ///< of it, within the tolerance of a true wall
  double seen_m = 0.0;           ///< length of the true walls that the map saw: it has empty cells within the tolerance
  double found_m = 0.0;          ///< of it, within the tolerance of an extracted wall
  double mean_distance_m = 0.0;  ///< of what is right from the true walls; nan without any

  [[nodiscard]] double precision() const { return extracted_m > 0.0 ? right_m / extracted_m : 0.0; }
  [[nodiscard]] double recall() const { return seen_m > 0.0 ? found_m / seen_m : 0.0; }
};

struct PlanAccuracyParams {
  double tolerance_m = 0.1;  ///< two cells of the usual 5 cm
  double step_m = 0.02;      ///< between the points that stand for a wall
};

/// \param map  the one that the walls were extracted from
/// \throws std::invalid_argument if the true plan has no walls, or the map saw none of them
[[nodiscard]] PlanAccuracy plan_accuracy(const geometry::FloorPlan& extracted, const geometry::FloorPlan& truth,
                                         const grids::EvidentialGrid& map, const PlanAccuracyParams& params = {});

}  // namespace credo::evaluation
