// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/ego_trajectory.hpp"

#include <optional>
#include <stdexcept>

#include "datasets/acquisitions.hpp"
#include "localization/ego_motion.hpp"
#include "perception/hough_lines.hpp"
#include "perception/observer.hpp"

namespace credo::evaluation {

std::vector<datasets::TimedPose> ego_trajectory(const datasets::Dataset& dataset, LineFinder lines,
                                                const std::function<void(double share)>& progress) {
  sensors::Rig rig = dataset.header.rig;
  rig.camera.reset();
  if (rig.range_finders.empty() && !rig.odometry)
    throw std::runtime_error(dataset.header.name +
                             ": ego-motion needs a range finder or odometry, and there is neither");
  const datasets::Acquisitions acquisitions(dataset);
  perception::Observer observer(rig);
  localization::EgoMotion ego_motion(dataset.header.initial_pose.value_or(geometry::PoseEstimate{}));
  std::vector<datasets::TimedPose> poses;
  poses.reserve(acquisitions.size());
  std::optional<sensors::Timestamp> previous;
  for (const sensors::Timestamp time : acquisitions.times()) {
    const sensors::Acquisition acquisition = datasets::gather(dataset, previous, time, std::nullopt);
    const perception::Scene& scene = observer.observe(acquisition);
    if (lines == LineFinder::kHough && !rig.range_finders.empty())
      ego_motion.update(time, perception::hough_lines(scene.points, {rig.range_finders.front().noise, {}}),
                        acquisition.motion, scene.carry_covariance);
    else
      ego_motion.update(scene, acquisition.motion);
    poses.push_back({time, ego_motion.pose().value.pose});
    previous = time;
    if (progress) progress(static_cast<double>(poses.size()) / static_cast<double>(acquisitions.size()));
  }
  return poses;
}

}  // namespace credo::evaluation
