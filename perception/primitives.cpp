// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/primitives.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "evidence/joint_existence.hpp"
#include "geometry/angles.hpp"

namespace credo::perception {
namespace {

using evidence::BinaryMass;
using evidence::FusedBinaryMass;
using std::numbers::pi;

constexpr std::array kTypes{PrimitiveType::kCorner, PrimitiveType::kEdge, PrimitiveType::kWall, PrimitiveType::kOther};

JunctionType decide(const evidence::FourKindMass& mass) {
  const int kind = evidence::most_believed(mass);
  const BinaryMass belief = evidence::belief_in_kind(mass, kind);
  return {.type = kTypes[static_cast<std::size_t>(kind)], .kind = belief, .believed = belief.yes};
}

/// The angle criterion of the default method: a corner or an edge from turn_from_rad on, as the floor plan has it.
evidence::WhichKind which_kind(double deviation, double sigma, const PrimitiveParams& params) {
  const double reliable = evidence::falling(sigma, params.angle_sigma_good_rad, params.angle_sigma_bad_rad);
  const double committed = params.angle_committed * reliable;
  const double level = evidence::falling(std::abs(deviation), params.level_until_rad, params.level_zero_rad);
  const double turn = evidence::rising(std::abs(deviation), params.turn_zero_rad, params.turn_from_rad);
  evidence::WhichKind which;
  which.one_or_other = {deviation < 0.0 ? committed * turn : 0.0, deviation > 0.0 ? committed * turn : 0.0,
                        committed * level};
  which.unknown = 1.0 - committed * (turn + level);
  return which;
}

FusedBinaryMass fused_or_vacuous(const std::optional<FusedBinaryMass>& fused) {
  return fused ? *fused : FusedBinaryMass{BinaryMass::vacuous(), 1.0};
}

double interior_angle_of(const RangeSegment& s, const RangeSegment& t) {
  const Eigen::Vector2d u = s.extent.b - s.extent.a, v = t.extent.b - t.extent.a;
  const double turn = std::atan2(u.x() * v.y() - u.y() * v.x(), u.dot(v));  // to the left is positive: a corner
  return std::clamp(pi - turn, 1e-9, 2.0 * pi - 1e-9);
}

void place(const PointEstimate& point, Primitive& primitive) {
  primitive.position = point.position;
  primitive.position_covariance = point.covariance;
  primitive.range_m = point.position.norm();
  primitive.azimuth = std::atan2(point.position.y(), point.position.x());
  const Eigen::Vector2d ray(std::cos(primitive.azimuth), std::sin(primitive.azimuth));
  const Eigen::Vector2d sideways(-ray.y(), ray.x());
  primitive.sigma_range_m = std::sqrt(ray.dot(point.covariance * ray));
  primitive.sigma_azimuth =
      std::min(pi, std::sqrt(sideways.dot(point.covariance * sideways)) / std::max(1e-3, primitive.range_m));
}

/// The middle of a wall: known across by the line; along it as well as its ends are, and hardly where one is hidden.
PointEstimate middle_of(const geometry::Segment& extent, const geometry::LineEstimate& line, SegmentEnd end_a,
                        SegmentEnd end_b, double spacing_a, double spacing_b) {
  const auto variance = [&](SegmentEnd end, double spacing) {
    const bool fixed = end == SegmentEnd::kJoined || end == SegmentEnd::kFree || end == SegmentEnd::kOpen;
    const double sigma = fixed ? spacing / std::sqrt(3.0) : 0.5 * extent.length();
    return sigma * sigma;
  };
  const Eigen::Vector2d along = line.direction(), normal = line.normal();
  PointEstimate middle{.position = extent.centre()};
  middle.covariance = variance_at(line, middle.position) * normal * normal.transpose() +
                      0.25 * (variance(end_a, spacing_a) + variance(end_b, spacing_b)) * along * along.transpose();
  return middle;
}

/// Names what the parts of one scene are.
class Namer {
 public:
  Namer(const SceneParts& parts, const PrimitiveParams& params, Scene& scene)
      : parts_(parts), params_(params), scene_(scene) {}

  void add_walls() {
    for (std::size_t i = 0; i < parts_.segments.size(); ++i) {
      if (params_.walls_are_unions)
        add_union(i);
      else
        for (int k = parts_.wholes.first_part[i]; k < parts_.wholes.first_part[i + 1]; ++k) add_wall_of(i, k);
    }
  }

