// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <optional>

#include "evidence/believed.hpp"
#include "geometry/pose.hpp"
#include "sensors/motion_path.hpp"

namespace credo::localization {

/// A pose at an acquisition, with the belief in it.
struct Fix {
  sensors::Timestamp time = 0;
  geometry::PoseEstimate estimate;
  evidence::BinaryMass belief = evidence::BinaryMass::vacuous();
};

/// The two latest fixes and the path that the robot took between them and after: the pose at any time.
class PoseHistory {
 public:
  /// The path from the latest fix to the next one and on, in any frame.
  void follow(const sensors::MotionPath& path) { path_ = path; }
  void add(const Fix& fix);
  /// What was before says nothing of what comes: the robot was somewhere else than was thought.
  void forget();

  [[nodiscard]] bool empty() const { return !latest_; }
  /// Precondition: !empty().
  [[nodiscard]] const Fix& latest() const { return *latest_; }
  [[nodiscard]] const std::optional<Fix>& before() const { return before_; }

  /// Between the two fixes what the path misses of the later one is spread over the way, the covariance goes from one
  /// to the other, and the weaker belief holds; elsewhere the latest fix is carried along the path.
  /// Precondition: !empty().
  [[nodiscard]] evidence::Believed<geometry::PoseEstimate> pose_at(sensors::Timestamp time) const;

 private:
  std::optional<Fix> before_;
  std::optional<Fix> latest_;
  sensors::MotionPath path_;
};

}  // namespace credo::localization
