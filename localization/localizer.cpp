// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/localizer.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "localization/localizer_state.hpp"

namespace credo::localization {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using geometry::Pose2;
using geometry::PoseEstimate;
using perception::Primitive;
using perception::PrimitiveType;
using perception::Scene;
using sensors::Timestamp;
using tracking::kNoLandmark;
using tracking::Match;
using tracking::Track;

/// The start of a run without a plan or without an initial pose: the origin of its own frame, exactly.
PoseEstimate origin() {
  constexpr double kSigma = 1e-6;
  return {{}, kSigma * kSigma * Matrix3d::Identity()};
}

}  // namespace

Localizer::State::State(const geometry::FloorPlan& plan, const sensors::Rig& instruments,
                        const std::optional<PoseEstimate>& initial, const LocalizerParams& p)
    : params(p.with_method(p.method)),
      rig(instruments),
      map(plan, params.map),
      fitter(map, instruments, params.fit),
      tracker(params.tracker),
      labels(map, params.contradictions_allowed),
      continuity(params.continuity),
      misfit(params.misfit),
      monitor(wall_footprints(map), params.integrity),
      modules(map, params.integrity),
      search(map, fitter.scan_matcher().field(), rig, params.search),
      elsewhere(search, fitter, params.hypotheses),
      ego_motion(origin(), params.ego_motion, params.constant_velocity),
      absolute(initial.has_value() && !map.empty()),
      trust(initial.value_or(PoseEstimate{}), params.belief, params.status, params.trust),
      predictor(params.constant_velocity) {
  constexpr std::size_t kUsualObservations = 256;
  observed_tracks.reserve(kUsualObservations);
  landmark_beliefs.reserve(kUsualObservations);
  if (rig.camera) {
    const sensors::OmniCamera& camera = *rig.camera;
    mirror = {camera.center_px, camera.accuracy.center_px, Vector2d::Zero(), camera.accuracy.tilt_rad};
  }
  fit.pose = calibrated_pose(rig, absolute ? *initial : origin(), 2 * (map.junction_count() + map.landmark_count()));
}

/// Odometry's motion, which the paper's method does without; else what the latest velocity predicts; nothing before the
/// first scene.
PoseEstimate Localizer::State::predicted_motion(const std::optional<PoseEstimate>& motion, Timestamp time) const {
  if (history.empty()) return {};
  if (motion && params.method == perception::Method::kDefault) return *motion;
  return predictor.predict(sensors::seconds_between(history.latest().time, time));
}

/// Predicts the motion since the latest scene, and from it where the tracks should be seen.
PoseEstimate Localizer::State::predict(const Scene& scene, const std::optional<PoseEstimate>& motion) {
  const bool paper = params.method == perception::Method::kPaper;
  PoseEstimate step = predicted_motion(motion, scene.time);
  if (set_by_hand) start_from(*set_by_hand, step);
  if (!paper && !motion && !history.empty() && !set_by_hand)
    step.pose.theta +=
        unforeseen_turn(tracker.tracks(), history.latest().time, scene, step.pose, params.constant_velocity);
  const bool follows_map = absolute && !history.empty();
  if (paper || !follows_map) {
    tracker.predict(!paper && !history.empty() ? std::optional(step) : std::nullopt);
    if (!follows_map) return step;
    if (predictor.empty()) step.pose = likeliest_first_step(scene);
    expect_young_tracks(step.pose);
    return step;
  }
  // From two degrees beside the truth, many radial lines look like their neighbours.
  predicted = fit.pose;
  move(predicted, step, params.calibration_walk);
  const CalibratedPose& sharpened = fitter.sharpen(scene, predicted);
  tracker.predict(motion_to(sharpened));
  expect_landmarks(sharpened);
  return step;
}

/// Forgets where the robot was thought to be, but not how it moves and what was learned about the instruments: it was
/// where `step` leads from to `pose`.
void Localizer::State::start_from(const PoseEstimate& pose, const PoseEstimate& step) {
  const Pose2 before = pose.pose * step.pose.inverse();
  Matrix3d back = Matrix3d::Identity();
  back(0, 2) = pose.pose.y - before.y;
  back(1, 2) = before.x - pose.pose.x;
  place(fit.pose, {before, back * pose.covariance * back.transpose()});
  labels.forget_all(tracker);
  misfit = Misfit(params.misfit);
  elsewhere.clear();
  ego_motion.restart(pose);
  absolute = !map.empty();
  doubted = matched_before = 0;
  trust.given(fit.estimate());
}

