// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/localizer.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

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

/// Where something lies that is no landmark.
enum class PlanAgreement {
  kOnPlan,  ///< on a wall of the plan
  kBefore,  ///< where the plan has free space
  kBehind   ///< behind a wall of the plan: it cannot be seen there
};

/// A pose at an acquisition, with the belief in it.
struct Fix {
  Timestamp time = 0;
  PoseEstimate estimate;
  evidence::BinaryMass belief;
};

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

LocalizerParams LocalizerParams::with_method(perception::Method chosen) const {
  LocalizerParams params = *this;
  params.method = params.tracker.method = params.matching.method = params.belief.method = chosen;
  params.map.cut_walls_at_points = chosen == perception::Method::kPaper;
  return params;
}

struct Localizer::State {
  State(const geometry::FloorPlan& plan, const sensors::Rig& rig, const std::optional<PoseEstimate>& initial,
        const LocalizerParams& p)
      : params(p.with_method(p.method)),
        map(plan, params.map),
        later_matcher(map, params.matching),
        first_matcher(map, initial_matching(params.matching)),
        solver(rig, params.solver),
        tracker(params.tracker),
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
  tracking::Tracker tracker;
  bool absolute;  ///< poses are in the map frame, not relative to the start
  bool started = false;
  bool doubted = false;  ///< much that should have been seen from the latest fix was not
  SplitPose current;
  Fix latest;
  std::optional<Fix> before;
  MotionPredictor predictor;
  sensors::MotionPath path;
  std::map<int, int> contradictions;  ///< in a row, by track id

  // One update's workspace.
  std::vector<Observation> observations;
  std::vector<bool> wall_in_use;
  std::vector<int> unmatched;
  std::vector<LandmarkId> taken;
  std::vector<MapMatch> new_matches;

  [[nodiscard]] PoseEstimate predicted_motion(const std::optional<PoseEstimate>& motion, Timestamp time) const;
  [[nodiscard]] Matrix3d doubt() const;
  [[nodiscard]] PoseEstimate estimate() const { return {current.pose, current.covariance()}; }
  void expect_landmarks(const SplitPose& predicted);
  void expect_young_tracks(const Pose2& step);
  [[nodiscard]] Pose2 likeliest_first_step(const Scene& scene);
  void observe_tracks(const Scene& scene, const std::vector<Match>& matches);
  void observe_landmark(const Scene& scene, int primitive, LandmarkId landmark, int track);
  void list_unmatched(const Scene& scene);
  void match_map(const Scene& scene, const SplitPose& predicted);
  void solve(const Scene& scene, const SplitPose& predicted);
  void label_tracks(const std::vector<Match>& matches);
  void release(LandmarkId landmark, int keeper);
  void start_tracks(const Scene& scene);
  void drop_contradicting_landmarks(const PoseSolution& solution);
  void forget_lost_tracks();
  void update_motion_only(const Scene& scene, const std::vector<Match>& matches, const PoseEstimate& motion);
  [[nodiscard]] PlanAgreement agreement_of(const Primitive& primitive) const;
  void count_points_in_sight(const Scene& scene, LocalizationEvidence& evidence) const;
  [[nodiscard]] LocalizationEvidence weigh(const Scene& scene) const;
  [[nodiscard]] Localization report(const Scene& scene) const;
};

/// Odometry's motion; else what the latest velocity predicts.
PoseEstimate Localizer::State::predicted_motion(const std::optional<PoseEstimate>& motion, Timestamp time) const {
  if (motion && (params.method == perception::Method::kDefault || !absolute)) return *motion;
  return predictor.predict(sensors::seconds_between(latest.time, time));
}

/// What is added to the motion's covariance after a fix from which the plan is not recognised: wheels may have slipped.
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
    Eigen::Matrix<double, 2, 3> by_pose;
    by_pose.leftCols<2>() = -predicted.pose.rotation().transpose();
    by_pose.col(2) = Vector2d(p.y(), -p.x());
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
    if (tracks[t].hits > 1 || tracks[t].last_seen_time != latest.time) continue;
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

/// What the tracks continue; walls first, so that points know which walls are in use.
void Localizer::State::observe_tracks(const Scene& scene, const std::vector<Match>& matches) {
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
  std::vector<bool> used(scene.primitives.size(), false);
  for (const Observation& o : observations) {
    used[static_cast<std::size_t>(o.primitive)] = true;
    if (!map.is_wall(o.landmark)) taken.push_back(o.landmark);
  }
  for (std::size_t p = 0; p < used.size(); ++p)
    if (!used[p]) unmatched.push_back(static_cast<int>(p));
}

