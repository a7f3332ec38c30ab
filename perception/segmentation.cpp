// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/segmentation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace credo::perception {
namespace {

using geometry::LineEstimate;
using sensors::ScanPoint;

constexpr double kNever = std::numeric_limits<double>::infinity();

double median_of_three(double a, double b, double c) { return std::max(std::min(a, b), std::min(std::max(a, b), c)); }

Eigen::Vector2d foot(const LineEstimate& line, const Eigen::Vector2d& point) {
  const Eigen::Vector2d along = line.direction();
  return line.centroid + along.dot(point - line.centroid) * along;
}

/// Distance along the line from one beam to the next.
double spacing_at(const ScanPoint& point, const LineEstimate& line, double increment, double min_sine) {
  return predicted_range(point, line) * increment / std::max(min_sine, std::abs(line.normal().dot(point.ray)));
}

/// Variance of an end's place: the wall may end anywhere up to the next beam, and the last reading is noisy along the line.
double end_variance(const ScanPoint& point, const LineEstimate& line, double spacing) {
  const double along = line.direction().dot(point.ray) * point.sigma_m;
  return spacing * spacing / 3.0 + along * along + variance_at(line, point.position);
}

}  // namespace

Segmenter::Segmenter(const sensors::RangeFinder& range_finder, const SegmentationParams& params,
                     const LineFitParams& fit_params)
    : noise_{range_finder.noise, fit_params},
      params_(params),
      increment_(std::abs(range_finder.angle_increment_rad)),
      clockwise_(range_finder.angle_increment_rad < 0.0) {
  if (increment_ <= 0.0) return;
  const double full_turn = 2.0 * std::numbers::pi;
  if (range_finder.count * increment_ > full_turn - 1.5 * increment_)
    turn_ = static_cast<int>(std::lround(full_turn / increment_));
  allowed_beams_ = 1 + std::max(params_.missing_beams, static_cast<int>(params_.missing_rad / increment_));
}

int Segmenter::beams_between(const ScanPoint& a, const ScanPoint& b) const {
  const int beams = clockwise_ ? a.beam - b.beam : b.beam - a.beam;
  return beams < 0 ? beams + turn_ : beams;
}

bool Segmenter::connected(const ScanPoint& a, const ScanPoint& b) const {
  const int beams = beams_between(a, b);
  if (beams > allowed_beams_) return false;
  // A wall that makes the angle grazing_rad with the nearer beam (Borges and Aldon).
  const double turn = std::min(beams * increment_, 0.6 * params_.grazing_rad);
  const double wall = std::min(a.range_m, b.range_m) * std::sin(turn) / std::sin(params_.grazing_rad - turn);
  const double reach = wall + params_.break_sigmas * std::sqrt(a.sigma_m * a.sigma_m + b.sigma_m * b.sigma_m);
  return (a.position - b.position).squaredNorm() <= reach * reach;
}

/// A full turn begins behind its widest break that is not a stray reading's.
void Segmenter::rotate_to_break(Points& points) const {
  const std::size_t n = points.size();
  if (turn_ == 0 || n < 4) return;
  std::size_t start = 0;
  double widest = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const ScanPoint &before2 = points[(i + n - 2) % n], &before = points[(i + n - 1) % n];
    const ScanPoint &here = points[i], &after = points[(i + 1) % n];
    const double width = (here.position - before.position).squaredNorm();
    if (width <= widest || connected(before, here) || connected(before2, here) || connected(before, after)) continue;
    widest = width;
    start = i;
  }
  std::rotate(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(start), points.end());
}

/// Runs between breaks, each split by Duda-Hart. Stray readings inside a run do not end it.
void Segmenter::split_runs(const Points& points) {
  const int n = static_cast<int>(points.size());
  for (int first = 0; first < n;) {
    int last = first;
    for (bool grown = true; grown;) {
      grown = false;
      for (int step = 1; step <= 1 + params_.bridged_outliers && last + step < n && !grown; ++step) {
        if (!connected(points[last], points[last + step])) continue;
        last += step;
        grown = true;
      }
    }
    split(points, first, last);
    first = last + 1;
  }
}

