// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "tracking/tracker.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace credo::tracking {
namespace {

using evidence::MatchDecision;
using perception::Method;
using perception::PrimitiveType;

/// What the tracker knows of a track beyond what it tells.
struct Companion {
  Memory memory;
  int polarity = 0;
  int undecided_in_a_row = 0;
  PrimitiveType other_type = PrimitiveType::kOther;  // as which it was seen lately, unlike its own
  int other_type_in_a_row = 0;
  bool fresh = false;  // started in the scene at hand
};

/// What becomes of a track in the scene at hand.
struct Fate {
  TrackState state = TrackState::kMissed;
  int primitive = -1;
  double match_yes = 0.0;
  bool transition = false;
};

// A sensor that gave nothing at all is blind; what it cannot see is not missed.
bool blind_for(const Track& track, const perception::Scene& scene) {
  const bool by_camera = track.last_seen.bearing_only;
  if (by_camera ? scene.camera_seen : scene.range_finder_seen) return false;
  return std::ranges::none_of(scene.primitives,
                              [&](const perception::Primitive& seen) { return seen.bearing_only == by_camera; });
}

}  // namespace

struct Tracker::State {
  explicit State(const TrackerParams& tracker_params) : params(tracker_params) {
    constexpr std::size_t kUsual = 256;  // tracks or primitives
    tracks.reserve(kUsual);
    companions.reserve(kUsual);
    fates.reserve(kUsual);
    matches.reserve(kUsual);
    appeared.reserve(kUsual);
    expected.reserve(kUsual);
    taken.reserve(kUsual);
  }

  TrackerParams params;
  std::vector<Track> tracks;
  std::vector<Companion> companions;  // one for each track
  std::vector<Fate> fates;            // of the tracks that were there when the scene came
  std::vector<Match> matches;
  std::vector<int> appeared;
  std::vector<Expected> expected;
  std::vector<char> taken;  // by primitive
  Associator associator;
  Eigen::Vector2d camera_origin = Eigen::Vector2d::Zero();
  int step = 0;
  int next_id = 0;

  void show_prediction(int track);
  void decide(const perception::Scene& scene);
  void find_transitions(const perception::Scene& scene);
  [[nodiscard]] int transition_partner(int track, const perception::Scene& scene) const;
  int add(const perception::Scene& scene, int primitive, const evidence::BinaryMass& existence, LandmarkId landmark);
  void see(int track, const perception::Scene& scene, const Fate& fate);
  void adopt_type(int track, const perception::Primitive& primitive, bool transition);
  bool believe(int track, const perception::Scene& scene, const Fate& fate);
};

// ---------------------------------------------------------------------------------------------- prediction

void Tracker::State::show_prediction(int track) {
  const Prediction& now = companions[track].memory.now;
  Track& shown = tracks[track];
  if (shown.type == PrimitiveType::kWall && params.method == Method::kDefault) {
    const Eigen::Vector2d middle = now.wall.middle();
    const double variance = now.wall.covariance(1, 1) + now.wall.variance_along;
    shown.azimuth = std::atan2(middle.y(), middle.x());
    shown.sigma_azimuth = std::sqrt(now.wall.covariance(0, 0) + variance / std::max(middle.squaredNorm(), 1e-4));
    return;
  }
  const PolarPoint point = shown.last_seen.bearing_only ? seen_from(now.point, camera_origin) : now.point;
  shown.azimuth = point.azimuth;
  shown.sigma_azimuth = point.sigma_azimuth();
}

void Tracker::predict(const std::optional<geometry::PoseEstimate>& motion) {
  State& s = *state_;
  ++s.step;
  for (int i = 0; i < static_cast<int>(s.tracks.size()); ++i) {
    tracking::predict(s.companions[i].memory, s.tracks[i].last_seen, motion, s.step, s.params.method,
                      s.params.prediction);
    s.show_prediction(i);
  }
}

void Tracker::expect(int track, double azimuth, double sigma_azimuth) {
  State& s = *state_;
  assert(track >= 0 && track < static_cast<int>(s.tracks.size()));
  PolarPoint& point = s.companions[track].memory.now.point;
  point.azimuth = geometry::wrap_angle(azimuth);
  point.covariance(0, 0) = sigma_azimuth * sigma_azimuth;
  point.covariance(0, 1) = point.covariance(1, 0) = 0.0;
  s.show_prediction(track);
}

void Tracker::expect_point(int track, const Eigen::Vector2d& position, const Eigen::Matrix2d& covariance) {
  State& s = *state_;
  assert(track >= 0 && track < static_cast<int>(s.tracks.size()));
  const double range = std::max(position.norm(), 1e-2);
  const Eigen::Vector2d u = position / range;
  Eigen::Matrix2d by_position;
  by_position << -u.y() / range, u.x() / range, -u.x() / (range * range), -u.y() / (range * range);
  PolarPoint& point = s.companions[track].memory.now.point;
  point.azimuth = std::atan2(position.y(), position.x());
  point.inverse_range = 1.0 / range;
  point.covariance = by_position * covariance * by_position.transpose();
  s.show_prediction(track);
}