/// The motion from the latest pose to another one, which knows nothing of it.
PoseEstimate Localizer::State::motion_to(const CalibratedPose& pose) const {
  Matrix3d to_base = Matrix3d::Identity();
  to_base.topLeftCorner<2, 2>() = fit.pose.pose.rotation().transpose();
  return {fit.pose.pose.inverse() * pose.pose,
          to_base * (fit.pose.covariance() + pose.covariance()) * to_base.transpose()};
}

/// What is added to the covariance of a pose from which the plan is not recognised: wheels may have slipped.
Matrix3d Localizer::State::doubt() const {
  const double position = params.doubt_sigma_m * params.doubt_sigma_m;
  return Eigen::Vector3d(position, position, params.doubt_sigma_rad * params.doubt_sigma_rad).asDiagonal();
}

/// Map and tracks agree: a track with a landmark is looked for where the map has it.
void Localizer::State::expect_landmarks(const CalibratedPose& from) {
  const std::vector<Track>& tracks = tracker.tracks();
  const Matrix3d P = from.covariance();
  const Pose2 T_base_map = from.pose.inverse();
  for (std::size_t t = 0; t < tracks.size(); ++t) {
    if (tracks[t].landmark == kNoLandmark || map.is_wall(tracks[t].landmark)) continue;
    const Vector2d p = T_base_map * map.point(tracks[t].landmark).position;
    const Eigen::Matrix<double, 2, 3> by_pose = base_coordinates_by_pose(from.pose, p);
    const double plan = map.uncertainty_m() * map.uncertainty_m();
    tracker.expect_point(static_cast<int>(t), p,
                         by_pose * P * by_pose.transpose() + plan * Eigen::Matrix2d::Identity());
  }
}

/// A line through azimuths needs two of them: a track that was seen once is looked for where the robot's latest
/// velocity brings it. The paper does not say what it does with these.
void Localizer::State::expect_young_tracks(const Pose2& step) {
  const std::vector<Track>& tracks = tracker.tracks();
  for (std::size_t t = 0; t < tracks.size(); ++t) {
    if (tracks[t].hits > 1 || tracks[t].last_seen_time != history.latest().time) continue;
    const Vector2d position = step.inverse() * tracks[t].last_seen.position;
    tracker.expect(static_cast<int>(t), std::atan2(position.y(), position.x()), tracks[t].sigma_azimuth);
  }
}

/// Before there is a velocity: the way straight on along which most azimuths go on.
Pose2 Localizer::State::likeliest_first_step(const Scene& scene) {
  constexpr int kTries = 13;
  Pose2 best;
  double most = -1.0;
  for (int i = 0; i < kTries; ++i) {
    const Pose2 step{params.constant_velocity.first_step_m * i / (kTries - 1), 0.0, 0.0};
    expect_young_tracks(step);
    double sum = 0.0;
    for (const Match& match : tracker.associate(scene)) sum += match.match_yes;
    if (sum <= most) continue;
    most = sum;
    best = step;
  }
  return best;
}

/// Without a plan or an initial pose: the motion by the walls that are seen again, with odometry as the prior.
PoseEstimate Localizer::State::follow_walls(const Scene& scene, const std::optional<PoseEstimate>& motion) {
  fit.observations.clear();
  ego_motion.update(scene, params.method == perception::Method::kDefault ? motion : std::nullopt);
  place(fit.pose, ego_motion.pose().value);
  return ego_motion.step();
}

