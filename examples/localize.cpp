// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

// Localizes and maps one dataset: `localize DATASET`. Prints a line for each acquisition.

#include <iostream>

#include "datasets/acquisitions.hpp"
#include "localization/localizer.hpp"
#include "mapping/mapper.hpp"
#include "perception/observer.hpp"

using namespace credo;

int main(int argc, char** argv) try {
  if (argc != 2) return std::cerr << "usage: localize DATASET\n", 2;
  const auto dataset = datasets::Dataset::open(argv[1]);
  const auto& robot = dataset.header;
  perception::Observer observer(robot.rig);
  localization::Localizer localizer(robot.floor_plan.value_or(geometry::FloorPlan{}), robot.rig, robot.initial_pose);
  mapping::Mapper mapper(robot.rig);

  for (sensors::Acquisition acquisition : datasets::Acquisitions(dataset)) {
    localizer.with_path(acquisition);
    const perception::Scene& scene = observer.observe(acquisition);
    const localization::Localization fix = localizer.update(scene, acquisition.motion);
    for (const auto& sweep : acquisition.sonar) mapper.insert(localizer.pose_at(sweep.time), sweep);
    std::cout << fix << '\n';  // pose, covariance, belief, status: never a bare pose
  }
} catch (const std::exception& error) {
  std::cerr << "localize: " << error.what() << '\n';
  return 1;
}
