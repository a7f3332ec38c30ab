// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/baseline_localizer.hpp"

#include <algorithm>

namespace credo::evaluation {

geometry::PoseEstimate BaselineMotion::step(const std::optional<geometry::PoseEstimate>& motion,
                                            sensors::Timestamp time) const {
  if (!time_) return {};
  return motion ? *motion : velocity_.predict(sensors::seconds_between(*time_, time));
}

geometry::PoseEstimate BaselineMotion::predict(const std::optional<geometry::PoseEstimate>& motion,
                                               sensors::Timestamp time) const {
  return geometry::compose(latest_, step(motion, time));
}

void BaselineMotion::correct(const geometry::PoseEstimate& estimate, sensors::Timestamp time) {
  if (time_ && time > *time_)
    velocity_.add(latest_.pose.inverse() * estimate.pose, sensors::seconds_between(*time_, time));
  latest_ = estimate;
  time_ = time;
}

localization::Localization baseline_fix(sensors::Timestamp time, const geometry::PoseEstimate& estimate,
                                        double confidence) {
  const double yes = std::clamp(confidence, 0.0, 1.0);
  localization::Localization fix;
  fix.time = time;
  fix.estimate = estimate;
  fix.belief = {.yes = yes, .no = 1.0 - yes, .unknown = 0.0};
  fix.status = localization::Status::kLocalized;
  return fix;
}

}  // namespace credo::evaluation
