// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "apps/picture_folder.hpp"
#include "apps/pipeline.hpp"

namespace credo::apps {

/// The pictures of a run: some acquisitions, evenly over the drive, and what sums it up.
class RunPictures {
 public:
  /// \param moments  how many acquisitions are drawn
  RunPictures(PictureFolder folder, const datasets::Dataset& dataset, int moments);

  /// omni_K.png, scan_K.png and plan_K.png, if acquisition K is one of those that are drawn.
  void draw(const Step& step) const;
  /// beliefs.png, the map's pictures (results::write_map_pictures), and errors.png where there is a truth.
  void draw_summary(const Outcome& outcome) const;
  /// Puts all into their place.
  void publish() const { folder_.publish(); }

 private:
  PictureFolder folder_;
  const datasets::Dataset* dataset_;
  int moments_;
};

}  // namespace credo::apps