// ---------------------------------------------------------------------------------------------- association

const std::vector<Match>& Tracker::associate(const perception::Scene& scene) {
  State& s = *state_;
  s.camera_origin = scene.camera_origin;
  s.expected.clear();
  for (std::size_t i = 0; i < s.tracks.size(); ++i) {
    s.expected.push_back({s.tracks[i].type, s.companions[i].polarity, &s.companions[i].memory.now});
    s.companions[i].fresh = false;
  }
  s.decide(scene);
  s.find_transitions(scene);
  s.matches.clear();
  for (int i = 0; i < static_cast<int>(s.fates.size()); ++i) {
    const Fate& fate = s.fates[i];
    if (fate.state == TrackState::kTracked) s.matches.push_back({i, fate.primitive, fate.match_yes, fate.transition});
  }
  s.appeared.clear();
  for (int p = 0; p < static_cast<int>(scene.primitives.size()); ++p) {
    if (!s.taken[p]) s.appeared.push_back(p);
  }
  return s.matches;
}

void Tracker::State::decide(const perception::Scene& scene) {
  const std::vector<Outcome>& outcomes =
      associator.associate(expected, scene, params.method, params.association, params.prediction);
  fates.assign(tracks.size(), {});
  taken.assign(scene.primitives.size(), 0);
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const Outcome& outcome = outcomes[i];
    const bool blind =
        outcome.kind == MatchDecision::kNone && params.method == Method::kDefault && blind_for(tracks[i], scene);
    const bool undecided = outcome.kind == MatchDecision::kUndecided || blind;
    if (undecided && companions[i].undecided_in_a_row < params.max_undecided_in_a_row) {
      fates[i].state = TrackState::kUndecided;
    } else if (outcome.kind != MatchDecision::kNone && outcome.primitive >= 0) {
      // Matched; or two tracks have been too much alike for too long, and the most plausible assignment has the word.
      fates[i] = {.state = TrackState::kTracked, .primitive = outcome.primitive, .match_yes = outcome.match_yes};
      taken[outcome.primitive] = 1;
    }
  }
  for (int i = 0; i < static_cast<int>(tracks.size()); ++i) {
    if (fates[i].state != TrackState::kUndecided) continue;
    for (int p = 0; p < static_cast<int>(taken.size()); ++p) {
      if (!taken[p] && associator.claimed_by(i, p)) taken[p] = 1;
    }
  }
}

// Only tracks that would be missed and primitives that would be new: a wall and the corner at its end can both be seen.
void Tracker::State::find_transitions(const perception::Scene& scene) {
  for (int i = 0; i < static_cast<int>(tracks.size()); ++i) {
    if (fates[i].state != TrackState::kMissed) continue;
    const int partner = transition_partner(i, scene);
    if (partner < 0) continue;
    fates[i] = {.state = TrackState::kTracked, .primitive = partner, .match_yes = 0.0, .transition = true};
    taken[partner] = 1;
  }
}

int Tracker::State::transition_partner(int track, const perception::Scene& scene) const {
  const Prediction& now = companions[track].memory.now;
  const bool wall = tracks[track].type == PrimitiveType::kWall;
  if (!wall && tracks[track].last_seen.bearing_only) return -1;
  const double slack = now.unmoved || params.method == Method::kPaper ? params.transition.unmoved_m : 0.0;
  int partner = -1;
  double nearest = std::numeric_limits<double>::infinity();
  for (int p = 0; p < static_cast<int>(scene.primitives.size()); ++p) {
    const perception::Primitive& seen = scene.primitives[p];
    const bool seen_wall = seen.type == PrimitiveType::kWall;
    if (taken[p] || seen.bearing_only || seen_wall == wall) continue;
    const std::optional<double> distance =
        wall ? distance_from_end(now.wall, seen_junction(seen, scene), slack, params.transition)
             : distance_from_end(wall_line(seen.line, seen.extent),
                                 Junction{now.point.position(), now.faces, now.known_faces}, slack, params.transition);
    if (distance && *distance < nearest) nearest = *distance, partner = p;
  }
  return partner;
}

const std::vector<int>& Tracker::appeared() const { return state_->appeared; }

// ---------------------------------------------------------------------------------------------- life

int Tracker::State::add(const perception::Scene& scene, int primitive, const evidence::BinaryMass& existence,
                        LandmarkId landmark) {
  const perception::Primitive& seen = scene.primitives[primitive];
  Track& track = tracks.emplace_back();
  track.id = next_id++;
  track.type = seen.type;
  track.existence = existence;
  track.landmark = landmark;
  companions.emplace_back().fresh = true;
  see(static_cast<int>(tracks.size()) - 1, scene, {.state = TrackState::kTracked, .primitive = primitive});
  if (primitive < static_cast<int>(taken.size())) taken[primitive] = 1;
  return static_cast<int>(tracks.size()) - 1;
}

