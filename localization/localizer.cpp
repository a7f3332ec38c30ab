// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/localizer.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "localization/pose_history.hpp"

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
using tracking::LandmarkId;
using tracking::Match;
using tracking::Track;

/// The start of a run without a plan or without an initial pose: the origin of its own frame, exactly.
constexpr double kOriginSigma = 1e-6;

SplitPose moved(const SplitPose& from, const PoseEstimate& motion) {
  const PoseEstimate independent = geometry::compose({from.pose, from.independent}, motion);
  const PoseEstimate correlated = geometry::compose({from.pose, from.correlated}, {motion.pose, Matrix3d::Zero()});
  return {independent.pose, independent.covariance, correlated.covariance};
}

/// The initial matching is given by hand (Clerentin et al., sec. 5): here, by the default's criteria from the initial
/// pose.
MapMatchingParams initial_matching(MapMatchingParams params) {
  params.method = perception::Method::kDefault;
  return params;
}

}  // namespace

struct Localizer::State {
  State(const geometry::FloorPlan& plan, const sensors::Rig& rig, const std::optional<PoseEstimate>& initial,
        const LocalizerParams& p)
      : params(p.with_method(p.method)),
        map(plan, params.map),
        later_matcher(map, params.matching),
        first_matcher(map, initial_matching(params.matching)),
        solver(rig, params.solver),
        scan_matcher(map, params.scan),
        tracker(params.tracker),
        monitor(params.integrity),
        absolute(initial.has_value() && !map.empty()),
        predictor(params.constant_velocity) {
    if (absolute) {
      current.pose = initial->pose;
      current.independent = initial->covariance;
    } else {
      current.independent = kOriginSigma * kOriginSigma * Matrix3d::Identity();
    }
  }

  LocalizerParams params;
  LandmarkMap map;
  MapMatcher later_matcher;
  MapMatcher first_matcher;
  PoseSolver solver;
  ScanMatcher scan_matcher;
  tracking::Tracker tracker;
  IntegrityMonitor monitor;
  bool absolute;  ///< poses are in the map frame, not relative to the start
  SplitPose current;
  PoseSolution solution;
  LocalizationEvidence evidence;  ///< about `current`
  int matched_before = 0;         ///< primitives that the latest fix rests on
  int unchecked = 0;              ///< acquisitions since the scan last lay on the plan
  PoseHistory history;
  MotionPredictor predictor;
  std::map<int, int> contradictions;  ///< in a row, by track id

  // One update's workspace.
  std::vector<Observation> observations;
  std::vector<bool> wall_in_use;
  std::vector<int> unmatched;
  std::vector<bool> used;  ///< by primitive
  std::vector<LandmarkId> taken;
  std::vector<MapMatch> new_matches;
  std::vector<double> landmark_beliefs;  ///< by observation

  [[nodiscard]] PoseEstimate estimate() const { return {current.pose, current.covariance()}; }
  [[nodiscard]] PoseEstimate predicted_motion(const std::optional<PoseEstimate>& motion, Timestamp time) const;
  [[nodiscard]] PoseEstimate predict(const Scene& scene, const std::optional<PoseEstimate>& motion);
  [[nodiscard]] Matrix3d doubt() const;
  void expect_landmarks(const SplitPose& predicted);
  void expect_young_tracks(const Pose2& step);
  [[nodiscard]] Pose2 likeliest_first_step(const Scene& scene);
  void observe_tracks(const Scene& scene, const std::vector<Match>& matches);
  void observe_landmark(const Scene& scene, int primitive, LandmarkId landmark, int track);
  void list_unmatched(const Scene& scene);
  void match_map(const Scene& scene, const SplitPose& predicted);
  void solve(const Scene& scene, const SplitPose& predicted);
  void solve_motion(const Scene& scene, const std::vector<Match>& matches, const PoseEstimate& motion);
  void label_tracks(const std::vector<Match>& matches);
  void release(LandmarkId landmark, int keeper);
  void start_tracks(const Scene& scene);
  void drop_contradicting_landmarks();
  void forget_lost_tracks();
  [[nodiscard]] LocalizationEvidence gather(const Scene& scene) const;
  [[nodiscard]] double quality(const LocalizationEvidence& found, const Scene& scene) const;
  void search_pose(const Scene& scene, const SplitPose& predicted, bool odometry);
  bool match_anew(const Scene& scene, const SplitPose& expected);
  [[nodiscard]] Localization report(const Scene& scene) const;
  [[nodiscard]] Integrity watch();
  void weigh(const Scene& scene, Localization& fix);
  void remember(const Localization& fix);
};

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
  if (!paper && !motion && !history.empty())
    step.pose.theta +=
        unforeseen_turn(tracker.tracks(), history.latest().time, scene, step.pose, params.constant_velocity);
  tracker.predict(!paper && !history.empty() ? std::optional(step) : std::nullopt);
  if (!absolute || history.empty()) return step;
  if (paper) {
    if (predictor.empty()) step.pose = likeliest_first_step(scene);
    expect_young_tracks(step.pose);
  }
  if (!paper) expect_landmarks(moved(current, step));
  return step;
}

