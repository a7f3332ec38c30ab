// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "tracking/association.hpp"

#include <algorithm>
#include <cmath>

namespace credo::tracking {
namespace {

using evidence::BinaryMass;
using evidence::MatchDecision;
using perception::PrimitiveType;

constexpr double kCertain = 40.0;             // a finite weight for a match without doubt
constexpr std::size_t kUsual = 256;           // tracks or primitives
constexpr std::size_t kUsualOptions = 4096;   // of all tracks
constexpr std::size_t kUsualCandidates = 64;  // of one track

// Only what speaks for the match is discounted: a landmark of another type in another place is as far away as any.
BinaryMass less_sure(const BinaryMass& mass, double reliability) {
  const double yes = reliability * mass.yes;
  return {.yes = yes, .no = mass.no, .unknown = mass.unknown + (mass.yes - yes)};
}

void add_floors(PolarPoint& point, const AssociationParams& params) {
  const double sideways = params.floor_position_m * point.inverse_range;
  const double inverse = sideways * point.inverse_range;
  point.covariance(0, 0) += params.floor_azimuth_rad * params.floor_azimuth_rad + sideways * sideways;
  point.covariance(1, 1) += inverse * inverse;
}

}  // namespace

Associator::Associator() {
  matcher_.reserve(kUsualCandidates);
  assigner_.reserve(kUsual, kUsual, kUsualOptions);
  options_.reserve(kUsualOptions);
  candidates_.reserve(kUsualOptions);
  first_option_.reserve(kUsual + 1);
  row_.reserve(kUsual);
  row_primitives_.reserve(kUsual);
  column_of_track_.reserve(kUsual);
  track_of_column_.reserve(kUsual);
  points_.reserve(kUsual);
  walls_.reserve(kUsual);
  polarities_.reserve(kUsual);
  ambiguous_.reserve(kUsual);
  dropped_.reserve(kUsual);
  outcomes_.reserve(kUsual);
}

const std::vector<Outcome>& Associator::associate(std::span<const Expected> tracks, const perception::Scene& scene,
                                                  perception::Method method, const AssociationParams& params,
                                                  const PredictionParams& prediction) {
  const bool paper = method == perception::Method::kPaper;
  const int track_count = static_cast<int>(tracks.size()), primitives = static_cast<int>(scene.primitives.size());
  outcomes_.assign(tracks.size(), {});
  options_.clear();
  first_option_.clear();
  if (!paper) see(scene, params, prediction);
  for (const Expected& track : tracks) {
    first_option_.push_back(static_cast<int>(options_.size()));
    if (paper) {
      compare_azimuths(track, scene, params);
    } else if (track.type == PrimitiveType::kWall) {
      compare_walls(track, scene, params);
    } else {
      compare_points(track, scene, params);
    }
  }
  first_option_.push_back(static_cast<int>(options_.size()));
  if (paper) {
    decide_as_the_paper(track_count, primitives);
  } else {
    decide_by_plausibility(track_count, primitives, params.min_margin);
  }
  return outcomes_;
}

bool Associator::claimed_by(int track, int primitive) const {
  const Option* const o = option(track, primitive);
  return o && o->weight > 0.0;
}

std::span<const Associator::Option> Associator::options(int track) const {
  return {options_.data() + first_option_[track], options_.data() + first_option_[track + 1]};
}

const Associator::Option* Associator::option(int track, int primitive) const {
  const auto row = options(track);
  const auto found = std::ranges::find(row, primitive, &Option::primitive);
  return found != row.end() ? &*found : nullptr;
}

// ---------------------------------------------------------------------------------------------- evidence of the pairs

void Associator::see(const perception::Scene& scene, const AssociationParams& params,
                     const PredictionParams& prediction) {
  points_.clear();
  walls_.clear();
  polarities_.clear();
  any_bearing_only_ = false;
  for (const perception::Primitive& primitive : scene.primitives) {
    const bool wall = primitive.type == PrimitiveType::kWall;
    PolarPoint point = seen_point(primitive, Eigen::Vector2d::Zero(), prediction);
    add_floors(point, params);
    points_.push_back(point);
    walls_.push_back(wall ? wall_line(primitive.line, primitive.extent) : WallLine{});
    polarities_.push_back(polarity_of(primitive, scene));
    any_bearing_only_ |= primitive.bearing_only;
  }
}

void Associator::compare_azimuths(const Expected& track, const perception::Scene& scene,
                                  const AssociationParams& params) {
  for (int i = 0; i < static_cast<int>(scene.primitives.size()); ++i) {
    const perception::Primitive& primitive = scene.primitives[i];
    if (primitive.type != track.type) continue;
    const double difference = geometry::angle_difference(primitive.azimuth, track.prediction->point.azimuth);
    options_.push_back({.primitive = i, .evidence = params.azimuth_deg(geometry::to_degrees(std::abs(difference)))});
  }
}

void Associator::compare_points(const Expected& track, const perception::Scene& scene,
                                const AssociationParams& params) {
  const PolarPoint& from_base = track.prediction->point;
  const PolarPoint from_camera = any_bearing_only_ ? seen_from(from_base, scene.camera_origin) : from_base;
  const double gate = params.sigmas.no_full_from * params.sigmas.no_full_from;
  for (int i = 0; i < static_cast<int>(scene.primitives.size()); ++i) {
    const perception::Primitive& primitive = scene.primitives[i];
    if (primitive.type == PrimitiveType::kWall) continue;
    const PolarPoint& expected = primitive.bearing_only ? from_camera : from_base;
    // Most are too far off by their azimuths, whatever their ranges.
    const double off = geometry::angle_difference(points_[i].azimuth, expected.azimuth);
    if (off * off > gate * (points_[i].covariance(0, 0) + expected.covariance(0, 0))) continue;
    const double sigmas = distance_in_sigmas(points_[i], expected, !primitive.bearing_only);
    if (!(sigmas < params.sigmas.no_full_from)) continue;
    double reliability = 1.0;
    if (primitive.type != track.type) reliability *= params.reliability_of_other_type;
    if (polarities_[i] * track.polarity < 0) reliability *= params.reliability_of_other_polarity;
    const BinaryMass evidence = less_sure(params.sigmas(sigmas), reliability);
    options_.push_back({i, evidence, std::min(kCertain, evidence::assignment_weight(evidence))});
  }
}

void Associator::compare_walls(const Expected& track, const perception::Scene& scene, const AssociationParams& params) {
  const std::size_t first = options_.size();
  const WallLine& expected = track.prediction->wall;
  for (int i = 0; i < static_cast<int>(scene.primitives.size()); ++i) {
    if (scene.primitives[i].type != PrimitiveType::kWall) continue;
    const WallLine seen = aligned_with(walls_[i], expected);
    const WallDifference apart = difference(seen, expected);
    const double sigmas = distance_in_sigmas(seen, expected, apart, params.wall_floors);
    if (!(sigmas < params.sigmas.no_full_from)) continue;
    const BinaryMass evidence = params.sigmas(sigmas);
    options_.push_back({i, evidence, std::min(kCertain, evidence::assignment_weight(evidence)), apart.overlap});
  }
  keep_one_piece_per_face(first);
}

// A wall that is seen in two pieces, something standing before it, is no ambiguity: either piece is the wall. The one
// that shares more with the prediction continues the track. Walls that stand one behind the other share directions,
// pieces do not.
void Associator::keep_one_piece_per_face(std::size_t first) {
  const std::size_t count = options_.size() - first;
  if (count < 2) return;
  dropped_.assign(count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < count; ++j) {
      const Option &a = options_[first + i], &b = options_[first + j];
      if (i == j || dropped_[i] || dropped_[j] || a.overlap <= 0.0 || b.overlap <= 0.0 || a.weight <= 0.0) continue;
      const WallLine& wall = walls_[a.primitive];
      const bool pieces = difference(aligned_with(walls_[b.primitive], wall), wall).overlap <= 0.0;
      if (pieces && (a.overlap > b.overlap || (a.overlap == b.overlap && i < j))) dropped_[j] = 1;
    }
  }
  std::size_t kept = first;
  for (std::size_t i = 0; i < count; ++i) {
    if (!dropped_[i]) options_[kept++] = options_[first + i];
  }
  options_.resize(kept);
}

