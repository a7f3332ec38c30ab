// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <memory>
#include <vector>

#include "perception/scene.hpp"
#include "sensors/omni_camera.hpp"

namespace credo::perception {

struct RadialLineParams {};  // the owner of this file fills it

/// Finds the radial lines of omnidirectional images and reads the grey-level curve, straight from the annulus through a
/// table that is made once for a camera.
class RadialLineExtractor {
 public:
  explicit RadialLineExtractor(const sensors::OmniCamera& camera, const RadialLineParams& params = {});
  ~RadialLineExtractor();
  RadialLineExtractor(RadialLineExtractor&&) noexcept;
  RadialLineExtractor& operator=(RadialLineExtractor&&) noexcept;

  /// Fills Scene::radial_lines, gray, camera_seen and saturated_share.
  void extract(const sensors::OmniImage& image, Scene& scene);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace credo::perception
