// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/pose_error.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "geometry/angles.hpp"

namespace credo::evaluation {
namespace {

using IndexPairs = std::vector<std::pair<std::size_t, std::size_t>>;

const char* name_of(PoseRelation relation) {
  switch (relation) {
    case PoseRelation::kTranslationPart: return "translation part (m)";
    case PoseRelation::kRotationPart: return "rotation part (unit-less)";
    case PoseRelation::kAngleDegrees: return "rotation angle (deg)";
    case PoseRelation::kAngleRadians: return "rotation angle (rad)";
    case PoseRelation::kFull: return "full transformation (unit-less)";
    case PoseRelation::kPointDistance: return "point distance (m)";
  }
  return "";
}

const char* name_of(DeltaUnit unit) {
  switch (unit) {
    case DeltaUnit::kFrames: return "frames";
    case DeltaUnit::kMetres: return "m";
    case DeltaUnit::kDegrees: return "deg";
    case DeltaUnit::kRadians: return "rad";
  }
  return "";
}

/// `2` as 2.0, as evo prints a number that need not be whole.
std::string decimal(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.12g", value);
  const std::string shortest = text;
  return shortest.find_first_of(".e") == std::string::npos ? shortest + ".0" : shortest;
}

double error_of(const StampedPose& e, PoseRelation relation) {
  const Eigen::Matrix3d turned = e.rotation - Eigen::Matrix3d::Identity();
  switch (relation) {
    case PoseRelation::kPointDistance:
    case PoseRelation::kTranslationPart: return e.position.norm();
    case PoseRelation::kRotationPart: return turned.norm();
    case PoseRelation::kAngleDegrees: return geometry::to_degrees(rotation_angle(e.rotation));
    case PoseRelation::kAngleRadians: return rotation_angle(e.rotation);
    case PoseRelation::kFull: return std::sqrt(turned.squaredNorm() + e.position.squaredNorm());
  }
  return 0.0;
}

IndexPairs pairs_by_index(std::size_t count, std::size_t delta, bool all) {
  IndexPairs pairs;
  for (std::size_t i = 0; i + delta < count; i += all ? 1 : delta) pairs.emplace_back(i, i + delta);
  return pairs;
}

std::vector<double> path_lengths(const std::vector<StampedPose>& poses) {
  std::vector<double> lengths(poses.size(), 0.0);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    lengths[i] = lengths[i - 1] + (poses[i].position - poses[i - 1].position).norm();
  }
  return lengths;
}

IndexPairs all_pairs_by_path(const std::vector<StampedPose>& poses, double delta, double tolerance) {
  const std::vector<double> lengths = path_lengths(poses);
  IndexPairs pairs;
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
    const auto miss = [&](std::size_t j) { return std::abs(lengths[j] - lengths[i] - delta); };
    const auto after =
        std::lower_bound(lengths.begin() + static_cast<std::ptrdiff_t>(i) + 1, lengths.end(), lengths[i] + delta);
    std::size_t best = std::min(static_cast<std::size_t>(after - lengths.begin()), poses.size() - 1);
    while (best > i + 1 && miss(best - 1) <= miss(best)) --best;  // of equally good ones the first
    if (miss(best) <= tolerance) pairs.emplace_back(i, best);
  }
  return pairs;
}

/// As evo does, the first pair starts where the path has reached `delta` for the first time.
IndexPairs consecutive_pairs_by_path(const std::vector<StampedPose>& poses, double delta) {
  std::vector<std::size_t> ends;
  double travelled = 0.0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (i > 0) travelled += (poses[i].position - poses[i - 1].position).norm();
    if (travelled >= delta) {
      ends.push_back(i);
      travelled = 0.0;
    }
  }
  IndexPairs pairs;
  for (std::size_t k = 1; k < ends.size(); ++k) pairs.emplace_back(ends[k - 1], ends[k]);
  return pairs;
}

IndexPairs pairs_by_angle(const std::vector<StampedPose>& poses, double delta, double tolerance, bool all) {
  IndexPairs pairs;
  const auto angle = [&](std::size_t i, std::size_t j) {
    return rotation_angle(relative(poses[i], poses[j]).rotation);
  };
  if (all) {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      for (std::size_t j = i + 1; j < poses.size(); ++j) {
        if (std::abs(angle(i, j) - delta) <= tolerance) pairs.emplace_back(i, j);
      }
    }
    return pairs;
  }
  double turned = 0.0;
  for (std::size_t i = 0, start = 0; i + 1 < poses.size(); ++i) {
    turned += angle(i, i + 1);
    if (turned < delta) continue;
    pairs.emplace_back(start, i + 1);
    start = i + 1;
    turned = 0.0;
  }
  return pairs;
}

