// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/scene_fit.hpp"

#include <algorithm>

namespace credo::localization {
namespace {

using perception::Primitive;
using perception::PrimitiveType;
using perception::Scene;
using tracking::kNoLandmark;
using tracking::LandmarkId;
using tracking::Match;

constexpr std::size_t kUsual = 256;  // primitives or segments

MapMatchingParams given_matching(MapMatchingParams params) {
  params.method = perception::Method::kDefault;
  return params;
}

}  // namespace

SceneFit::SceneFit() {
  solution.mahalanobis_squared.reserve(kUsual);
  solution.outlier.reserve(kUsual);
  solution.linearised.reserve(kUsual);
  observations.reserve(kUsual);
  new_matches.reserve(kUsual);
}

SceneFitter::SceneFitter(const LandmarkMap& map, const sensors::Rig& rig, const SceneFitParams& params)
    : map_(&map),
      params_(params),
      matcher_(map, params.matching),
      first_matcher_(map, given_matching(params.matching)),
      solver_(params.solver),
      uncalibrated_(calibrated_pose(rig, {}, 2 * (map.junction_count() + map.landmark_count()))),
      scan_matcher_(map, params.scan) {
  start_ = uncalibrated_;  // memory for the plan's errors
  wall_in_use_.reserve(kUsual);
  unmatched_.reserve(kUsual);
  used_.reserve(kUsual);
  taken_.reserve(kUsual);
}

void SceneFitter::fit(const Scene& scene, std::span<const tracking::Track> tracks, std::span<const Match> matches,
                      const CalibratedPose& expected, bool given, SceneFit& fit) {
  set_state(expected, fit.pose);
  fit.new_matches.clear();
  observe_tracks(scene, tracks, matches, fit);
  solve(scene, expected, fit);
  // The paper's method looks at the map once, from the pose that the tracks gave (Clerentin et al., sec. 4.2).
  const bool once = params_.method == perception::Method::kPaper && !given;
  match_map(scene, expected, given ? first_matcher_ : matcher_, once ? 1 : params_.matching_rounds, fit);
  conclude(fit);
}

void SceneFitter::fit_anew(const Scene& scene, const geometry::PoseEstimate& from, const CalibratedPose& expected,
                           SceneFit& fit) {
  fit.observations.clear();
  fit.new_matches.clear();
  wall_in_use_.assign(scene.segments.size(), false);
  start_ = expected;
  place(start_, from);
  solve(scene, start_, fit);
  match_map(scene, expected, matcher_, params_.matching_rounds, fit);
  match_map(scene, expected, matcher_, params_.matching_rounds, fit);
  conclude(fit);
}

void SceneFitter::gather(const Scene& scene, SceneFit& fit) const {
  fit.evidence = gather_evidence(scene, *map_, fit.observations, fit.solution, params_.evidence);
  if (params_.method == perception::Method::kPaper) return;
  fit.evidence.scan_agreement = scan_matcher_.compare(scene.points, fit.pose.pose).share(params_.scan);
  fit.evidence.bearing_agreement =
      compare_bearings(scene, *map_, fit.pose.pose, params_.bearings).share(params_.bearings);
}

const CalibratedPose& SceneFitter::uncalibrated(const geometry::PoseEstimate& at) {
  place(uncalibrated_, at);
  return uncalibrated_;
}

const CalibratedPose& SceneFitter::sharpen(const Scene& scene, const CalibratedPose& expected) {
  set_state(expected, by_walls_.pose);
  by_walls_.observations.clear();
  wall_in_use_.assign(scene.segments.size(), false);
  list_unmatched(scene, by_walls_);
  for (const MapMatch& match : matcher_.match_walls(scene, unmatched_, by_walls_.estimate()))
    observe_landmark(scene, match.primitive, match.landmark, -1, by_walls_);
  if (!by_walls_.observations.empty()) solve(scene, expected, by_walls_);
  return by_walls_.pose;
}

void SceneFitter::observe_landmark(const Scene& scene, int primitive, LandmarkId landmark, int track, SceneFit& fit) {
  const Primitive& seen = scene.primitives[static_cast<std::size_t>(primitive)];
  const bool wall = map_->is_wall(landmark);
  if (wall != (seen.type == PrimitiveType::kWall)) return;
  const double plan = map_->uncertainty_m();
  Observation o = wall ? observe_wall(seen, map_->wall(landmark), fit.pose.pose, plan, params_.observations)
                       : observe_point(scene, seen, map_->point(landmark), wall_in_use_, plan, params_.observations);
  o.landmark = landmark;
  o.own_column = map_->own_column(landmark);
  o.primitive = primitive;
  o.track = track;
  fit.observations.push_back(o);
  if (!wall) return;
  for (int s = seen.first_segment; s >= 0 && s <= seen.last_segment; ++s)
    wall_in_use_[static_cast<std::size_t>(s)] = true;
}

/// What the tracks continue; walls first, so that points know which walls are in use.
void SceneFitter::observe_tracks(const Scene& scene, std::span<const tracking::Track> tracks,
                                 std::span<const Match> matches, SceneFit& fit) {
  fit.observations.clear();
  wall_in_use_.assign(scene.segments.size(), false);
  for (const bool walls : {true, false})
    for (const Match& match : matches) {
      const LandmarkId landmark = tracks[static_cast<std::size_t>(match.track)].landmark;
      const bool seen = !walls && std::any_of(fit.observations.begin(), fit.observations.end(),
                                              [landmark](const Observation& o) { return o.landmark == landmark; });
      if (landmark != kNoLandmark && map_->is_wall(landmark) == walls && !seen)
        observe_landmark(scene, match.primitive, landmark, match.track, fit);
    }
}

void SceneFitter::list_unmatched(const Scene& scene, const SceneFit& fit) {
  unmatched_.clear();
  taken_.clear();
  used_.assign(scene.primitives.size(), false);
  for (const Observation& o : fit.observations) {
    used_[static_cast<std::size_t>(o.primitive)] = true;
    if (!map_->is_wall(o.landmark)) taken_.push_back(o.landmark);
  }
  for (std::size_t p = 0; p < used_.size(); ++p)
    if (!used_[p]) unmatched_.push_back(static_cast<int>(p));
}

/// All but what conclude() adds, as it is not asked for between the rounds.
void SceneFitter::solve(const Scene& scene, const CalibratedPose& expected, SceneFit& fit) {
  solver_.solve_state(expected, fit.observations, scene.carry_covariance, fit.solution);
  set_state(fit.solution.pose, fit.pose);
}

/// What the latest solution says of the plan's errors.
void SceneFitter::conclude(SceneFit& fit) {
  solver_.solve_plan(fit.solution);
  fit.pose = fit.solution.pose;
}

void SceneFitter::match_map(const Scene& scene, const CalibratedPose& expected, MapMatcher& matcher, int rounds,
                            SceneFit& fit) {
  const auto add = [&](const std::vector<MapMatch>& found) {
    for (const MapMatch& match : found) {
      observe_landmark(scene, match.primitive, match.landmark, -1, fit);
      fit.new_matches.push_back(match);
    }
    if (!found.empty()) solve(scene, expected, fit);
    return !found.empty();
  };
  for (int round = 0; round < rounds; ++round) {
    list_unmatched(scene, fit);
    const bool walls = add(matcher.match_walls(scene, unmatched_, fit.estimate()));
    list_unmatched(scene, fit);
    const bool points = add(matcher.match_points(scene, unmatched_, fit.estimate(), taken_));
    if (!walls && !points) break;
  }
}

}  // namespace credo::localization