void Localizer::State::start_tracks(const Scene& scene) {
  const std::vector<int>& appeared = tracker.appeared();
  for (const int primitive : appeared) {
    const auto found = std::find_if(fit.new_matches.begin(), fit.new_matches.end(),
                                    [primitive](const MapMatch& match) { return match.primitive == primitive; });
    if (found == fit.new_matches.end()) {
      if (params.method == perception::Method::kDefault || !absolute) tracker.start(scene, primitive, 0.0, kNoLandmark);
      continue;
    }
    // Clerentin et al., sec. 5: the initial matching is given with the mass (.5, 0, .5).
    const std::optional<int> track = history.empty() ? tracker.start_given(scene, primitive, found->landmark)
                                                     : tracker.start(scene, primitive, found->yes, found->landmark);
    if (track) labels.release(found->landmark, *track, tracker);
    for (Observation& o : fit.observations)
      if (o.primitive == primitive) o.track = track.value_or(-1);
  }
}

/// The pose from what is matched to the tracks and to the map, and from whatever else tells.
void Localizer::State::find_pose(const Scene& scene, const std::vector<Match>& matches, const PoseEstimate& step,
                                 bool odometry) {
  // A wall's track that goes on as a junction, or the reverse, is another landmark.
  for (const Match& match : matches)
    if (match.transition) tracker.relabel(match.track, kNoLandmark);
  predicted = fit.pose;
  if (!history.empty()) {
    move(predicted, step, params.calibration_walk);
    trust.follow(step);
  }
  fitter.fit(scene, tracker.tracks(), matches, predicted, history.empty(), fit);
  search_pose(scene, odometry);
  look_elsewhere(scene, step);
}

Localization Localizer::State::report(const Scene& scene) const {
  Localization fix;
  fix.time = scene.time;
  fix.estimate = fit.estimate();
  fix.tracked = static_cast<int>(tracker.tracks().size());
  fix.detected = static_cast<int>(scene.primitives.size());
  if (!absolute)
    fix.reason = map.empty() ? "no floor plan: the pose is relative to the start"
                             : "no initial pose: the place is not found yet";
  return fix;
}

/// Which tracks the pose rests on, by observation: their indices are another's once the tracks are updated.
void Localizer::State::list_observed_tracks() {
  observed_tracks.clear();
  for (const Observation& o : fit.observations)
    observed_tracks.push_back(o.track < 0 ? -1 : tracker.tracks()[static_cast<std::size_t>(o.track)].id);
}

/// How far off the pose can be.
Integrity Localizer::State::watch() {
  constexpr double kUntracked = 0.5;  // BetP of not knowing
  landmark_beliefs.clear();
  for (const int id : observed_tracks) {
    const auto track =
        std::find_if(tracker.tracks().begin(), tracker.tracks().end(), [id](const Track& t) { return t.id == id; });
    landmark_beliefs.push_back(track == tracker.tracks().end() ? kUntracked : track->existence.pignistic());
  }
  return monitor.assess(fit.solution, landmark_beliefs, misfit.variance_factors(),
                        modules.find(fit.observations, fit.solution));
}

/// Belief and status of an absolute pose.
void Localizer::State::weigh(const Scene& scene, Localization& fix) {
  LocalizationEvidence& evidence = fit.evidence;
  evidence.tracks = tracker.tracks();
  std::optional<Integrity> integrity;
  if (params.method == perception::Method::kDefault) {
    fix.broken_off = broken_off && lost_sight();
    if (!fit.observations.empty()) {
      misfit.add(fit.observations, fit.solution);
      fix.inconsistent = misfit.contradicting();
      fix.estimate.covariance += (misfit.variance_factors().all - 1.0) * fit.pose.covariance();
    }
    integrity = watch();
    fix.protection = integrity->protection;
    if (integrity->landmarks >= params.belief.least_in_sight) evidence.separation = integrity->separation;
  }
  fix.matched = matched_before = evidence.matched;
  const evidence::BinaryMass before = history.empty() ? evidence::BinaryMass::vacuous() : history.latest().belief;
  trust.weigh(evidence, before, integrity ? &*integrity : nullptr, fix);
  if (fix.unrecognised || fix.off_plan) {
    widen(fit.pose, doubt());
    fix.estimate.covariance += doubt();
  }
  trust.go_on_from(fix.estimate);
  judge(fix, scene.camera_seen, scene.range_finder_seen, params.status);
}

/// Without a plan, what can be right is the motion since the start.
void Localizer::State::believe_motion(Localization& fix) const {
  fix.belief = ego_motion.pose().belief;
  fix.matched = ego_motion.matched();
}