/// The point where a run is to be split: after it.
/// \returns -1 where the chord through the ends explains the run.
int Segmenter::split_point(const Points& points, int first, int last) const {
  const Eigen::Vector2d chord = points[last].position - points[first].position;
  const double length = chord.norm();
  if (length < 1e-9) return -1;
  const Eigen::Vector2d normal(-chord.y() / length, chord.x() / length);
  const auto deviation = [&](int k) {
    if (k <= first || k >= last) return 0.0;
    const double distance = normal.dot(points[k].position - points[first].position);
    if (params_.split_m > 0.0) return distance;
    return distance / std::sqrt(noise_.variance_across(points[k].ray, points[k].range_m, normal));
  };
  const double threshold = params_.split_m > 0.0 ? params_.split_m : params_.split_sigmas;
  int farthest = -1;
  double most = threshold;
  double before = 0.0, here = deviation(first + 1);
  for (int k = first + 1; k < last; ++k) {
    const double after = deviation(k + 1);
    // A stray reading has no neighbours that deviate with it.
    const double size = std::abs(params_.split_m > 0.0 ? here : median_of_three(before, here, after));
    if (size > most) {
      most = size;
      farthest = params_.split_m > 0.0 || std::abs(here) == size ? k : std::abs(before) == size ? k - 1 : k + 1;
    }
    before = here;
    here = after;
  }
  return std::min(farthest, last - 1);
}

void Segmenter::split(const Points& points, int first, int last) {
  const int at = last - first < 2 ? -1 : split_point(points, first, last);
  if (at < first) {
    Piece piece{.first = first, .last = last, .fit = {}, .merge_cost = kNever, .merge_with = 0};
    piece.fit = fit_line(span(points, first, last), noise_);
    pieces_.push_back(piece);
    return;
  }
  split(points, first, at);
  split(points, at + 1, last);
}

/// How much chi-square grows if two pieces are one line, as a share of what chance allows.
double Segmenter::merge_cost(const Points& points, const Piece& a, const Piece& b) const {
  if (a.size() + b.size() < 3) return kNever;
  const ScanPoint &end = points[a.last], &begin = points[b.first];
  const int beams = beams_between(end, begin);
  if (beams > allowed_beams_) return kNever;
  const int stray = b.first - a.last - 1;
  const bool gap_counts = beams > 1 + stray;
  if (gap_counts && (end.position - begin.position).squaredNorm() > params_.merge_gap_m * params_.merge_gap_m)
    return kNever;
  const LineEstimate joint = fit_line(span(points, a.first, b.last), noise_).line;
  const double growth = judge_line(span(points, a.first, a.last), joint, noise_).chi2 +
                        judge_line(span(points, b.first, b.last), joint, noise_).chi2 - a.fit.chi2 - b.fit.chi2;
  const bool one_freedom = a.size() == 1 || b.size() == 1;
  return growth / (params_.merge_chi2 * (one_freedom ? 0.72 : 1.0));  // 6.63 / 9.21
}

void Segmenter::rate_merge(const Points& points, std::size_t i) {
  Piece& piece = pieces_[i];
  piece.merge_cost = kNever;
  piece.merge_with = 0;
  for (std::size_t skip = 1; skip <= 2 && i + skip < pieces_.size(); ++skip) {
    if (skip == 2 && pieces_[i + 1].size() > params_.bridged_outliers) break;
    const double cost = merge_cost(points, piece, pieces_[i + skip]);
    if (cost > 1.0 || cost >= piece.merge_cost) continue;
    piece.merge_cost = cost;
    piece.merge_with = static_cast<int>(skip);
  }
}

/// Joins the two neighbours that fit one line best, until none do.
void Segmenter::merge(const Points& points) {
  if (params_.merge_chi2 <= 0.0) return;
  for (std::size_t i = 0; i < pieces_.size(); ++i) rate_merge(points, i);
  while (true) {
    const auto best = std::min_element(pieces_.begin(), pieces_.end(),
                                       [](const Piece& a, const Piece& b) { return a.merge_cost < b.merge_cost; });
    if (best == pieces_.end() || best->merge_with == 0) return;
    best->last = (best + best->merge_with)->last;
    best->fit = fit_line(span(points, best->first, best->last), noise_);
    const std::size_t at = static_cast<std::size_t>(best - pieces_.begin());
    pieces_.erase(best + 1, best + 1 + best->merge_with);
    for (std::size_t i = at < 2 ? 0 : at - 2; i <= at; ++i) rate_merge(points, i);
  }
}

