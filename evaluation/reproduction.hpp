// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>

#include "evaluation/match_check.hpp"
#include "evaluation/track_life.hpp"
#include "results/history.hpp"

// The measures by which Clerentin et al., "An uncertainty propagation architecture for the localization problem",
// report their experiment.
namespace credo::evaluation {

/// How far a value goes: over runs, over primitives.
struct Spread {
  int count = 0;
  double sum = 0.0;
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();

  void add(double value);
  /// \throws std::logic_error if there are no values
  [[nodiscard]] double mean() const;
};

/// The masses of primitives of one type.
struct MassSpread {
  Spread yes, no, unknown;
  int without_no = 0;  ///< m(NO) = 0, as of all walls of their table 1

  void add(const evidence::BinaryMass& mass);
};

/// One drive of the experiment, by one method, and what was seen on the way.
struct ReproducedDrive {
  results::History history;
  results::ConflictStatistics conflict;
  std::array<MassSpread, 4> masses;  ///< m_prim by PrimitiveType, of primitives with a segment
  MatchCounts matches;               ///< against the truth

  void see(const perception::Scene& scene);
};

struct ReproductionParams {
  double within_m = 0.45;           ///< one and a half steps of the experiment
  int sightings_of_a_landmark = 5;  ///< at least, of a track whose loss is counted: fig. 21 has seven
};

/// What the paper reports, over all drives of one random seed.
struct ReproducedFigures {
  int acquisitions = 0;
  double mean_position_m = 0.0;
  double mean_heading_rad = 0.0;
  Spread within_m;             ///< position errors of the acquisitions up to ReproductionParams::within_m
  double mean_conflict = 0.0;  ///< of the five criteria, over the segments of all sensed maps (sec. 3.1)
  Spread until_lost;           ///< acquisitions from a landmark's last sighting to the loss of its track (fig. 21)
  std::optional<double> wrong_matches;  ///< share of the matches; nothing without any
  int walls_between = 0;                ///< tracks that went on as a wall and back (fig. 22)
  double mean_belief_yes = 0.0;
  /// Probability that m_l(YES) is larger in an acquisition that tracks more landmarks than the median one than in one
  /// that tracks fewer (fig. 23); nothing where all track equally many.
  std::optional<double> belief_follows_tracks;
};

/// Precondition: every moment has a truth.
/// \throws std::logic_error if there is no acquisition
[[nodiscard]] ReproducedFigures reproduced_figures(std::span<const ReproducedDrive> drives,
                                                   const ReproductionParams& params = {});

/// Tracks of an acquisition that are matched and have a landmark.
[[nodiscard]] int landmarks_tracked(const results::Moment& moment);

/// Of the drive's tracks the one whose life is most like that of fig. 21: an edge of the plan that was seen as an edge
/// and without a break in kSightingsOfFigure21 acquisitions, or as near to that as there is one, and was lost then.
[[nodiscard]] std::optional<TrackLife> life_like_figure_21(std::span<const results::Moment> history);
inline constexpr int kSightingsOfFigure21 = 7;

/// The longest life that was a wall in between (fig. 22).
[[nodiscard]] std::optional<TrackLife> life_like_figure_22(std::span<const results::Moment> history);

}  // namespace credo::evaluation