void Localizer::State::solve(const Scene& scene, const SplitPose& predicted) {
  current = solver.solve(predicted, observations, scene.carry_covariance).pose;
}

/// What continues no track of the map is matched to the map, walls before points, from a pose that every round knows
/// better.
void Localizer::State::match_map(const Scene& scene, const SplitPose& predicted) {
  const auto add = [&](const std::vector<MapMatch>& found) {
    for (const MapMatch& match : found) {
      observe_landmark(scene, match.primitive, match.landmark, -1);
      new_matches.push_back(match);
    }
    if (!found.empty()) solve(scene, predicted);
    return !found.empty();
  };
  new_matches.clear();
  MapMatcher& matcher = started ? later_matcher : first_matcher;
  for (int round = 0; round < params.matching_rounds; ++round) {
    list_unmatched(scene);
    const bool walls = add(matcher.match_walls(scene, unmatched, estimate()));
    list_unmatched(scene);
    const bool points = add(matcher.match_points(scene, unmatched, estimate(), taken));
    if (!walls && !points) break;
  }
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
    const std::optional<int> track = started ? tracker.start(scene, primitive, found->yes, found->landmark)
                                             : tracker.start_given(scene, primitive, found->landmark);
    if (track) release(found->landmark, *track);
    for (Observation& o : observations)
      if (o.primitive == primitive) o.track = track.value_or(-1);
  }
}

