// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/pipeline.hpp"

#include "apps/poses_by_hand.hpp"
#include "apps/terminal.hpp"
#include "datasets/acquisitions.hpp"
#include "evaluation/localization_score.hpp"

namespace credo::apps {
namespace {

void insert_ranges(mapping::Mapper& mapper, mapping::Freshness& freshness, const localization::Localizer& localizer,
                   const sensors::Acquisition& acquisition) {
  const auto insert = [&](const auto& reading) {
    const auto pose = localizer.pose_at(reading.time);
    mapper.insert(pose, reading, acquisition.path, freshness.of_next(reading, pose.value.pose));
  };
  for (const auto& sweep : acquisition.sonar) insert(sweep);
  for (const auto& scan : acquisition.scans) insert(scan);
}

}  // namespace

PipelineParams PipelineParams::of(perception::Method method) {
  PipelineParams params;
  params.observer.method = method;
  params.localizer = params.localizer.with_method(method);
  return params;
}

Outcome run(const datasets::Dataset& dataset, const PipelineParams& params,
            const std::function<void(const Step&)>& after_each) {
  const datasets::DatasetHeader& header = dataset.header;
  const datasets::Acquisitions acquisitions(dataset);
  perception::Observer observer(header.rig, params.observer);
  localization::Localizer localizer(header.floor_plan.value_or(geometry::FloorPlan{}), header.rig, header.initial_pose,
                                    params.localizer);
  mapping::Mapper mapper(header.rig, params.mapper);
  mapping::Freshness freshness(params.mapper.freshness);
  PosesByHand by_hand(dataset, acquisitions.times(), params.poses_by_hand);
  Outcome outcome;
  double busy = 0.0;
  for (std::size_t i = 0; i < acquisitions.size(); ++i) {
    sensors::Acquisition acquisition = acquisitions.read(i);
    const Stopwatch watch;
    localizer.with_path(acquisition);
    if (const auto pose = by_hand.next(acquisition)) localizer.set_pose(*pose);
    const perception::Scene& scene = observer.observe(acquisition);
    const localization::Localization fix = localizer.update(scene, acquisition.motion);
    busy += watch.seconds();
    insert_ranges(mapper, freshness, localizer, acquisition);
    outcome.conflict.add(scene);
    outcome.without_image += header.rig.camera && !scene.camera_seen ? 1 : 0;
    outcome.without_scan += !header.rig.range_finders.empty() && !scene.range_finder_seen ? 1 : 0;
    const auto truth = evaluation::truth_at(dataset.truth, fix.time);
    if (truth && fix.status != localization::Status::kInitializing) {
      outcome.matches += evaluation::check_matches(scene, localizer.observations(), localizer.solution(),
                                                   localizer.landmark_beliefs(), localizer.map(), *truth)
                             .total();
    }
    outcome.history.push_back({.localization = fix,
                               .tracks = results::sample(localizer.tracks()),
                               .mean_conflict = scene.mean_conflict,
                               .truth = truth});
    after_each({i, acquisitions.size(), acquisition, scene, fix, localizer, outcome.history});
  }
  if (acquisitions.size() > 0) {
    sensors::Acquisition rest = acquisitions.trailing();
    localizer.with_path(rest);
    insert_ranges(mapper, freshness, localizer, rest);
    outcome.seconds_per_acquisition = busy / static_cast<double>(acquisitions.size());
  }
  outcome.calibration = localizer.calibration();
  outcome.mapped = mapper.counts();
  outcome.map = mapper.take_grid();
  return outcome;
}

}  // namespace credo::apps
