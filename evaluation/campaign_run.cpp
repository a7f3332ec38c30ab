// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/campaign_run.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "evaluation/simulated_drive.hpp"
#include "sim/decidable.hpp"

namespace credo::evaluation {
namespace {

using sensors::Timestamp;

/// How far the robot has driven at the time of each row of the truth. [m]
std::vector<double> ways_along(const datasets::Dataset& drive) {
  std::vector<double> ways{0.0};
  for (std::size_t i = 1; i < drive.truth.size(); ++i) {
    const datasets::TimedPose &a = drive.truth[i - 1], &b = drive.truth[i];
    const bool carried = std::any_of(drive.events.begin(), drive.events.end(), [&](const datasets::Event& event) {
      return event.name == kKidnapped && event.time > a.time && event.time <= b.time;
    });
    ways.push_back(ways.back() + (carried ? 0.0 : (b.pose.translation() - a.pose.translation()).norm()));
  }
  return ways;
}

/// A drive and what is known of it beforehand.
class Script {
 public:
  Script(const sim::Simulation& simulation, const datasets::Dataset& drive)
      : simulation_(&simulation),
        drive_(&drive),
        ways_(ways_along(drive)),
        degraded_(degraded_intervals(drive.events)) {}

  /// The row of an acquisition at `time`, without what was estimated. Precondition: one call per acquisition, in order.
  [[nodiscard]] CampaignRow row_at(Timestamp time) {
    const auto at = std::lower_bound(drive_->truth.begin(), drive_->truth.end(), time,
                                     [](const datasets::TimedPose& row, Timestamp t) { return row.time < t; });
    CampaignRow row;
    row.sample.truth = at->pose;  // the simulation tells the truth at the time of every reading
    row.travelled_m = ways_[static_cast<std::size_t>(at - drive_->truth.begin())];
    row.sample.degraded = std::any_of(degraded_.begin(), degraded_.end(),
                                      [time](const Interval& i) { return time >= i.first && time <= i.second; });
    if (next_event_ == 0 && is_first_) row.events = told(row.sample.truth);
    is_first_ = false;
    for (; next_event_ < drive_->events.size() && drive_->events[next_event_].time <= time; ++next_event_)
      row.events.push_back(drive_->events[next_event_].name);
    const bool searched = row.has_event(kToldNothing) || row.has_event(kToldWrong) || row.has_event(kKidnapped);
    if (searched && !simulation_->world().range_finders.empty())
      row.decidable = sim::decidable(simulation_->world(), row.sample.truth);
    return row;
  }

 private:
  [[nodiscard]] std::vector<std::string> told(const geometry::Pose2& truth) const {
    const auto& start = simulation_->initial_pose();
    if (!start) return {std::string(kToldNothing)};
    const ScoreParams limits;
    const bool wrong = (start->pose.translation() - truth.translation()).norm() > limits.lost_above_m ||
                       std::abs(geometry::angle_difference(start->pose.theta, truth.theta)) >
                           geometry::to_radians(limits.lost_above_deg);
    return wrong ? std::vector{std::string(kToldWrong)} : std::vector<std::string>{};
  }

  const sim::Simulation* simulation_;
  const datasets::Dataset* drive_;
  std::vector<double> ways_;
  std::vector<Interval> degraded_;
  std::size_t next_event_ = 0;
  bool is_first_ = true;
};

}  // namespace

bool CampaignRow::has_event(std::string_view name) const {
  return std::find(events.begin(), events.end(), name) != events.end();
}

RunParams RunParams::of(perception::Method method) {
  RunParams params;
  params.observer.method = method;
  params.localizer = params.localizer.with_method(method);
  return params;
}

Played play(const sim::Simulation& simulation, const RunParams& params, const RunWatch& watch) {
  const datasets::Dataset drive = readings_of(simulation);
  const datasets::DatasetHeader& header = drive.header;
  perception::Observer observer(header.rig, params.observer);
  localization::Localizer localizer(*header.floor_plan, header.rig, header.initial_pose, params.localizer);
  Script script(simulation, drive);
  Played played;
  double busy = 0.0;
  const auto now = [&] { return watch.seconds ? watch.seconds() : 0.0; };
  for_each_acquisition(simulation, drive,
                       [&](sensors::Acquisition acquisition) {
                         const double begin = now();
                         localizer.with_path(acquisition);
                         const perception::Scene& scene = observer.observe(acquisition);
                         localization::Localization fix = localizer.update(scene, acquisition.motion);
                         busy += now() - begin;
                         CampaignRow row = script.row_at(acquisition.time);
                         row.sample.localization = std::move(fix);
                         if (row.sample.placed())
                           row.matches = check_matches(scene, localizer.observations(), localizer.solution(),
                                                       localizer.landmark_beliefs(), localizer.map(), row.sample.truth,
                                                       {.classes = params.localizer.integrity});
                         played.rows.push_back(std::move(row));
                       },
                       {.progress = watch.progress});
  if (!played.rows.empty()) played.seconds_per_acquisition = busy / static_cast<double>(played.rows.size());
  return played;
}

}  // namespace credo::evaluation
