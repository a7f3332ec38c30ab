// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/reproduction.hpp"
#include "geometry/floor_plan.hpp"

namespace credo::apps {

/// The experiment of Clerentin et al., sec. 5: the end of a corridor, 42 acquisitions every 30 cm on two ways.
struct ClerentinParams {
  /// Worlds, one for each way. The second way curves gently: the paper extrapolates azimuths, which vary "locally
  /// linear" on its ways, and a turn on the spot is none of these.
  std::vector<std::string> ways{"corridor_end", "corridor_end_curve"};
  std::uint64_t seed = 1;  ///< the first
  int seeds = 10;          ///< one after the other
};

/// All ways of one random seed, by one method.
struct ClerentinRun {
  std::vector<evaluation::ReproducedDrive> drives;  ///< by way
  evaluation::ReproducedFigures figures;
};

struct ClerentinExperiment {
  ClerentinParams params;
  geometry::FloorPlan plan;            ///< of the first seed and way
  std::vector<ClerentinRun> paper;     ///< by seed; `--method paper`
  std::vector<ClerentinRun> standard;  ///< by seed, on the same readings; the default method
};

/// Plays every way with every seed and localizes on the same readings by both methods.
/// \param progress  is told the share of the work that is done
/// \throws std::runtime_error for a world that is not there or cannot be driven
[[nodiscard]] ClerentinExperiment reproduce_clerentin(const ClerentinParams& params,
                                                      const std::function<void(double)>& progress);

/// A track's life, and where it was found.
struct LifeExample {
  std::uint64_t seed = 0;
  std::string way;
  evaluation::TrackLife life;
};

/// Of all runs the life that is most like that of fig. 21; nothing where no edge was lost.
[[nodiscard]] std::optional<LifeExample> life_of_an_edge(const ClerentinParams& params,
                                                         const std::vector<ClerentinRun>& runs);
/// Of all runs the longest life of a track that was a wall in between (fig. 22).
[[nodiscard]] std::optional<LifeExample> life_with_a_wall_between(const ClerentinParams& params,
                                                                  const std::vector<ClerentinRun>& runs);

}  // namespace credo::apps