// ---------------------------------------------------------------------------------------------- decisions

void Associator::decide_as_the_paper(int tracks, int primitives) {
  candidates_.clear();
  for (int track = 0; track < tracks; ++track) {
    row_.clear();
    for (const Option& o : options(track)) row_.push_back(o.evidence);
    matcher_.combine(row_);
    outcomes_[track].kind = matcher_.decide_by_mass().kind;
    if (outcomes_[track].kind != MatchDecision::kMatched) continue;
    const evidence::OpenWorldMasses& mass = matcher_.normalised();
    const int first = first_option_[track];
    for (std::size_t i = 0; i < row_.size(); ++i) {
      options_[first + i].weight = mass.match[i];
      candidates_.push_back({track, options_[first + i].primitive, mass.match[i] - mass.none});
    }
  }
  const std::vector<int>& assigned = assigner_.assign(tracks, primitives, candidates_);
  for (int track = 0; track < tracks; ++track) {
    if (outcomes_[track].kind != MatchDecision::kMatched) continue;
    if (assigned[track] < 0) {
      outcomes_[track].kind = MatchDecision::kNone;
    } else {
      outcomes_[track].primitive = assigned[track];
      outcomes_[track].match_yes = option(track, assigned[track])->weight;
    }
  }
}

void Associator::decide_by_plausibility(int tracks, int primitives, double min_margin) {
  candidates_.clear();
  for (int track = 0; track < tracks; ++track) {
    for (const Option& o : options(track)) candidates_.push_back({track, o.primitive, o.weight});
  }
  column_of_track_ = assigner_.assign(tracks, primitives, candidates_);
  track_of_column_.assign(primitives, -1);
  for (int track = 0; track < tracks; ++track) {
    if (column_of_track_[track] >= 0) track_of_column_[column_of_track_[track]] = track;
  }
  for (int track = 0; track < tracks; ++track) decide_among_what_is_left(track, min_margin);
  withhold_near_ties(min_margin);
}

