// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "evaluation/belief_calibration.hpp"
#include "evaluation/lost_detection.hpp"
#include "evaluation/proportion.hpp"
#include "evaluation/samples.hpp"

namespace credo::evaluation {

/// A number of a localization that may tell whether it is lost.
struct Detector {
  std::string name;
  DetectionCurve curve = {};
};

/// Where an error lies against its protection level (Tossaint et al., The Stanford-ESA integrity diagram, 2007). Only
/// what is offered for use can mislead.
enum class ProtectionRegion {
  kNominal,      ///< error <= level
  kUnavailable,  ///< not localized, or the level is above its limit
  kMisleading,   ///< level < error <= limit
  kHazardous,    ///< level <= limit < error
};
[[nodiscard]] const char* to_string(ProtectionRegion region);

struct ProtectionPoint {
  double error = 0.0;  ///< [m] or [rad], as the level
  double level = 0.0;  ///< the upper end
  ProtectionRegion region = ProtectionRegion::kNominal;
};

/// Of position or of heading: the poses that an integrity monitor has looked at.
struct ProtectionDiagram {
  double limit = 0.0;  ///< largest level that is available
  std::vector<ProtectionPoint> points = {};

  [[nodiscard]] Proportion in(ProtectionRegion region) const;
};

/// What kidnapped robots are asked for. Of all kidnaps: whether a place is decidable is not looked at.
struct KidnapParams {
  int noticed_within = 3;  ///< acquisitions
  int recovered_within = 10;
};

/// How well localizations know whether they are right, pooled over runs. Shares are of the acquisitions with truth;
/// what compares with an error is over those of them that have a pose in the map.
struct Integrity {
  int runs = 0;
  bool events_known = true;  ///< of all runs; else false alerts and alarms are "or less", and kidnaps may be missing
  Proportion placed = {};    ///< acquisitions with a pose in the map
  Proportion lost = {};      ///< of the placed
  std::optional<Proportion> available = {}, misleading = {};  ///< nothing without protection levels
  Proportion false_alert = {};
  Proportion unnoticed = {};             ///< lost acquisitions without an alert
  std::vector<Detector> detectors = {};  ///< the first is BetP(YES)
  std::vector<LostEpisode> episodes = {};
  FalseAlarms false_alarms = {};
  std::vector<Kidnap> kidnaps = {};
  Reliability reliability = {};              ///< of BetP(YES) against not lost
  IntervalCalibration belief_interval = {};  ///< of [Bel, Pl] against not lost
  std::vector<RiskPoint> risk = {};
  ProtectionDiagram position = {}, heading = {};

  [[nodiscard]] Proportion missed_episodes() const;
  /// Nothing where no time has passed.
  [[nodiscard]] std::optional<double> false_alarms_per_hour() const;
  /// Of the kidnaps: those with an alert, or that are recovered without one, by then.
  [[nodiscard]] Proportion noticed(int within_acquisitions) const;
  [[nodiscard]] Proportion recovered(int within_acquisitions) const;  ///< of the kidnaps
};

/// \throws std::invalid_argument if no acquisition of any run has a pose in the map
[[nodiscard]] Integrity integrity(std::span<const EvaluatedRun> runs, const ScoreParams& params = {});

/// A number by the name under which a table or a gate knows it; nothing where there is nothing to measure.
struct NamedFigure {
  const char* name;
  std::optional<double> value;
};
/// Always the same names in the same order.
[[nodiscard]] std::vector<NamedFigure> figures(const Integrity& integrity, const KidnapParams& kidnap = {});

/// The tables with the meaning of their words.
[[nodiscard]] std::string to_text(const Integrity& integrity, const ScoreParams& params = {},
                                  const KidnapParams& kidnap = {});

}  // namespace credo::evaluation
