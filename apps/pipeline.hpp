// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <functional>

#include "datasets/dataset.hpp"
#include "evaluation/match_check.hpp"
#include "localization/localizer.hpp"
#include "mapping/mapper.hpp"
#include "perception/observer.hpp"
#include "results/history.hpp"

namespace credo::apps {

struct PipelineParams {
  perception::ObserverParams observer;
  localization::LocalizerParams localizer;
  mapping::MapperParams mapper;
  std::vector<datasets::TimedPose> poses_by_hand;  ///< each known as well as the dataset's initial pose

  /// The parameters of a method, each part told.
  [[nodiscard]] static PipelineParams of(perception::Method method);
};

/// What the main job has after one acquisition.
struct Step {
  std::size_t index = 0;
  std::size_t count = 0;  ///< of all acquisitions
  const sensors::Acquisition& acquisition;
  const perception::Scene& scene;
  const localization::Localization& fix;
  const localization::Localizer& localizer;
  const results::History& history;  ///< this moment included
};

/// What it leaves at the end.
struct Outcome {
  results::History history;
  results::ConflictStatistics conflict;
  evaluation::MatchCounts matches;  ///< against the truth, where there is one
  mapping::MappingCounts mapped;
  grids::EvidentialGrid map;
  int without_image = 0;                     ///< acquisitions, of a robot with a camera
  int without_scan = 0;                      ///< of a robot with a range finder
  localization::RigCalibration calibration;  ///< learned by the end
  double seconds_per_acquisition = 0.0;      ///< from decoded acquisition to localization, without mapping
};

/// The main job: every acquisition of a dataset from perception to the map.
[[nodiscard]] Outcome run(const datasets::Dataset& dataset, const PipelineParams& params,
                          const std::function<void(const Step&)>& after_each);

}  // namespace credo::apps