/// A wrong match shows as a residual that the pose does not explain. Once may be bad luck; a track that goes on is
/// somebody else.
void Localizer::State::drop_contradicting_landmarks(const PoseSolution& solution) {
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

/// Without a plan or an initial pose: the motion from what the tracks saw in both scenes, with odometry as the prior.
void Localizer::State::update_motion_only(const Scene& scene, const std::vector<Match>& matches,
                                          const PoseEstimate& motion) {
  observations.clear();
  for (const Match& match : matches) {
    const Track& track = tracker.tracks()[static_cast<std::size_t>(match.track)];
    const Primitive& now = scene.primitives[static_cast<std::size_t>(match.primitive)];
    if (track.last_seen_time != latest.time || now.bearing_only || track.last_seen.bearing_only ||
        (now.type == PrimitiveType::kWall) != (track.last_seen.type == PrimitiveType::kWall))
      continue;
    observations.push_back(observe_again(now, track.last_seen, params.observations));
    observations.back().primitive = match.primitive;
  }
  const SplitPose prior{motion.pose, motion.covariance, Matrix3d::Zero()};
  const PoseSolution& solution = solver.solve(prior, observations, scene.carry_covariance);
  current = moved(current, {solution.pose.pose, solution.pose.covariance()});
}

/// Points of the plan that should be seen from the pose, and those that are. Marks without relief are the camera's
/// alone.
void Localizer::State::count_points_in_sight(const Scene& scene, LocalizationEvidence& evidence) const {
  const Vector2d viewpoint = current.pose.translation();
  for (std::size_t k = 0; k < map.points().size(); ++k) {
    const PointLandmark& point = map.points()[k];
    const bool hidden = (point.position - viewpoint).norm() > params.sight_m ||
                        !(point.vertical ? scene.camera_seen : scene.camera_seen || scene.range_finder_seen) ||
                        !map.type_from(point, viewpoint) ||
                        !map.sees(viewpoint, point.position, params.matching.visibility_margin_m);
    if (hidden) continue;
    ++evidence.in_sight;
    for (std::size_t i = 0; i < observations.size(); ++i) {
      if (observations[i].landmark != map.point_id(k) || solver.solution().outlier[i]) continue;
      ++evidence.recognised;
      break;
    }
  }
}

/// What the belief rests on. Under the default method a primitive counts against the localization as far as the plan
/// denies it: in full where it stands behind a wall, little where something may have been put before one, and not at
/// all where it lies on a wall of the plan, as the face of a curve or a mark that the plan does not list does.
LocalizationEvidence Localizer::State::weigh(const Scene& scene) const {
  LocalizationEvidence evidence;
  evidence.tracks = tracker.tracks();
  count_points_in_sight(scene, evidence);
  std::vector<bool> explained(scene.primitives.size(), false);
  for (std::size_t k = 0; k < observations.size(); ++k)
    if (!solver.solution().outlier[k]) explained[static_cast<std::size_t>(observations[k].primitive)] = true;
  for (std::size_t p = 0; p < explained.size(); ++p) {
    const Primitive& primitive = scene.primitives[p];
    evidence.matched += explained[p] ? 1 : 0;
    if (params.method == perception::Method::kPaper) {
      evidence.detected += 1.0;
      evidence.explained += explained[p] ? 1.0 : 0.0;
      continue;
    }
    if (primitive.bearing_only) continue;
    const double believed = primitive.existence.pignistic();
    const PlanAgreement agreement = explained[p] ? PlanAgreement::kOnPlan : agreement_of(primitive);
    if (agreement == PlanAgreement::kOnPlan) {
      if (primitive.type == PrimitiveType::kOther && !explained[p]) continue;
      // A junction that the plan does not have where it has a wall is a contradiction, unless the wall is a curve.
      const bool junction = primitive.type == PrimitiveType::kCorner || primitive.type == PrimitiveType::kEdge;
      const double weight = believed * (explained[p] ? 1.0 : params.on_plan_weight);
      evidence.detected += weight;
      evidence.explained += explained[p] || !junction ? weight : 0.0;
    } else {
      evidence.detected += believed * (agreement == PlanAgreement::kBefore ? params.unmapped_weight : 1.0);
    }
  }
  return evidence;
}

PlanAgreement Localizer::State::agreement_of(const Primitive& primitive) const {
  const Vector2d viewpoint = current.pose.translation();
  const Vector2d seen = current.pose * primitive.position;
  const Matrix3d P = current.covariance();
  const double sigma =
      std::sqrt(P(0, 0) + P(1, 1) + P(2, 2) * primitive.range_m * primitive.range_m +
                primitive.sigma_range_m * primitive.sigma_range_m + map.uncertainty_m() * map.uncertainty_m());
  const double tolerance =
      std::clamp(params.on_plan_sigmas * sigma, params.on_plan_m, std::max(params.on_plan_m, params.on_plan_at_most_m));
  if (map.distance_to_surface(seen) <= tolerance) return PlanAgreement::kOnPlan;
  return map.sees(viewpoint, seen, tolerance) ? PlanAgreement::kBefore : PlanAgreement::kBehind;
}

Localization Localizer::State::report(const Scene& scene) const {
  Localization fix;
  fix.time = scene.time;
  fix.estimate = estimate();
  fix.tracked = static_cast<int>(tracker.tracks().size());
  fix.detected = static_cast<int>(scene.primitives.size());
  return fix;
}

Localizer::Localizer(const geometry::FloorPlan& plan, const sensors::Rig& rig,
                     const std::optional<PoseEstimate>& initial, const LocalizerParams& params)
    : state_(std::make_unique<State>(plan, rig, initial, params)) {}
Localizer::~Localizer() = default;
Localizer::Localizer(Localizer&&) noexcept = default;
Localizer& Localizer::operator=(Localizer&&) noexcept = default;

void Localizer::with_path(sensors::Acquisition& acquisition) {
  State& s = *state_;
  if (acquisition.path.empty() && s.started) {
    const Pose2 step = s.predicted_motion(std::nullopt, acquisition.time).pose;
    acquisition.path =
        sensors::MotionPath({{s.latest.time, {}}, {std::max(acquisition.time, s.latest.time + 1), step}});
  }
  s.path = acquisition.path;
}

Localization Localizer::update(const Scene& scene, const std::optional<PoseEstimate>& motion) {
  State& s = *state_;
  // 1. Predict the pose and where the tracks should be seen.
  const bool moves = s.started;
  const bool paper = s.params.method == perception::Method::kPaper;
  PoseEstimate step = s.predicted_motion(motion, scene.time);
  if (!paper && !motion && s.started)
    step.pose.theta += unforeseen_turn(s.tracker.tracks(), s.latest.time, scene, step.pose, s.params.constant_velocity);
  s.tracker.predict(!paper && moves ? std::optional(step) : std::nullopt);
  if (s.absolute && paper && moves && s.predictor.empty()) step.pose = s.likeliest_first_step(scene);
  if (s.doubted) step.covariance += s.doubt();
  const SplitPose predicted = moves ? moved(s.current, step) : s.current;
  if (s.absolute && paper) s.expect_young_tracks(step.pose);
  if (s.absolute && !paper) s.expect_landmarks(predicted);

  // 2. Associate the primitives with the tracks.
  const std::vector<Match>& matches = s.tracker.associate(scene);

  Localization fix;
  if (s.absolute) {
    // 3. The pose from what is matched; 4. the map for what has appeared, and the pose again.
    s.current = predicted;
    for (const Match& match :
         matches)  // a wall's track that goes on as a junction, or the reverse, is another landmark
      if (match.transition) s.tracker.relabel(match.track, kNoLandmark);
    s.observe_tracks(scene, matches);
    s.solve(scene, predicted);
    s.match_map(scene, predicted);
    const PoseSolution& solution = s.solver.solution();
    s.label_tracks(matches);
    // 5. Start tracks, let go of landmarks that contradict the pose.
    s.start_tracks(scene);
    s.drop_contradicting_landmarks(solution);
    s.tracker.update(scene);
    s.forget_lost_tracks();
    // 6. Beliefs and status.
    fix = s.report(scene);
    const LocalizationEvidence evidence = s.weigh(scene);
    // Nothing seen is no evidence against the pose: what was believed fades into not knowing.
    const evidence::FusedBinaryMass belief =
        scene.primitives.empty()
            ? evidence::FusedBinaryMass{evidence::discount(s.latest.belief, s.params.blind_reliability), 0.0}
            : localization_belief(evidence, s.params.belief);
    fix.belief = belief.mass;
    fix.conflict = belief.conflict;
    fix.matched = evidence.matched;
    fix.innovation = s.solver.solution().prior_mahalanobis_squared;
    if (fix.innovation > s.params.status.max_innovation)
      fix.belief = evidence::discount(fix.belief, s.params.contradiction_reliability);
    fix.unrecognised = recognition_belief(evidence, s.params.belief).no > 0.0;
    s.doubted = fix.unrecognised;
    judge(fix, scene.camera_seen, scene.range_finder_seen, s.params.status);
  } else {
    if (moves) s.update_motion_only(scene, matches, step);
    s.new_matches.clear();
    s.start_tracks(scene);
    s.tracker.update(scene);
    fix = s.report(scene);
    fix.reason = s.map.empty() ? "no floor plan: the pose is relative to the start"
                               : "no initial pose: the pose is relative to the start";
  }
  s.before = s.started ? std::optional(s.latest) : std::nullopt;
  if (s.before && scene.time > s.before->time) {
    s.predictor.add(s.before->estimate.pose.inverse() * fix.estimate.pose,
                    sensors::seconds_between(s.before->time, scene.time));
  }
  s.latest = {scene.time, fix.estimate, fix.belief};
  s.started = true;
  return fix;
}

evidence::Believed<PoseEstimate> Localizer::pose_at(Timestamp time) const {
  const State& s = *state_;
  if (!s.started) return {{s.current.pose, s.current.covariance()}, evidence::BinaryMass::vacuous()};
  const bool between = s.before && time < s.latest.time && time >= s.before->time;
  const Fix& anchor = between ? *s.before : s.latest;
  PoseEstimate estimate = anchor.estimate;
  estimate.pose = anchor.estimate.pose * s.path.motion(anchor.time, time);
  if (!between) return {estimate, anchor.belief};
  // What the path from the last fix misses of this one is spread over the way.
  const double share =
      sensors::seconds_between(s.before->time, time) / sensors::seconds_between(s.before->time, s.latest.time);
  const Pose2 arrived = s.before->estimate.pose * s.path.motion(s.before->time, s.latest.time);
  const Pose2 missed = arrived.inverse() * s.latest.estimate.pose;
  estimate.pose = estimate.pose * geometry::interpolate({}, missed, share);
  estimate.covariance = (1.0 - share) * s.before->estimate.covariance + share * s.latest.estimate.covariance;
  const bool earlier_is_weaker = s.before->belief.pignistic() < s.latest.belief.pignistic();
  return {estimate, earlier_is_weaker ? s.before->belief : s.latest.belief};
}

const std::vector<Track>& Localizer::tracks() const { return state_->tracker.tracks(); }
const std::vector<Observation>& Localizer::observations() const { return state_->observations; }
const PoseSolution& Localizer::solution() const { return state_->solver.solution(); }
const LandmarkMap& Localizer::map() const { return state_->map; }
const LocalizerParams& Localizer::params() const { return state_->params; }

}  // namespace credo::localization