  void add_junctions() {
    const std::size_t n = parts_.segments.size();
    for (std::size_t i = 0; i < n && n > 1; ++i) add_junction(i, (i + 1) % n);
  }

  void add_free_ends() {
    if (params_.absolute) return;  // two segments apart are a junction of type other there
    for (std::size_t i = 0; i < parts_.segments.size(); ++i)
      for (const bool at_b : {false, true}) add_free_end(i, at_b);
  }

  void add_radial_lines() {
    if (params_.absolute) return;  // the paper knows landmarks with a segment only
    for (std::size_t l = 0; l < scene_.radial_lines.size(); ++l) {
      const int index = static_cast<int>(l);
      const bool used = std::any_of(scene_.primitives.begin(), scene_.primitives.end(),
                                    [index](const Primitive& p) { return p.radial_line == index; });
      if (used) continue;
      if (!add_mark(index)) add_bearing(index);
    }
  }

 private:
  const FusedSegment& fused(int k) const { return scene_.segments[static_cast<std::size_t>(k)]; }
  int first_of(std::size_t i) const { return parts_.wholes.first_part[i]; }
  int last_of(std::size_t i) const { return parts_.wholes.first_part[i + 1] - 1; }
  int line_at(std::size_t i, bool at_b) const { return parts_.cooperation.ends[i][at_b].radial_line; }

  void add_union(std::size_t i) {
    const RangeSegment& s = parts_.segments[i];
    Primitive wall{.type = PrimitiveType::kWall, .extent = s.extent, .line = s.fit.line};
    wall.first_segment = first_of(i);
    wall.last_segment = last_of(i);
    wall.end_a = s.end_a;
    wall.end_b = s.end_b;
    wall.support = s.fit.support;
    wall.existence = parts_.wholes.existence[i].mass;
    wall.conflict = parts_.wholes.existence[i].conflict;
    wall.endpoint_case = parts_.wholes.cases[i];
    place(middle_of(s.extent, s.fit.line, s.end_a, s.end_b, s.spacing_a, s.spacing_b), wall);
    scene_.primitives.push_back(wall);
  }

  void add_wall_of(std::size_t i, int k) {
    const RangeSegment& s = parts_.segments[i];
    const FusedSegment& part = fused(k);
    Primitive wall{.type = PrimitiveType::kWall, .extent = part.extent, .line = part.line};
    wall.first_segment = wall.last_segment = k;
    wall.end_a = part.end_a;
    wall.end_b = part.end_b;
    wall.support = part.support;
    wall.existence = part.existence;
    wall.conflict = part.conflict;
    wall.endpoint_case = part.endpoint_case;
    place(middle_of(part.extent, part.line, part.end_a, part.end_b, s.spacing_a, s.spacing_b), wall);
    scene_.primitives.push_back(wall);
  }

  /// The belief of what rests on one or two sub-segments and on its kind.
  void believe(int segment_a, int segment_b, const BinaryMass& kind, Primitive& primitive) {
    const BinaryMass vacuous = BinaryMass::vacuous();
    const FusedBinaryMass result = fused_or_vacuous(evidence::joint_existence(
        fused(segment_a).existence, segment_a == segment_b ? vacuous : fused(segment_b).existence, kind,
        evidence::FusionRule::kDempster));
    primitive.existence = result.mass;
    primitive.conflict = result.conflict;
    primitive.first_segment = segment_a;
    primitive.last_segment = segment_b;
    primitive.endpoint_case = std::max(fused(segment_a).endpoint_case, fused(segment_b).endpoint_case);
  }

  /// The camera's bearing of a place, if it has seen it.
  PointEstimate sharpened(const PointEstimate& point, int radial_line) const {
    if (radial_line < 0) return point;
    const RadialLine& line = scene_.radial_lines[static_cast<std::size_t>(radial_line)];
    return with_bearing(point, scene_.camera_origin, line.azimuth, line.sigma);
  }

