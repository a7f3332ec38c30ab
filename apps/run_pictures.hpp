// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <filesystem>

#include "apps/pipeline.hpp"

namespace credo::apps {

/// The pictures of a run: some acquisitions, evenly over the drive, and what sums it up.
class RunPictures {
 public:
  /// \param folder  is made; \param moments  how many acquisitions are drawn
  /// \throws std::runtime_error if the folder cannot be made
  RunPictures(std::filesystem::path folder, const datasets::Dataset& dataset, int moments);

  /// omni_K.png, scan_K.png and plan_K.png, if acquisition K is one of those that are drawn.
  void draw(const Step& step) const;
  /// beliefs.png, map.png, and errors.png where there is a truth.
  void draw_summary(const Outcome& outcome) const;

 private:
  std::filesystem::path folder_;
  const datasets::Dataset* dataset_;
  int moments_;
};

}  // namespace credo::apps
