// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/ego_poses.hpp"

#include "apps/interrupt.hpp"
#include "apps/terminal.hpp"

namespace credo::apps {

std::vector<datasets::TimedPose> ego_poses(const datasets::Dataset& dataset, evaluation::LineFinder lines) {
  Progress progress("following " + dataset.header.name);
  return evaluation::ego_trajectory(dataset, lines, [&](double share) {
    Interruptible::check();
    progress.update(share);
  });
}

}  // namespace credo::apps