  void add_junction(std::size_t i, std::size_t j) {
    const RangeSegment &s = parts_.segments[i], &t = parts_.segments[j];
    const double gap = params_.absolute ? s.gap_to_next_m : s.gap_to_next_sigmas;
    if (!std::isfinite(gap)) return;
    const double angle = interior_angle_of(s, t);
    const double sigma =
        std::sqrt(s.fit.line.sigma_angle * s.fit.line.sigma_angle + t.fit.line.sigma_angle * t.fit.line.sigma_angle);
    const JunctionType type = junction_type(angle, sigma, gap, params_);
    if (type.type == PrimitiveType::kWall || type.believed < params_.least_believed) return;
    if (type.type == PrimitiveType::kOther) return add_gap(i, j, type);
    const auto meeting = intersect(s.fit.line, t.fit.line);
    if (!meeting) return;
    // Lines that meet elsewhere are no junction.
    const double reach = 2.0 * (s.gap_to_next_m + s.spacing_b + t.spacing_a);
    if ((meeting->position - 0.5 * (s.extent.b + t.extent.a)).norm() > reach) return;
    Primitive junction{.type = type.type};
    junction.interior_angle = angle;
    junction.radial_line = line_at(i, true) >= 0 ? line_at(i, true) : line_at(j, false);
    place(sharpened(*meeting, junction.radial_line), junction);
    believe(last_of(i), first_of(j), type.kind, junction);
    scene_.primitives.push_back(junction);
  }

  /// The paper's method: two segments that are apart make an `other` at the end that hides the rest.
  void add_gap(std::size_t i, std::size_t j, const JunctionType& type) {
    if (!params_.absolute) return;
    const RangeSegment &s = parts_.segments[i], &t = parts_.segments[j];
    const bool at_b = s.end_b == SegmentEnd::kFree;
    if (!at_b && t.end_a != SegmentEnd::kFree) return;
    Primitive other{.type = PrimitiveType::kOther};
    other.radial_line = at_b ? line_at(i, true) : line_at(j, false);
    const auto end = place_of_end(at_b ? i : j, at_b);
    if (!end) return;
    place(sharpened(*end, other.radial_line), other);
    believe(last_of(i), first_of(j), type.kind, other);
    scene_.primitives.push_back(other);
  }

  /// A free end: the face ends somewhere between its last beam and the next one.
  std::optional<PointEstimate> place_of_end(std::size_t i, bool at_b) const {
    const RangeSegment& s = parts_.segments[i];
    const sensors::ScanPoint& last = scene_.points[static_cast<std::size_t>(at_b ? s.last : s.first)];
    const double azimuth = std::atan2(last.ray.y(), last.ray.x()) + (at_b ? 0.5 : -0.5) * parts_.beam_increment;
    return intersect_ray(s.fit.line, last.position - last.range_m * last.ray, azimuth,
                         parts_.beam_increment / std::sqrt(12.0), params_.free_end_sine);
  }

  /// A face of a chain that turns slowly: the ends of a pillar are not places of the world.
  bool is_curved(std::size_t i, bool at_b) const {
    const std::size_t n = parts_.segments.size();
    const std::size_t j = (i + (at_b ? n - 1 : 1)) % n;
    const RangeSegment &s = parts_.segments[i], &other = parts_.segments[j];
    if (n < 2 || (at_b ? s.end_a : s.end_b) != SegmentEnd::kJoined) return false;
    const double turn = std::abs((at_b ? interior_angle_of(other, s) : interior_angle_of(s, other)) - pi);
    return turn > params_.level_until_rad && turn < params_.turn_from_rad;
  }

  void add_free_end(std::size_t i, bool at_b) {
    const RangeSegment& s = parts_.segments[i];
    const SegmentEnd kind = at_b ? s.end_b : s.end_a;
    if (kind != SegmentEnd::kFree && kind != SegmentEnd::kOpen) return;
    if (s.fit.support < params_.free_end_support || is_curved(i, at_b)) return;
    const JunctionType type = free_end_type(kind, at_b ? s.jump_b_sigmas : s.jump_a_sigmas, params_);
    const auto end = place_of_end(i, at_b);
    if (!end || type.believed < params_.least_believed) return;
    Primitive edge{.type = type.type};
    edge.radial_line = line_at(i, at_b);
    const bool taken = std::any_of(scene_.primitives.begin(), scene_.primitives.end(), [&](const Primitive& p) {
      return edge.radial_line >= 0 && p.radial_line == edge.radial_line;
    });
    if (taken) edge.radial_line = -1;
    place(sharpened(*end, edge.radial_line), edge);
    const int segment = at_b ? last_of(i) : first_of(i);
    believe(segment, segment, type.kind, edge);
    scene_.primitives.push_back(edge);
  }