/// Where a full turn has no break, its first piece goes to the end, so that it can be merged with the last one.
void Segmenter::close_turn(Points& points) {
  if (turn_ == 0 || pieces_.size() < 3 || !connected(points.back(), points.front())) return;
  const int shift = pieces_.front().size();
  const int n = static_cast<int>(points.size());
  std::rotate(points.begin(), points.begin() + shift, points.end());
  std::rotate(pieces_.begin(), pieces_.begin() + 1, pieces_.end());
  for (Piece& piece : pieces_) {
    piece.first -= shift;
    piece.last -= shift;
  }
  pieces_.back().first += n;
  pieces_.back().last += n;
  merge(points);
}

/// Each reading between two neighbouring lines goes to the line that explains it.
void Segmenter::move_boundaries(const Points& points) {
  std::erase_if(pieces_, [&](const Piece& piece) { return piece.size() < params_.min_support; });
  if (params_.merge_chi2 <= 0.0) return;
  const double most = noise_.params.no_weight_from * noise_.params.no_weight_from;
  for (std::size_t i = 0; i + 1 < pieces_.size(); ++i) {
    Piece &a = pieces_[i], &b = pieces_[i + 1];
    if (b.first - a.last - 1 > params_.bridged_outliers || !connected(points[a.last], points[b.first])) continue;
    double balance = 0.0, best = 0.0;
    int boundary = a.first + 1;
    for (int k = a.first + 2; k <= b.last - 2; ++k) {
      const double to_a = residual_sigmas(points[k], a.fit.line, noise_);
      const double to_b = residual_sigmas(points[k], b.fit.line, noise_);
      balance += std::min(to_a * to_a, most) - std::min(to_b * to_b, most);
      if (balance >= best) continue;
      best = balance;
      boundary = k;
    }
    a.last = boundary;
    b.first = boundary + 1;
  }
}

void Segmenter::keep_lines(const Points& points, std::vector<RangeSegment>& segments) const {
  const double outlier = noise_.params.no_weight_from;
  for (const Piece& piece : pieces_) {
    RangeSegment segment{.first = piece.first, .last = piece.last};
    segment.fit = fit_line(span(points, piece.first, piece.last), noise_);
    const LineEstimate& line = segment.fit.line;
    const auto strays = [&](int k) { return std::abs(residual_sigmas(points[k], line, noise_)) >= outlier; };
    while (segment.first < segment.last && strays(segment.first)) ++segment.first;
    while (segment.last > segment.first && strays(segment.last)) --segment.last;
    if (segment.fit.support < params_.min_support) continue;
    double sine = 0.0;
    for (int k = segment.first; k <= segment.last; ++k) sine += std::abs(line.normal().dot(points[k].ray));
    if (sine < params_.min_sine * (segment.last - segment.first + 1)) continue;
    segment.extent = {foot(line, points[segment.first].position), foot(line, points[segment.last].position)};
    if (segment.extent.length() < 1e-6) continue;
    segment.spacing_a = spacing_at(points[segment.first], line, increment_, params_.min_sine);
    segment.spacing_b = spacing_at(points[segment.last], line, increment_, params_.min_sine);
    segments.push_back(segment);
  }
}

/// What is beside an end that meets no neighbour. `step`: +1 beyond end b, -1 beyond end a.
Segmenter::Beside Segmenter::end_beside(const Points& points, const RangeSegment& segment, int end, int step) const {
  const int n = static_cast<int>(points.size());
  const auto at = [&](int k) { return turn_ > 0 ? (k % n + n) % n : k; };
  const auto link = [&](int a, int b) { return step > 0 ? connected(points[a], points[b]) : connected(points[b], points[a]); };
  int next = at(end + step);
  const int after = at(end + 2 * step);
  if (next < 0 || next >= n || next == end) return {};
  if (after >= 0 && after < n && after != end && !link(next, after)) next = after;  // a stray reading
  const int beams = step > 0 ? beams_between(points[end], points[next]) : beams_between(points[next], points[end]);
  if (beams > allowed_beams_ + 1) return {};
  // Where the beam would meet the continued line.
  const LineEstimate& line = segment.fit.line;
  const ScanPoint &last = points[end], &other = points[next];
  const double sine = line.normal().dot(other.ray);
  const double sine_last = line.normal().dot(last.ray);
  const double farthest = 2.0 * last.range_m;
  const double growth = sine * sine_last > 0.0 ? sine_last / sine : kNever;
  const double expected = std::min(farthest, predicted_range(last, line) * growth);
  const double noise = std::sqrt(last.sigma_m * last.sigma_m + other.sigma_m * other.sigma_m);
  const double jump = (other.range_m - expected) / std::max(1e-6, noise);
  if (jump > params_.break_sigmas) return {SegmentEnd::kFree, jump};
  return {jump < -params_.break_sigmas ? SegmentEnd::kOccluded : SegmentEnd::kUnseen, jump};
}