std::string delta_text(const RelativeErrorParams& params) {
  return params.unit == DeltaUnit::kFrames ? std::to_string(std::llround(params.delta)) : decimal(params.delta);
}

}  // namespace

Statistics statistics(std::span<const double> errors) {
  if (errors.empty()) throw std::invalid_argument("no errors to make statistics of");
  std::vector<double> sorted(errors.begin(), errors.end());
  std::sort(sorted.begin(), sorted.end());
  const double n = static_cast<double>(sorted.size());
  Statistics s{.max = sorted.back(), .min = sorted.front()};
  for (const double e : errors) {
    s.mean += e / n;
    s.sse += e * e;
  }
  for (const double e : errors) s.std += (e - s.mean) * (e - s.mean) / n;
  s.std = std::sqrt(s.std);
  s.rmse = std::sqrt(s.sse / n);
  const std::size_t middle = sorted.size() / 2;
  s.median = sorted.size() % 2 == 1 ? sorted[middle] : 0.5 * (sorted[middle - 1] + sorted[middle]);
  return s;
}

PoseErrors absolute_pose_error(const AssociatedPair& pair, PoseRelation relation) {
  PoseErrors result{.title = std::string("APE w.r.t. ") + name_of(relation)};
  for (std::size_t i = 0; i < pair.estimate.poses.size(); ++i) {
    result.errors.push_back(error_of(relative(pair.estimate.poses[i], pair.reference.poses[i]), relation));
    result.times.push_back(pair.estimate.poses[i].time);
  }
  result.statistics = statistics(result.errors);
  return result;
}

IndexPairs pairs_at(const std::vector<StampedPose>& poses, const RelativeErrorParams& params) {
  const double delta = params.unit == DeltaUnit::kDegrees ? geometry::to_radians(params.delta) : params.delta;
  const double tolerance = params.relative_tolerance * delta;
  switch (params.unit) {
    case DeltaUnit::kFrames:
      if (delta < 1.0 || delta != std::floor(delta)) {
        throw std::runtime_error(
            "--delta in frames must be a whole number of at least 1: correct it, or give a --delta_unit");
      }
      if (delta >= static_cast<double>(poses.size())) return {};
      return pairs_by_index(poses.size(), static_cast<std::size_t>(delta), params.all_pairs);
    case DeltaUnit::kMetres:
      return params.all_pairs ? all_pairs_by_path(poses, delta, tolerance) : consecutive_pairs_by_path(poses, delta);
    case DeltaUnit::kDegrees:
    case DeltaUnit::kRadians: return pairs_by_angle(poses, delta, tolerance, params.all_pairs);
  }
  return {};
}

PoseErrors relative_pose_error(const AssociatedPair& pair, const RelativeErrorParams& params) {
  if (!(params.delta > 0.0 && params.delta <= RelativeErrorParams::kLargestDelta)) {
    throw std::runtime_error("--delta must be above 0 and at most 1e6");
  }
  const auto& p = pair.estimate.poses;
  const auto& q = pair.reference.poses;
  PoseErrors result{.title = std::string("RPE w.r.t. ") + name_of(params.relation) +
                             "\nfor delta = " + delta_text(params) + " (" + name_of(params.unit) + ") using " +
                             (params.all_pairs ? "all" : "consecutive") + " pairs"};
  for (const auto& [i, j] : pairs_at(params.pairs_from_reference ? q : p, params)) {
    const StampedPose moved_q = relative(q[i], q[j]), moved_p = relative(p[i], p[j]);
    result.errors.push_back(params.relation == PoseRelation::kPointDistance
                                ? std::abs(moved_q.position.norm() - moved_p.position.norm())
                                : error_of(relative(moved_q, moved_p), params.relation));
    result.times.push_back(p[j].time);
  }
  if (result.errors.empty()) {
    throw std::runtime_error("no two poses are " + delta_text(params) + " " + name_of(params.unit) +
                             " apart: give a smaller --delta or a larger --delta_tol");
  }
  result.statistics = statistics(result.errors);
  return result;
}

std::string to_text(const PoseErrors& errors, const AlignmentParams& alignment) {
  const Statistics& s = errors.statistics;
  std::string text = errors.title + "\n" + describe(alignment) + "\n\n";
  for (const auto& [name, value] : {std::pair{"max", s.max},
                                    {"mean", s.mean},
                                    {"median", s.median},
                                    {"min", s.min},
                                    {"rmse", s.rmse},
                                    {"sse", s.sse},
                                    {"std", s.std}}) {
    char line[64];
    std::snprintf(line, sizeof line, "%10s\t%.6f\n", name, value);
    text += line;
  }
  return text;
}

}  // namespace credo::evaluation
