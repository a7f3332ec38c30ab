// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/reproduction.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "evaluation/localization_score.hpp"
#include "geometry/angles.hpp"

namespace credo::evaluation {
namespace {

using perception::PrimitiveType;
using results::Moment;

/// How m_l(YES) goes with the number of tracked landmarks.
std::optional<double> belief_follows_tracks(std::span<const ReproducedDrive> drives) {
  std::vector<int> counts;
  for (const ReproducedDrive& drive : drives)
    for (const Moment& moment : drive.history) counts.push_back(landmarks_tracked(moment));
  const auto middle = counts.begin() + static_cast<std::ptrdiff_t>(counts.size() / 2);
  std::nth_element(counts.begin(), middle, counts.end());
  const int median = *middle;
  std::vector<double> with_more, with_fewer;
  for (const ReproducedDrive& drive : drives) {
    for (const Moment& moment : drive.history) {
      const int tracked = landmarks_tracked(moment);
      if (tracked > median) with_more.push_back(moment.localization.belief.yes);
      if (tracked < median) with_fewer.push_back(moment.localization.belief.yes);
    }
  }
  return auroc(with_more, with_fewer);
}

void add_tracks(std::span<const Moment> history, const ReproductionParams& params, ReproducedFigures& figures) {
  for (const TrackLife& life : track_lives(history)) {
    if (life.lost_with && life.sightings() >= params.sightings_of_a_landmark) figures.until_lost.add(life.until_lost());
    figures.walls_between += life.was_wall_between() ? 1 : 0;
  }
}

/// An edge of the plan that was an edge in every sighting, was seen without a break, and was lost.
bool is_life_of_an_edge(const TrackLife& life) {
  const bool an_edge = std::all_of(life.samples.begin(), life.samples.end(), [](const results::TrackSample& sample) {
    return sample.type == PrimitiveType::kEdge && sample.landmark != tracking::kNoLandmark;
  });
  const bool without_a_break = life.sightings() == static_cast<int>(life.last_seen() - life.first) + 1;
  return an_edge && without_a_break && life.lost_with.has_value();
}

}  // namespace

void Spread::add(double value) {
  ++count;
  sum += value;
  lowest = std::min(lowest, value);
  highest = std::max(highest, value);
}

double Spread::mean() const {
  if (count == 0) throw std::logic_error("the mean of no values");
  return sum / count;
}

void MassSpread::add(const evidence::BinaryMass& mass) {
  constexpr double kRounding = 1e-12;
  yes.add(mass.yes);
  no.add(mass.no);
  unknown.add(mass.unknown);
  without_no += mass.no <= kRounding ? 1 : 0;
}

void ReproducedDrive::see(const perception::Scene& scene) {
  conflict.add(scene);
  for (const perception::Primitive& primitive : scene.primitives)
    if (!primitive.bearing_only) masses[static_cast<std::size_t>(primitive.type)].add(primitive.existence);
}

int landmarks_tracked(const Moment& moment) {
  return static_cast<int>(
      std::count_if(moment.tracks.begin(), moment.tracks.end(), [](const results::TrackSample& track) {
        return track.state == tracking::TrackState::kTracked && track.landmark != tracking::kNoLandmark;
      }));
}

ReproducedFigures reproduced_figures(std::span<const ReproducedDrive> drives, const ReproductionParams& params) {
  ReproducedFigures figures;
  double conflict = 0.0, segments = 0.0;
  MatchCounts matches;
  for (const ReproducedDrive& drive : drives) {
    const auto seen = static_cast<double>(drive.conflict.segments());
    conflict += seen * drive.conflict.mean();
    segments += seen;
    matches += drive.matches;
    add_tracks(drive.history, params, figures);
    for (const Moment& moment : drive.history) {
      const geometry::Pose2& pose = moment.localization.estimate.pose;
      const geometry::Pose2& truth = moment.truth.value();
      const double off = (pose.translation() - truth.translation()).norm();
      ++figures.acquisitions;
      figures.mean_position_m += off;
      figures.mean_heading_rad += std::abs(geometry::angle_difference(pose.theta, truth.theta));
      if (off <= params.within_m) figures.within_m.add(off);
      figures.mean_belief_yes += moment.localization.belief.yes;
    }
  }
  if (figures.acquisitions == 0) throw std::logic_error("a reproduction needs acquisitions");
  figures.mean_position_m /= figures.acquisitions;
  figures.mean_heading_rad /= figures.acquisitions;
  figures.mean_belief_yes /= figures.acquisitions;
  figures.mean_conflict = segments > 0.0 ? conflict / segments : 0.0;
  if (matches.matches > 0) figures.wrong_matches = matches.wrong_share();
  figures.belief_follows_tracks = belief_follows_tracks(drives);
  return figures;
}

std::optional<TrackLife> life_like_figure_21(std::span<const Moment> history) {
  std::optional<TrackLife> best;
  const auto off = [](const TrackLife& life) { return std::abs(life.sightings() - kSightingsOfFigure21); };
  for (TrackLife& life : track_lives(history))
    if (is_life_of_an_edge(life) && (!best || off(life) < off(*best))) best = std::move(life);
  return best;
}

std::optional<TrackLife> life_like_figure_22(std::span<const Moment> history) {
  std::optional<TrackLife> best;
  for (TrackLife& life : track_lives(history))
    if (life.was_wall_between() && (!best || life.samples.size() > best->samples.size())) best = std::move(life);
  return best;
}

}  // namespace credo::evaluation
