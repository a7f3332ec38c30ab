// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/run_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "results/pictures.hpp"

namespace credo::apps {
namespace {

/// Whether `index` is one of `wanted` of `count`, the first and the last included.
bool is_drawn(std::size_t index, std::size_t count, int wanted) {
  if (wanted <= 0) return false;
  if (wanted == 1) return index == count / 2;
  const auto n = static_cast<std::size_t>(wanted);
  for (std::size_t k = 0; k < n; ++k) {
    if (index == k * (count - 1) / (n - 1)) return true;
  }
  return false;
}

}  // namespace

RunPictures::RunPictures(PictureFolder folder, const datasets::Dataset& dataset, int moments)
    : folder_(std::move(folder)), dataset_(&dataset), moments_(moments) {}

void RunPictures::draw(const Step& step) const {
  if (!is_drawn(step.index, step.count, moments_)) return;
  const datasets::DatasetHeader& header = dataset_->header;
  const auto file = [&](const char* what) { return folder_.path() / fmt::format("{}_{:04}.png", what, step.index); };
  if (step.acquisition.image && header.rig.camera) {
    results::write_png(file("omni"), results::omni_picture(*step.acquisition.image, *header.rig.camera, step.scene));
  }
  results::write_png(file("scan"), results::scan_picture(step.scene, header.robot_radius_m));
  const geometry::FloorPlan plan = header.floor_plan.value_or(geometry::FloorPlan{});
  results::write_png(file("plan"), results::plan_picture({.plan = plan,
                                                          .landmarks = &step.localizer.map(),
                                                          .history = step.history,
                                                          .tracks = step.localizer.tracks(),
                                                          .robot_radius_m = header.robot_radius_m}));
}

void RunPictures::draw_summary(const Outcome& outcome) const {
  if (outcome.history.empty()) return;
  const bool truth = std::any_of(outcome.history.begin(), outcome.history.end(),
                                 [](const results::Moment& m) { return m.truth.has_value(); });
  if (truth) results::write_png(folder_.path() / "errors.png", results::error_picture(outcome.history));
  results::write_png(folder_.path() / "beliefs.png", results::belief_picture(outcome.history));
  std::vector<geometry::Pose2> way;
  for (const results::Moment& m : outcome.history) way.push_back(m.localization.estimate.pose);
  results::write_map_pictures(folder_.path(), outcome.map, way);
}

}  // namespace credo::apps