void Segmenter::judge_ends(const Points& points, std::vector<RangeSegment>& segments) const {
  const std::size_t n = segments.size();
  for (std::size_t i = 0; i < n; ++i) {
    RangeSegment &s = segments[i], &t = segments[(i + 1) % n];
    const ScanPoint &end = points[s.last], &begin = points[t.first];
    const Eigen::Vector2d gap = t.extent.a - s.extent.b;
    s.gap_to_next_m = gap.norm();
    s.gap_to_next_sigmas =
        s.gap_to_next_m / std::sqrt(end_variance(end, s.fit.line, s.spacing_b) + end_variance(begin, t.fit.line, t.spacing_a));
    const bool neighbours = n > 1 && (i + 1 < n || turn_ > 0);
    const bool near = beams_between(end, begin) <= allowed_beams_ + params_.bridged_outliers;
    if (!neighbours) s.gap_to_next_sigmas = s.gap_to_next_m = kNever;
    if (neighbours && near && s.gap_to_next_sigmas <= params_.joined_sigmas) {
      s.end_b = t.end_a = SegmentEnd::kJoined;
      continue;
    }
    const Beside beyond = end_beside(points, s, s.last, +1), before = end_beside(points, t, t.first, -1);
    s.end_b = beyond.end;
    s.jump_b_sigmas = beyond.jump_sigmas;
    t.end_a = before.end;
    t.jump_a_sigmas = before.jump_sigmas;
  }
}

/// Ends at junctions are where the lines meet, free ends half a beam beyond the last reading.
void Segmenter::place_ends(std::vector<RangeSegment>& segments) const {
  const std::size_t n = segments.size();
  for (RangeSegment& s : segments) {
    const Eigen::Vector2d along = s.extent.direction();
    if (s.end_a == SegmentEnd::kFree) s.extent.a -= 0.5 * std::min(s.spacing_a, params_.merge_gap_m) * along;
    if (s.end_b == SegmentEnd::kFree) s.extent.b += 0.5 * std::min(s.spacing_b, params_.merge_gap_m) * along;
  }
  for (std::size_t i = 0; i < n; ++i) {
    RangeSegment &s = segments[i], &t = segments[(i + 1) % n];
    if (s.end_b != SegmentEnd::kJoined) continue;
    const Eigen::Vector2d middle = 0.5 * (s.extent.b + t.extent.a);
    const auto corner = intersect(s.fit.line, t.fit.line, params_.corner_sine);
    const double reach = s.gap_to_next_m + s.spacing_b + t.spacing_a;
    const bool meets = corner && (corner->position - middle).squaredNorm() <= reach * reach;
    const Eigen::Vector2d end_s = meets ? corner->position : foot(s.fit.line, middle);
    const Eigen::Vector2d end_t = meets ? corner->position : foot(t.fit.line, middle);
    // Never so far that a segment turns round.
    if ((end_s - s.extent.a).dot(s.extent.b - s.extent.a) > 0.0) s.extent.b = end_s;
    if ((t.extent.b - end_t).dot(t.extent.b - t.extent.a) > 0.0) t.extent.a = end_t;
  }
}

void Segmenter::segment(Points& points, std::vector<RangeSegment>& segments) {
  segments.clear();
  pieces_.clear();
  if (clockwise_) std::reverse(points.begin(), points.end());
  if (static_cast<int>(points.size()) < params_.min_support || increment_ <= 0.0) return;
  rotate_to_break(points);
  split_runs(points);
  merge(points);
  close_turn(points);
  move_boundaries(points);
  keep_lines(points, segments);
  judge_ends(points, segments);
  place_ends(segments);
}

}  // namespace credo::perception
