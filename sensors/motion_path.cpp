// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sensors/motion_path.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace credo::sensors {

MotionPath::MotionPath(std::vector<OdometryReading> rows) : rows_(std::move(rows)) {
  std::size_t kept = 0;
  for (const OdometryReading& row : rows_) {
    const geometry::Pose2& p = row.T_odom_base;
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.theta))
      throw std::invalid_argument("the pose at " + std::to_string(row.time) + " ns is not finite");
    if (kept > 0 && row.time < rows_[kept - 1].time)
      throw std::invalid_argument("the time " + std::to_string(row.time) + " ns comes after " +
                                  std::to_string(rows_[kept - 1].time) + " ns: sort the rows by time");
    if (kept > 0 && row.time == rows_[kept - 1].time) --kept;
    rows_[kept++] = row;
  }
  rows_.resize(kept);
}

geometry::Pose2 MotionPath::pose_at(Timestamp time) const {
  if (rows_.empty()) return {};
  if (rows_.size() == 1) return rows_.front().T_odom_base;
  time = std::clamp(time, rows_.front().time - kLongestExtrapolation, rows_.back().time + kLongestExtrapolation);
  const auto after = std::upper_bound(rows_.begin() + 1, rows_.end() - 1, time,
                                      [](Timestamp t, const OdometryReading& row) { return t < row.time; });
  const OdometryReading& a = *(after - 1);
  const OdometryReading& b = *after;
  return geometry::interpolate(a.T_odom_base, b.T_odom_base,
                               static_cast<double>(time - a.time) / static_cast<double>(b.time - a.time));
}

}  // namespace credo::sensors