void Associator::decide_among_what_is_left(int track, double min_margin) {
  row_.clear();
  row_primitives_.clear();
  for (const Option& o : options(track)) {
    const int owner = track_of_column_[o.primitive];
    if (owner >= 0 && owner != track) continue;
    row_.push_back(o.evidence);
    row_primitives_.push_back(o.primitive);
  }
  matcher_.combine(row_);
  const evidence::OpenWorldDecision decision = matcher_.decide_by_pignistic(min_margin);
  Outcome& outcome = outcomes_[track];
  outcome.kind = decision.kind;
  if (decision.kind != MatchDecision::kMatched) return;
  if (row_primitives_[decision.candidate] != column_of_track_[track]) {
    outcome.kind = MatchDecision::kUndecided;  // the two readings of the same evidence differ
    return;
  }
  outcome.primitive = column_of_track_[track];
  outcome.match_yes = matcher_.normalised().match[static_cast<std::size_t>(decision.candidate)];
}

double Associator::best_free_weight(int track) const {
  double best = 0.0;
  for (const Option& o : options(track)) {
    if (track_of_column_[o.primitive] < 0) best = std::max(best, o.weight);
  }
  return best;
}

// Two relations whose plausibilities, normalised among themselves, differ by less than the margin: ln of their ratio is
// below 2 atanh(margin). Relations that differ by an exchange between two tracks are looked at.
void Associator::withhold_near_ties(double min_margin) {
  const double near = 2.0 * std::atanh(std::min(min_margin, 0.999));
  ambiguous_.assign(outcomes_.size(), 0);
  for (int rival = 0; rival < static_cast<int>(outcomes_.size()); ++rival) {
    const int own = column_of_track_[rival];
    for (const Option& wanted : options(rival)) {
      const int owner = track_of_column_[wanted.primitive];
      if (owner < 0 || owner == rival || wanted.weight <= 0.0) continue;
      const Option* const owned = option(owner, wanted.primitive);
      // Two pieces of one wall have become one: either track is the wall's.
      if (wanted.overlap > 0.0 && owned->overlap > 0.0) continue;
      const Option* const in_exchange = own >= 0 ? option(owner, own) : nullptr;
      const double now = owned->weight + (own >= 0 ? option(rival, own)->weight : 0.0);
      const double instead = wanted.weight + std::max(in_exchange ? in_exchange->weight : 0.0, best_free_weight(owner));
      if (now - instead < near) ambiguous_[owner] = ambiguous_[rival] = 1;
    }
  }
  for (std::size_t track = 0; track < outcomes_.size(); ++track) {
    if (ambiguous_[track]) outcomes_[track].kind = MatchDecision::kUndecided;
  }
}

}  // namespace credo::tracking
