// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "localization/localization.hpp"
#include "perception/scene.hpp"
#include "tracking/track.hpp"

namespace credo::results {

/// A track at one moment, without its geometry.
struct TrackSample {
  int id = 0;
  perception::PrimitiveType type = perception::PrimitiveType::kOther;
  evidence::BinaryMass existence;
  tracking::TrackState state = tracking::TrackState::kTracked;
  tracking::LandmarkId landmark = tracking::kNoLandmark;
};

/// What of an acquisition is kept for the pictures and the summary of a run.
struct Moment {
  localization::Localization localization;
  std::vector<TrackSample> tracks;
  double mean_conflict = 0.0;  ///< of the five criteria, over the segments of the scene
  std::optional<geometry::Pose2> truth;
};

using History = std::vector<Moment>;

[[nodiscard]] std::vector<TrackSample> sample(std::span<const tracking::Track> tracks);

/// How much the five criteria of the segments contradict each other (Clerentin et al., sec. 3.1 report a mean of 0.13).
class ConflictStatistics {
 public:
  static constexpr std::array<const char*, 5> kCriteria{"alignment", "support", "density", "end points", "grey levels"};

  void add(const perception::Scene& scene);

  [[nodiscard]] long segments() const { return segments_; }
  /// Mean of the conflict that was moved to ignorance; 0 without segments.
  [[nodiscard]] double mean() const { return segments_ > 0 ? total_ / static_cast<double>(segments_) : 0.0; }
  /// Mean conflict of two criteria alone: m_i(YES) m_j(NO) + m_i(NO) m_j(YES).
  [[nodiscard]] double of_pair(std::size_t i, std::size_t j) const {
    return segments_ > 0 ? pairs_[i][j] / static_cast<double>(segments_) : 0.0;
  }

 private:
  long segments_ = 0;
  double total_ = 0.0;
  std::array<std::array<double, 5>, 5> pairs_{};
};

}  // namespace credo::results