void Localizer::State::remember(const Localization& fix) {
  if (found_elsewhere) history.forget();
  history.add({fix.time, fix.estimate, fix.belief});
  if (history.before() && fix.time > history.before()->time)
    predictor.add(history.before()->estimate.pose.inverse() * fix.estimate.pose,
                  sensors::seconds_between(history.before()->time, fix.time));
}

Localizer::Localizer(const geometry::FloorPlan& plan, const sensors::Rig& rig,
                     const std::optional<PoseEstimate>& initial, const LocalizerParams& params)
    : state_((check(params), std::make_unique<State>(plan, rig, initial, params))) {}
Localizer::~Localizer() = default;
Localizer::Localizer(Localizer&&) noexcept = default;
Localizer& Localizer::operator=(Localizer&&) noexcept = default;

void Localizer::with_path(sensors::Acquisition& acquisition) {
  State& s = *state_;
  if (acquisition.path.empty() && !s.history.empty()) {
    const Timestamp from = s.history.latest().time;
    const Pose2 step = s.predicted_motion(std::nullopt, acquisition.time).pose;
    acquisition.path = sensors::MotionPath({{from, {}}, {std::max(acquisition.time, from + 1), step}});
  }
  s.history.follow(acquisition.path);
}

void Localizer::set_pose(const PoseEstimate& T_map_base) { state_->set_by_hand = T_map_base; }

Localization Localizer::update(const Scene& scene, const std::optional<PoseEstimate>& motion) {
  State& s = *state_;
  if (scene.camera_seen) s.mirror = scene.mirror;
  // 1. Predict the pose and where the tracks should be seen.
  const PoseEstimate step = s.predict(scene, motion);

  // 2. Associate the primitives with the tracks.
  const std::vector<Match>& matches = s.tracker.associate(scene);

  s.fit.new_matches.clear();
  s.broken_off = s.params.method == perception::Method::kDefault && !s.history.empty() &&
                 s.continuity.breaks_off(scene, s.tracker.tracks(), matches, s.history.latest().time);
  s.jumped = false;
  s.found_elsewhere = s.set_by_hand.has_value();
  s.set_by_hand.reset();
  // 3. The pose from what is matched; 4. the map for what has appeared, and the pose again.
  if (s.absolute)
    s.find_pose(scene, matches, step, motion.has_value());
  else
    s.look_elsewhere(scene, s.follow_walls(scene, motion));
  if (s.absolute) s.labels.label(matches, s.tracker, s.fit);
  // 5. Start tracks; let go of landmarks that contradict the pose.
  s.start_tracks(scene);
  // Under the paper's method a track keeps its landmark as long as it lives.
  if (s.absolute && s.params.method == perception::Method::kDefault) s.labels.drop_contradicting(s.fit, s.tracker);
  s.list_observed_tracks();
  s.tracker.update(scene);
  s.labels.forget_lost(s.tracker.tracks());

  // 6. Beliefs and status.
  Localization fix = s.report(scene);
  s.report_hypotheses(fix);
  if (s.absolute)
    s.weigh(scene, fix);
  else if (s.map.empty())
    s.believe_motion(fix);
  s.remember(fix);
  return fix;
}

evidence::Believed<PoseEstimate> Localizer::pose_at(Timestamp time) const {
  const State& s = *state_;
  if (s.history.empty()) return {s.fit.estimate(), evidence::BinaryMass::vacuous()};
  return s.history.pose_at(time);
}

const std::vector<Track>& Localizer::tracks() const { return state_->tracker.tracks(); }
const std::vector<Observation>& Localizer::observations() const { return state_->fit.observations; }
const PoseSolution& Localizer::solution() const { return state_->fit.solution; }
const std::vector<double>& Localizer::landmark_beliefs() const { return state_->landmark_beliefs; }
const LandmarkMap& Localizer::map() const { return state_->map; }
const LocalizerParams& Localizer::params() const { return state_->params; }
RigCalibration Localizer::calibration() const { return rig_calibration(state_->rig, state_->fit.pose, state_->mirror); }

}  // namespace credo::localization