/// What is added to the covariance of a pose from which the plan is not recognised: wheels may have slipped.
Matrix3d Localizer::State::doubt() const {
  const double position = params.doubt_sigma_m * params.doubt_sigma_m;
  return Eigen::Vector3d(position, position, params.doubt_sigma_rad * params.doubt_sigma_rad).asDiagonal();
}

/// Map and tracks agree: a track with a landmark is looked for where the map has it.
void Localizer::State::expect_landmarks(const SplitPose& predicted) {
  const std::vector<Track>& tracks = tracker.tracks();
  const Matrix3d P = predicted.covariance();
  const Pose2 T_base_map = predicted.pose.inverse();
  for (std::size_t t = 0; t < tracks.size(); ++t) {
    if (tracks[t].landmark == kNoLandmark || map.is_wall(tracks[t].landmark)) continue;
    const Vector2d p = T_base_map * map.point(tracks[t].landmark).position;
    const Eigen::Matrix<double, 2, 3> by_pose = base_coordinates_by_pose(predicted.pose, p);
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

void Localizer::State::observe_landmark(const Scene& scene, int primitive, LandmarkId landmark, int track) {
  const Primitive& seen = scene.primitives[static_cast<std::size_t>(primitive)];
  const bool wall = map.is_wall(landmark);
  if (wall != (seen.type == PrimitiveType::kWall)) return;
  Observation o =
      wall ? observe_wall(seen, map.wall(landmark), current.pose, map.uncertainty_m(), params.observations)
           : observe_point(scene, seen, map.point(landmark), wall_in_use, map.uncertainty_m(), params.observations);
  o.landmark = landmark;
  o.primitive = primitive;
  o.track = track;
  observations.push_back(o);
  if (!wall) return;
  for (int s = seen.first_segment; s >= 0 && s <= seen.last_segment; ++s)
    wall_in_use[static_cast<std::size_t>(s)] = true;
}

/// What the tracks continue; walls first, so that points know which walls are in use. A wall's track that goes on as a
/// junction, or the reverse, is another landmark.
void Localizer::State::observe_tracks(const Scene& scene, const std::vector<Match>& matches) {
  for (const Match& match : matches)
    if (match.transition) tracker.relabel(match.track, kNoLandmark);
  observations.clear();
  wall_in_use.assign(scene.segments.size(), false);
  for (const bool walls : {true, false})
    for (const Match& match : matches) {
      const LandmarkId landmark = tracker.tracks()[static_cast<std::size_t>(match.track)].landmark;
      const bool seen = !walls && std::any_of(observations.begin(), observations.end(),
                                              [landmark](const Observation& o) { return o.landmark == landmark; });
      if (landmark != kNoLandmark && map.is_wall(landmark) == walls && !seen)
        observe_landmark(scene, match.primitive, landmark, match.track);
    }
}

void Localizer::State::list_unmatched(const Scene& scene) {
  unmatched.clear();
  taken.clear();
  used.assign(scene.primitives.size(), false);
  for (const Observation& o : observations) {
    used[static_cast<std::size_t>(o.primitive)] = true;
    if (!map.is_wall(o.landmark)) taken.push_back(o.landmark);
  }
  for (std::size_t p = 0; p < used.size(); ++p)
    if (!used[p]) unmatched.push_back(static_cast<int>(p));
}

void Localizer::State::solve(const Scene& scene, const SplitPose& predicted) {
  solution = solver.solve(predicted, observations, scene.carry_covariance);
  current = solution.pose;
}

/// What continues no track of the map is matched to the map, walls before points, from a pose that every round knows
/// better. The paper's method looks once, from the pose that the tracks gave (Clerentin et al., sec. 4.2).
void Localizer::State::match_map(const Scene& scene, const SplitPose& predicted) {
  const auto add = [&](const std::vector<MapMatch>& found) {
    for (const MapMatch& match : found) {
      observe_landmark(scene, match.primitive, match.landmark, -1);
      new_matches.push_back(match);
    }
    if (!found.empty()) solve(scene, predicted);
    return !found.empty();
  };
  MapMatcher& matcher = history.empty() ? first_matcher : later_matcher;
  const bool once = params.method == perception::Method::kPaper && !history.empty();
  for (int round = 0; round < (once ? 1 : params.matching_rounds); ++round) {
    list_unmatched(scene);
    const bool walls = add(matcher.match_walls(scene, unmatched, estimate()));
    list_unmatched(scene);
    const bool points = add(matcher.match_points(scene, unmatched, estimate(), taken));
    if (!walls && !points) break;
  }
}

/// What speaks for and against the current pose, the tracks left out.
LocalizationEvidence Localizer::State::gather(const Scene& scene) const {
  LocalizationEvidence gathered = gather_evidence(scene, map, observations, solution, params.evidence);
  if (params.method == perception::Method::kDefault)
    gathered.scan_agreement = scan_matcher.compare(scene.points, current.pose).share(params.scan);
  return gathered;
}

/// By which two ways to match a scene are compared: the belief in the pose and the share of what is seen that it
/// explains.
double Localizer::State::quality(const LocalizationEvidence& found, const Scene& scene) const {
  const double share = found.matched / std::max(1.0, static_cast<double>(scene.primitives.size()));
  return localization_belief(found, params.belief).mass.pignistic() + params.matched_share_weight * share;
}

/// Gathers the evidence about the pose. Primitives that were matched wrongly agree with the wrong pose that they make;
/// the raw scan and the landmarks that should be in sight do not. Where these speak against the pose, everything is
/// matched anew from the pose nearby from which the scan lies best on the plan, and what is believed more is kept.
void Localizer::State::search_pose(const Scene& scene, const SplitPose& predicted, bool odometry) {
  evidence = gather(scene);
  if (!evidence.scan_agreement) return;
  const bool off_plan = *evidence.scan_agreement < params.search_below;
  const bool unrecognised = recognition_belief(evidence, params.belief).no > 0.0;
  const bool lost_sight = evidence.matched < params.search_matched_below * matched_before;
  if (!off_plan && !unrecognised && !lost_sight) return;
  SplitPose wide = predicted;
  wide.independent += doubt();
  if (match_anew(scene, wide) || odometry) return;
  wide.independent(2, 2) += params.unforeseen_turn_sigma_rad * params.unforeseen_turn_sigma_rad;
  match_anew(scene, wide);
}

/// Matches everything from the pose that the scan fits best about an expected one.
/// \returns whether that is better than what was there, which is kept else.
bool Localizer::State::match_anew(const Scene& scene, const SplitPose& expected) {
  const Pose2 other = scan_matcher.search(scene.points, {expected.pose, expected.covariance()});
  const double position = params.searched_sigma_m * params.searched_sigma_m;
  const double turn = params.searched_sigma_rad * params.searched_sigma_rad;

  const SplitPose pose_before = current;
  std::vector<Observation> observations_before = std::exchange(observations, {});
  std::vector<MapMatch> matches_before = std::exchange(new_matches, {});
  const PoseSolution solution_before = solution;
  wall_in_use.assign(scene.segments.size(), false);
  solve(scene, {other, Eigen::Vector3d(position, position, turn).asDiagonal(), Matrix3d::Zero()});
  match_map(scene, expected);
  const LocalizationEvidence found = gather(scene);
  if (quality(found, scene) > quality(evidence, scene) + params.search_gain) {
    evidence = found;
    contradictions.clear();
    for (std::size_t t = 0; t < tracker.tracks().size(); ++t) tracker.relabel(static_cast<int>(t), kNoLandmark);
    return true;
  }
  current = pose_before;
  observations = std::move(observations_before);
  new_matches = std::move(matches_before);
  solution = solution_before;
  return false;
}

/// Without a plan or an initial pose: the motion from what the tracks saw in both scenes, with odometry as the prior.
void Localizer::State::solve_motion(const Scene& scene, const std::vector<Match>& matches, const PoseEstimate& motion) {
  observations.clear();
  if (history.empty()) return;
  for (const Match& match : matches) {
    const Track& track = tracker.tracks()[static_cast<std::size_t>(match.track)];
    const Primitive& now = scene.primitives[static_cast<std::size_t>(match.primitive)];
    if (track.last_seen_time != history.latest().time || now.bearing_only || track.last_seen.bearing_only ||
        (now.type == PrimitiveType::kWall) != (track.last_seen.type == PrimitiveType::kWall))
      continue;
    observations.push_back(observe_again(now, track.last_seen, params.observations));
    observations.back().primitive = match.primitive;
  }
  const SplitPose prior{motion.pose, motion.covariance, Matrix3d::Zero()};
  solution = solver.solve(prior, observations, scene.carry_covariance);
  current = moved(current, {solution.pose.pose, solution.pose.covariance()});
}

/// A point of the map is one thing: a track that it was given to before and that is not seen now lets go of it.
void Localizer::State::release(LandmarkId landmark, int keeper) {
  if (map.is_wall(landmark)) return;
  for (std::size_t t = 0; t < tracker.tracks().size(); ++t)
    if (tracker.tracks()[t].landmark == landmark && static_cast<int>(t) != keeper)
      tracker.relabel(static_cast<int>(t), kNoLandmark);
}

/// A track that had no landmark, and whose primitive has now been matched to the map, gets it.
void Localizer::State::label_tracks(const std::vector<Match>& matches) {
  for (MapMatch& found : new_matches)
    for (const Match& match : matches)
      if (match.primitive == found.primitive) {
        tracker.relabel(match.track, found.landmark);
        release(found.landmark, match.track);
        for (Observation& o : observations)
          if (o.primitive == found.primitive) o.track = match.track;
        found.primitive = -1;
        break;
      }
  std::erase_if(new_matches, [](const MapMatch& match) { return match.primitive < 0; });
}

void Localizer::State::start_tracks(const Scene& scene) {
  const std::vector<int>& appeared = tracker.appeared();
  for (const int primitive : appeared) {
    const auto found = std::find_if(new_matches.begin(), new_matches.end(),
                                    [primitive](const MapMatch& match) { return match.primitive == primitive; });
    if (found == new_matches.end()) {
      if (params.method == perception::Method::kDefault || !absolute) tracker.start(scene, primitive, 0.0, kNoLandmark);
      continue;
    }
    // Clerentin et al., sec. 5: the initial matching is given with the mass (.5, 0, .5).
    const std::optional<int> track = history.empty() ? tracker.start_given(scene, primitive, found->landmark)
                                                     : tracker.start(scene, primitive, found->yes, found->landmark);
    if (track) release(found->landmark, *track);
    for (Observation& o : observations)
      if (o.primitive == primitive) o.track = track.value_or(-1);
  }
}

/// A wrong match shows as a residual that the pose does not explain. Once may be bad luck; a track that goes on is
/// somebody else. Under the paper's method a track keeps its landmark as long as it lives.
void Localizer::State::drop_contradicting_landmarks() {
  if (params.method == perception::Method::kPaper) return;
  for (std::size_t k = 0; k < solution.outlier.size(); ++k) {
    const int index = observations[k].track;
    if (index < 0) continue;
    const int id = tracker.tracks()[static_cast<std::size_t>(index)].id;
    if (!solution.outlier[k]) {
      contradictions.erase(id);
    } else if (++contradictions[id] > params.contradictions_allowed) {
      tracker.relabel(index, kNoLandmark);
      contradictions.erase(id);
    }
  }
}

/// What is counted in a row is forgotten with its track.
void Localizer::State::forget_lost_tracks() {
  const std::vector<Track>& tracks = tracker.tracks();
  std::erase_if(contradictions, [&tracks](const auto& entry) {
    return std::none_of(tracks.begin(), tracks.end(), [&entry](const Track& track) {
      return track.id == entry.first && track.state == tracking::TrackState::kTracked;
    });
  });
}

Localization Localizer::State::report(const Scene& scene) const {
  Localization fix;
  fix.time = scene.time;
  fix.estimate = estimate();
  fix.tracked = static_cast<int>(tracker.tracks().size());
  fix.detected = static_cast<int>(scene.primitives.size());
  if (!absolute)
    fix.reason = map.empty() ? "no floor plan: the pose is relative to the start"
                             : "no initial pose: the pose is relative to the start";
  return fix;
}

/// How far off the pose can be.
Integrity Localizer::State::watch() {
  constexpr double kUntracked = 0.5;  // BetP of not knowing
  landmark_beliefs.clear();
  for (const Observation& o : observations) {
    const bool tracked = o.track >= 0;
    landmark_beliefs.push_back(tracked ? tracker.tracks()[static_cast<std::size_t>(o.track)].existence.pignistic()
                                       : kUntracked);
  }
  return monitor.assess(solution, landmark_beliefs);
}

/// Belief and status of an absolute pose. Where nothing is seen there is no evidence against it: what was believed
/// fades into not knowing. The paper's method knows its p + 2 criteria alone.
void Localizer::State::weigh(const Scene& scene, Localization& fix) {
  evidence.tracks = tracker.tracks();
  const bool on_plan = evidence.scan_agreement && agreement_belief(evidence, params.belief).no < 0.5;
  unchecked = on_plan ? 0 : unchecked + 1;
  const evidence::BinaryMass before = history.empty() ? evidence::BinaryMass::vacuous() : history.latest().belief;
  const bool paper = params.method == perception::Method::kPaper;
  const evidence::FusedBinaryMass belief =
      scene.primitives.empty() && !paper
          ? evidence::FusedBinaryMass{evidence::discount(before, params.blind_reliability), 0.0}
          : localization_belief(evidence, params.belief);
  fix.belief = belief.mass;
  fix.conflict = belief.conflict;
  fix.matched = matched_before = evidence.matched;
  fix.innovation = solution.prior_mahalanobis_squared;
  if (!paper && fix.innovation > params.status.max_innovation)
    fix.belief = evidence::discount(fix.belief, params.contradiction_reliability);
  if (!paper && unchecked > params.checked_for)
    fix.belief = evidence::discount(fix.belief, params.unchecked_reliability);
  fix.unrecognised = recognition_belief(evidence, params.belief).no > 0.0;
  fix.off_plan = agreement_belief(evidence, params.belief).no > 0.0;
  const Integrity integrity = watch();
  fix.protection = integrity.protection;
  if (fix.unrecognised || fix.off_plan) {
    current.independent += doubt();
    fix.estimate = estimate();
  }
  judge(fix, scene.camera_seen, scene.range_finder_seen, params.status);
}

void Localizer::State::remember(const Localization& fix) {
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

Localization Localizer::update(const Scene& scene, const std::optional<PoseEstimate>& motion) {
  State& s = *state_;
  // 1. Predict the pose and where the tracks should be seen.
  const PoseEstimate step = s.predict(scene, motion);

  // 2. Associate the primitives with the tracks.
  const std::vector<Match>& matches = s.tracker.associate(scene);

  s.new_matches.clear();
  if (s.absolute) {
    // 3. The pose from what is matched.
    const SplitPose predicted = s.history.empty() ? s.current : moved(s.current, step);
    s.current = predicted;
    s.observe_tracks(scene, matches);
    s.solve(scene, predicted);
    // 4. The map for what has appeared, and the pose again.
    s.match_map(scene, predicted);
    s.search_pose(scene, predicted, motion.has_value());
    s.label_tracks(matches);
  } else {
    s.solve_motion(scene, matches, step);
  }
  // 5. Start tracks; let go of landmarks that contradict the pose.
  s.start_tracks(scene);
  if (s.absolute) s.drop_contradicting_landmarks();
  s.tracker.update(scene);
  s.forget_lost_tracks();

  // 6. Beliefs and status.
  Localization fix = s.report(scene);
  if (s.absolute) s.weigh(scene, fix);
  s.remember(fix);
  return fix;
}

evidence::Believed<PoseEstimate> Localizer::pose_at(Timestamp time) const {
  const State& s = *state_;
  if (s.history.empty()) return {s.estimate(), evidence::BinaryMass::vacuous()};
  return s.history.pose_at(time);
}

const std::vector<Track>& Localizer::tracks() const { return state_->tracker.tracks(); }
const std::vector<Observation>& Localizer::observations() const { return state_->observations; }
const PoseSolution& Localizer::solution() const { return state_->solution; }
const LandmarkMap& Localizer::map() const { return state_->map; }
const LocalizerParams& Localizer::params() const { return state_->params; }

}  // namespace credo::localization