  /// A radial line on a segment: a door frame in a flat wall. Its kind is believed as far as the line is.
  bool add_mark(int l) {
    const RadialLineUse& use = parts_.cooperation.uses[static_cast<std::size_t>(l)];
    if (use.segment < 0) return false;
    const std::size_t i = static_cast<std::size_t>(use.segment);
    const RadialLine& line = scene_.radial_lines[static_cast<std::size_t>(l)];
    const auto point = intersect_ray(parts_.segments[i].fit.line, scene_.camera_origin, line.azimuth, line.sigma);
    if (!point) return false;
    Primitive mark{.type = PrimitiveType::kOther};
    mark.radial_line = l;
    place(*point, mark);
    const auto [left, right] = beside(i, l, use);
    believe(left, right, radial_line_existence(line, scene_.gray.noise, params_).mass, mark);
    mark.interior_angle = left == right ? 0.0 : pi;
    scene_.primitives.push_back(mark);
    return true;
  }

  /// The sub-segments on either side of a radial line on segment i.
  std::pair<int, int> beside(std::size_t i, int l, const RadialLineUse& use) const {
    if (use.at_a) return {first_of(i), first_of(i)};
    if (use.at_b) return {last_of(i), last_of(i)};
    const auto cut = std::find_if(parts_.cooperation.cuts.begin(), parts_.cooperation.cuts.end(),
                                  [l](const SegmentCut& c) { return c.radial_line == l; });
    int left = first_of(i), right = last_of(i);
    for (int k = first_of(i); k <= last_of(i); ++k)
      if (fused(k).last_point < cut->first_point) left = k;
    for (int k = last_of(i); k >= first_of(i); --k)
      if (fused(k).first_point >= cut->first_point) right = k;
    return {left, right};
  }

  void add_bearing(int l) {
    const RadialLine& line = scene_.radial_lines[static_cast<std::size_t>(l)];
    const FusedBinaryMass belief = radial_line_existence(line, scene_.gray.noise, params_);
    Primitive bearing{.type = PrimitiveType::kOther, .azimuth = line.azimuth, .sigma_azimuth = line.sigma};
    bearing.bearing_only = true;
    bearing.radial_line = l;
    bearing.existence = belief.mass;
    bearing.conflict = belief.conflict;
    scene_.primitives.push_back(bearing);
  }

  const SceneParts& parts_;
  const PrimitiveParams& params_;
  Scene& scene_;
};

}  // namespace

PrimitiveParams PrimitiveParams::paper() {
  PrimitiveParams params;
  params.absolute = true;
  params.walls_are_unions = false;
  params.joined = {.committed = 0.9, .regular_until = 0.05, .other_from = 0.20};  // m
  return params;
}

JunctionType junction_type(double interior_angle, double sigma_angle, double gap, const PrimitiveParams& params) {
  const double deviation = interior_angle - pi;
  const evidence::WhichKind which = params.absolute ? evidence::which_kind(geometry::to_degrees(deviation))
                                                    : which_kind(deviation, sigma_angle, params);
  return decide(evidence::combine(which, evidence::whether_regular(gap, params.joined)));
}

JunctionType free_end_type(SegmentEnd end, double jump_sigmas, const PrimitiveParams& params) {
  // The angle on the robot's side is more than 180 degrees, whatever the hidden face does: an edge, or none of the
  // three.
  evidence::WhichKind which;
  which.one_or_other = {0.0, params.angle_committed, 0.0};
  which.unknown = 1.0 - params.angle_committed;
  const double jump = evidence::rising(jump_sigmas, params.free_end_none_sigmas, params.free_end_full_sigmas);
  const double solid = end == SegmentEnd::kOpen ? params.open_end_committed : params.free_end_committed * jump;
  return decide(evidence::combine(which, {.regular = solid, .other = 0.0, .unknown = 1.0 - solid}));
}

FusedBinaryMass radial_line_existence(const RadialLine& line, double gray_noise, const PrimitiveParams& params) {
  return evidence::conflict_to_ignorance(
      {params.line_support(line.visible_share), params.line_contrast(line.contrast / std::max(gray_noise, 0.1))});
}

void name_primitives(const SceneParts& parts, const PrimitiveParams& params, Scene& scene) {
  scene.primitives.clear();
  Namer namer(parts, params, scene);
  namer.add_walls();
  namer.add_junctions();
  namer.add_free_ends();
  namer.add_radial_lines();
}

}  // namespace credo::perception