std::optional<int> Tracker::start(const perception::Scene& scene, int primitive, double match_yes,
                                  LandmarkId landmark) {
  State& s = *state_;
  assert(primitive >= 0 && primitive < static_cast<int>(scene.primitives.size()));
  const auto belief = evidence::start_track(scene.primitives[primitive].existence, match_yes, s.params.belief);
  if (!belief || !belief->keep) return std::nullopt;
  return s.add(scene, primitive, belief->mass, landmark);
}

int Tracker::start_given(const perception::Scene& scene, int primitive, LandmarkId landmark) {
  assert(primitive >= 0 && primitive < static_cast<int>(scene.primitives.size()));
  return state_->add(scene, primitive, state_->params.given, landmark);
}

void Tracker::relabel(int track, LandmarkId landmark) {
  assert(track >= 0 && track < static_cast<int>(state_->tracks.size()));
  state_->tracks[track].landmark = landmark;
}

void Tracker::update(const perception::Scene& scene) {
  State& s = *state_;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < s.tracks.size(); ++i) {
    if (!s.companions[i].fresh && !s.believe(static_cast<int>(i), scene, s.fates[i])) continue;
    s.companions[i].fresh = false;
    if (kept != i) {
      s.tracks[kept] = std::move(s.tracks[i]);
      s.companions[kept] = std::move(s.companions[i]);
    }
    ++kept;
  }
  s.tracks.resize(kept);
  s.companions.resize(kept);
  s.fates.clear();
}

// \returns whether the track lives on
bool Tracker::State::believe(int track, const perception::Scene& scene, const Fate& fate) {
  Track& t = tracks[track];
  Companion& companion = companions[track];
  t.state = fate.state;
  companion.undecided_in_a_row = fate.state == TrackState::kUndecided ? companion.undecided_in_a_row + 1 : 0;
  if (fate.state == TrackState::kUndecided) {
    t.primitive = -1;
    return true;
  }
  std::optional<evidence::TrackBelief> belief;
  if (fate.state == TrackState::kMissed) {
    t.primitive = -1;
    ++t.misses_in_a_row;
    belief = evidence::miss_track(t.existence, params.belief);
  } else {
    see(track, scene, fate);
    if (fate.transition) return true;
    belief = evidence::update_track(t.existence, t.last_seen.existence, fate.match_yes, params.belief);
  }
  if (!belief) return true;
  t.existence = belief->mass;
  return belief->keep;
}

void Tracker::State::see(int track, const perception::Scene& scene, const Fate& fate) {
  const perception::Primitive& primitive = scene.primitives[fate.primitive];
  Companion& companion = companions[track];
  Track& t = tracks[track];
  if (fate.transition) {
    // From the middle of a face to the junction at its end, or back: another azimuth at much the same rate.
    History azimuths = companion.memory.azimuths;
    azimuths.shift(geometry::angle_difference(primitive.azimuth, companion.memory.now.point.azimuth));
    companion.memory = {.now = {}, .azimuths = azimuths, .wall_angles = {}, .wall_distances = {}};
  }
  observe(companion.memory, primitive, scene, step, companion.fresh || fate.transition, params.prediction);
  companion.polarity = polarity_of(primitive, scene);
  adopt_type(track, primitive, fate.transition);
  t.state = TrackState::kTracked;
  t.azimuth = primitive.azimuth;
  t.sigma_azimuth = primitive.sigma_azimuth;
  t.last_seen = primitive;
  t.last_seen_time = scene.time;
  t.primitive = fate.primitive;
  ++t.hits;
  t.misses_in_a_row = 0;
}

// A corner that is taken for an edge once stays a corner; a bearing alone says nothing about the type.
void Tracker::State::adopt_type(int track, const perception::Primitive& primitive, bool transition) {
  Companion& companion = companions[track];
  Track& t = tracks[track];
  if (transition) {
    t.type = primitive.type;
    companion.other_type_in_a_row = 0;
  } else if (primitive.type == t.type) {
    companion.other_type_in_a_row = 0;
  } else if (!primitive.bearing_only) {
    const bool again = companion.other_type_in_a_row > 0 && companion.other_type == primitive.type;
    companion.other_type_in_a_row = again ? companion.other_type_in_a_row + 1 : 1;
    companion.other_type = primitive.type;
    if (companion.other_type_in_a_row >= params.sightings_to_change_type) {
      t.type = primitive.type;
      companion.other_type_in_a_row = 0;
    }
  }
}

Tracker::Tracker(const TrackerParams& params) : state_((check(params), std::make_unique<State>(params))) {}
Tracker::~Tracker() = default;
Tracker::Tracker(Tracker&&) noexcept = default;
Tracker& Tracker::operator=(Tracker&&) noexcept = default;

const std::vector<Track>& Tracker::tracks() const { return state_->tracks; }

}  // namespace credo::tracking
