// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/fused_segments.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/angles.hpp"

namespace credo::perception {
namespace {

using evidence::FusedBinaryMass;

/// One reading between two cuts is no segment.
constexpr int kLeastPoints = 2;

struct Sector {
  double from = 0.0;
  double width = 0.0;
};

Sector sector_of(const geometry::Segment& extent, const Eigen::Vector2d& origin) {
  const Eigen::Vector2d a = extent.a - origin, b = extent.b - origin;
  const double from = std::atan2(a.y(), a.x());
  return {from, std::max(0.0, geometry::angle_difference(std::atan2(b.y(), b.x()), from))};
}

/// The fusion of five criteria: all at once, then the conflict is moved to ignorance, once (Clerentin et al.,
/// sec. 3.1).
FusedBinaryMass judge(SegmentMeasures& measures, double gray_noise, const CriteriaParams& params,
                      std::array<evidence::BinaryMass, 5>& criteria) {
  measures.mean_gray_sigmas = measures.mean_gray_deviation / std::max(0.1, gray_noise);
  criteria = segment_criteria(measures, params);
  return evidence::conflict_to_ignorance(criteria);
}

class Fuser {
 public:
  Fuser(double beam_increment, const PointNoise& noise, const CriteriaParams& params, Scene& scene)
      : beam_increment_(beam_increment), noise_(noise), params_(params), scene_(scene) {}

  /// The pieces of one range segment between its ends and cuts; the whole where cuts have left no piece enough points.
  void add_pieces(const RangeSegment& whole, const std::array<SegmentEndView, 2>& ends,
                  std::span<const SegmentCut> cuts) {
    gray_sum_ = gray_width_ = 0.0;
    const std::size_t before = scene_.segments.size();
    FusedSegment piece;
    piece.extent.a = whole.extent.a;
    piece.first_point = whole.first;
    piece.radial_line_a = ends[0].radial_line;
    piece.source_a = piece.radial_line_a >= 0 ? EndpointSource::kBoth : EndpointSource::kRangeFinder;
    piece.end_a = whole.end_a;
    for (const SegmentCut& cut : cuts) {
      piece.extent.b = cut.position;
      piece.last_point = cut.first_point - 1;
      piece.radial_line_b = cut.radial_line;
      piece.source_b = EndpointSource::kCamera;
      piece.end_b = SegmentEnd::kJoined;
      add_piece(whole, piece);
      piece.extent.a = cut.position;
      piece.first_point = std::max(piece.first_point, cut.first_point);
      piece.radial_line_a = cut.radial_line;
      piece.source_a = EndpointSource::kCamera;
      piece.end_a = SegmentEnd::kJoined;
    }
    piece.extent.b = whole.extent.b;
    piece.last_point = whole.last;
    piece.radial_line_b = ends[1].radial_line;
    piece.source_b = piece.radial_line_b >= 0 ? EndpointSource::kBoth : EndpointSource::kRangeFinder;
    piece.end_b = whole.end_b;
    add_piece(whole, piece);
    if (scene_.segments.size() == before && !cuts.empty()) add_pieces(whole, ends, {});
  }

  /// The whole of the pieces that were added last.
  FusedBinaryMass judge_whole(const RangeSegment& whole, int endpoint_case) {
    SegmentMeasures measures;
    measure_points(points(whole.first, whole.last), whole.fit.line, beam_increment_, noise_, params_, measures);
    measures.endpoint_case = scene_.camera_seen ? endpoint_case : 0;
    if (gray_width_ > 0.0) measures.mean_gray_deviation = gray_sum_ / gray_width_;
    std::array<evidence::BinaryMass, 5> criteria;
    return judge(measures, scene_.gray.noise, params_, criteria);
  }

  void write_conflicts() const { means_.write(scene_); }

 private:
  std::span<const sensors::ScanPoint> points(int first, int last) const {
    return {scene_.points.data() + first, static_cast<std::size_t>(last - first + 1)};
  }

  void add_piece(const RangeSegment& whole, FusedSegment piece) {
    if (piece.last_point - piece.first_point + 1 < kLeastPoints) return;
    const auto own = points(piece.first_point, piece.last_point);
    const bool uncut = piece.first_point == whole.first && piece.last_point == whole.last;
    const LineFit fit = uncut ? whole.fit : fit_line(own, noise_);
    piece.line = fit.line;
    piece.support = fit.support;
    piece.endpoint_case = endpoint_case(piece.source_a, piece.source_b);

    SegmentMeasures measures;
    measure_points(own, fit.line, beam_increment_, noise_, params_, measures);
    measures.endpoint_case = scene_.camera_seen ? piece.endpoint_case : 0;
    const Sector sector = sector_of(piece.extent, scene_.camera_origin);
    measures.mean_gray_deviation = gray_deviation(scene_.gray, sector.from, sector.width);
    if (measures.mean_gray_deviation == measures.mean_gray_deviation) {
      gray_sum_ += sector.width * measures.mean_gray_deviation;
      gray_width_ += sector.width;
    }
    const FusedBinaryMass fused = judge(measures, scene_.gray.noise, params_, piece.criteria);
    piece.existence = fused.mass;
    piece.conflict = fused.conflict;
    means_.add(piece.criteria, fused.conflict);
    scene_.segments.push_back(piece);
  }

  double beam_increment_;
  const PointNoise& noise_;
  const CriteriaParams& params_;
  Scene& scene_;
  ConflictMeans means_;
  double gray_sum_ = 0.0, gray_width_ = 0.0;  // over the pieces of one whole
};

}  // namespace

void fuse_segments(std::span<const RangeSegment> segments, const Cooperation& cooperation, double beam_increment,
                   const PointNoise& noise, const CriteriaParams& params, Scene& scene, FusedWholes& wholes) {
  wholes.existence.clear();
  wholes.cases.clear();
  wholes.first_part.assign(1, 0);
  scene.segments.clear();
  Fuser fuser(beam_increment, noise, params, scene);
  std::size_t cut = 0;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const std::size_t first_cut = cut;
    while (cut < cooperation.cuts.size() && cooperation.cuts[cut].segment == static_cast<int>(i)) ++cut;
    fuser.add_pieces(segments[i], cooperation.ends[i], std::span(cooperation.cuts).subspan(first_cut, cut - first_cut));
    const auto source = [&](int end) {
      return cooperation.ends[i][end].radial_line >= 0 ? EndpointSource::kBoth : EndpointSource::kRangeFinder;
    };
    wholes.cases.push_back(endpoint_case(source(0), source(1)));
    wholes.existence.push_back(fuser.judge_whole(segments[i], wholes.cases.back()));
    wholes.first_part.push_back(static_cast<int>(scene.segments.size()));
  }
  fuser.write_conflicts();
}

}  // namespace credo::perception
