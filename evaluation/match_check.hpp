// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>

#include "evaluation/proportion.hpp"
#include "localization/integrity_monitor.hpp"
#include "localization/landmark_map.hpp"
#include "localization/pose_solver.hpp"
#include "perception/scene.hpp"

namespace credo::evaluation {

struct MatchCheckParams {
  double sigmas = 5.0;  ///< of the observation; and by more than
  double angle_deg = 1.0;
  double distance_m = 0.1;
  localization::IntegrityParams classes = {};  ///< whose classes of belief the matches are counted in
};

/// Accepted matches of what was seen with landmarks, and how many of them are wrong.
struct MatchCounts {
  long matches = 0;
  long wrong = 0;

  [[nodiscard]] double wrong_share() const {
    return matches > 0 ? static_cast<double>(wrong) / static_cast<double>(matches) : 0.0;
  }
  /// The same share with its interval.
  [[nodiscard]] Proportion wrong_among_all() const {
    return {.count = static_cast<std::size_t>(wrong), .of = static_cast<std::size_t>(matches)};
  }
  MatchCounts& operator+=(const MatchCounts& other) {
    matches += other.matches;
    wrong += other.wrong;
    return *this;
  }
  friend bool operator==(const MatchCounts&, const MatchCounts&) = default;
};

/// The same by the classes in which the integrity monitor has its fault priors (localization::fault_class).
struct ClassedMatchCounts {
  std::array<MatchCounts, localization::kFaultClasses> classes{};

  [[nodiscard]] MatchCounts total() const;
  /// All but the walls.
  [[nodiscard]] MatchCounts points() const;
  ClassedMatchCounts& operator+=(const ClassedMatchCounts& other);
};

/// As tables call a class: "points_from_0.99", by the BetP(YES) of their tracks, up to where the next class begins; and
/// "walls".
[[nodiscard]] std::string fault_class_name(std::size_t fault_class, const localization::IntegrityParams& params = {});

/// Whether azimuth or range of a landmark, predicted from the true pose, differs from the observation by more than
/// `sigmas` standard deviations of the two together (the observation's and the plan's) and by more than `angle_deg` or
/// `distance_m`. Of a wall it is the direction of its line and the distance across it.
/// \param T_map_base  the true pose at the time of the scene
[[nodiscard]] bool is_wrong_match(const perception::Primitive& seen, const Eigen::Vector2d& camera_origin,
                                  const localization::LandmarkMap& map, tracking::LandmarkId landmark,
                                  const geometry::Pose2& T_map_base, const MatchCheckParams& params = {});

/// Over the matches that a pose rests on; what the solver has rejected is not accepted and does not count, nor what is
/// matched to a track without a landmark.
/// \param beliefs  of each observation: BetP(YES) that its track exists; empty: none is told, and all points are counted
///   in the class of the least believed
[[nodiscard]] ClassedMatchCounts check_matches(const perception::Scene& scene,
                                               std::span<const localization::Observation> observations,
                                               const localization::PoseSolution& solution,
                                               std::span<const double> beliefs, const localization::LandmarkMap& map,
                                               const geometry::Pose2& T_map_base, const MatchCheckParams& params = {});

}  // namespace credo::evaluation
