// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "geometry/principal_axes.hpp"
#include "results/ground_view.hpp"
#include "results/pictures.hpp"
#include "results/plot.hpp"
#include "results/status_colors.hpp"

namespace credo::results {
namespace {

using perception::PrimitiveType;
using Point = Canvas::Point;
constexpr double kPanel = 270.0;  // width of the panel with the ellipse and the numbers

struct Extent {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d high = Eigen::Vector2d::Constant(-std::numeric_limits<double>::infinity());
  void include(const Eigen::Vector2d& point) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
};

Extent extent_of(const PlanView& view) {
  Extent extent;
  for (const geometry::Segment& wall : view.plan.walls) {
    extent.include(wall.a);
    extent.include(wall.b);
  }
  for (const Moment& m : view.history) extent.include(m.localization.estimate.pose.translation());
  const double margin = 0.04 * (extent.high - extent.low).maxCoeff() + 0.3;
  extent.low.array() -= margin;
  extent.high.array() += margin;
  return extent;
}

void draw_trails(Canvas& canvas, const GroundView& ground, std::span<const Moment> history) {
  std::vector<Point> estimated, true_way;
  for (const Moment& m : history) {
    estimated.push_back(ground.at(m.localization.estimate.pose.translation()));
    if (m.truth) true_way.push_back(ground.at(m.truth->translation()));
  }
  canvas.polyline(true_way, colors::kOrange, 3.4);
  canvas.polyline(estimated, colors::kBlue, 1.5);
  for (const Moment& m : history) {
    canvas.disc(ground.at(m.localization.estimate.pose.translation()), 2.0, color_of(m.localization.status));
  }
}

void draw_landmark(Canvas& canvas, const GroundView& ground, const localization::LandmarkMap& map,
                   tracking::LandmarkId id) {
  if (map.is_wall(id)) {
    const geometry::Segment& wall = map.wall(id).extent;
    canvas.line(ground.at(wall.a), ground.at(wall.b), colors::kGreen, 4.2);
  } else {
    canvas.circle(ground.at(map.point(id).position), 7.0, colors::kGreen, 1.6);
  }
}

void draw_tracks(Canvas& canvas, const GroundView& ground, const PlanView& view, const geometry::Pose2& pose) {
  for (const tracking::Track& t : view.tracks) {
    if (t.state != tracking::TrackState::kTracked) continue;
    const Eigen::Vector2d robot = pose.translation();
    if (t.last_seen.bearing_only) {
      const double azimuth = pose.theta + t.azimuth;
      const Eigen::Vector2d end = robot + 1.2 * Eigen::Vector2d(std::cos(azimuth), std::sin(azimuth));
      canvas.dashed(ground.at(robot), ground.at(end), mixed(color_of(t.type), colors::kPaper, 0.3), 1.0, 3.0);
      continue;
    }
    const Eigen::Vector2d position = pose * t.last_seen.position;
    if (t.type != PrimitiveType::kWall) {
      canvas.line(ground.at(robot), ground.at(position), mixed(color_of(t.type), colors::kPaper, 0.65), 0.8);
      draw_mark(canvas, ground.at(position), t.type, 4.5, t.landmark != tracking::kNoLandmark);
    } else {
      const geometry::Segment seen = pose * t.last_seen.extent;
      canvas.line(ground.at(seen.a), ground.at(seen.b), colors::kInk, 1.4);
    }
  }
}

/// The ellipse drawn as large as it takes to see it, beside a scale.
void draw_ellipse_panel(Canvas& canvas, const Moment& moment, Point corner, double side) {
  const geometry::PoseEstimate& estimate = moment.localization.estimate;
  const Eigen::Matrix2d covariance = estimate.covariance.topLeftCorner<2, 2>();
  const auto outline = ellipse({0, 0}, covariance, 3.0);
  double reach = 0.01;
  for (const Eigen::Vector2d& p : outline) reach = std::max(reach, 1.15 * p.cwiseAbs().maxCoeff());
  if (moment.truth) {
    reach = std::max(reach, 1.3 * (moment.truth->translation() - estimate.pose.translation()).cwiseAbs().maxCoeff());
  }
  const GroundView zoom({-reach, -reach}, {reach, reach}, corner, corner + Point(side, side));
  canvas.clip(corner, corner + Point(side, side));
  zoom.grid(canvas);
  std::vector<Point> points;
  for (const Eigen::Vector2d& p : outline) points.push_back(zoom.at(p));
  canvas.polygon(points, colors::kSky, 0.35);
  canvas.polyline(points, colors::kBlue, 1.6);
  canvas.disc(zoom.at({0, 0}), 3.2, colors::kBlue);
  if (moment.truth) {
    const Point truth = zoom.at(moment.truth->translation() - estimate.pose.translation());
    canvas.line(truth - Point(6, 6), truth + Point(6, 6), colors::kOrange, 2.2);
    canvas.line(truth - Point(6, -6), truth + Point(6, -6), colors::kOrange, 2.2);
  }
  zoom.scale_bar(canvas);
  canvas.clip();
  canvas.frame(corner, corner + Point(side, side), colors::kMuted, 0.8);
}

void draw_belief_bar(Canvas& canvas, const evidence::BinaryMass& belief, Point corner, double width) {
  const double yes = width * belief.yes, unknown = width * belief.unknown;
  canvas.box(corner, corner + Point(yes, 14.0), color_of(evidence::BinaryMass{1, 0, 0}));
  canvas.box(corner + Point(yes, 0.0), corner + Point(yes + unknown, 14.0), color_of(evidence::BinaryMass{0, 0, 1}));
  canvas.box(corner + Point(yes + unknown, 0.0), corner + Point(width, 14.0), color_of(evidence::BinaryMass{0, 1, 0}));
}

void draw_panel(Canvas& canvas, const Moment& moment, Point corner) {
  const localization::Localization& l = moment.localization;
  const double width = kPanel - 30.0;
  double y = corner.y() + 14.0;
  const auto say = [&](const char* format, auto... values) {
    char text[128];
    std::snprintf(text, sizeof text, format, values...);
    constexpr double kText_px = 8.5;
    canvas.text({corner.x(), y}, text, colors::kInk, kText_px * std::min(1.0, width / text_width(text, kText_px)));
    y += 19.0;
  };
  canvas.disc({corner.x() + 6.0, y - 4.5}, 6.0, color_of(l.status));
  canvas.text({corner.x() + 18.0, y}, localization::to_string(l.status), colors::kInk, 11.0, Anchor::kLeft, 1.3);
  y += 22.0;
  say("belief: yes %.2f, no %.2f", l.belief.yes, l.belief.no);
  draw_belief_bar(canvas, l.belief, {corner.x(), y - 10.0}, width);
  y += 24.0;
  say("%d matched of %d seen, %d tracks", l.matched, l.detected, l.tracked);
  const auto axes = geometry::principal_axes(l.estimate.covariance.topLeftCorner<2, 2>());
  const auto sigma = [](double variance) { return std::sqrt(std::max(0.0, variance)); };
  say("3 sigma: %s, %.2f deg", size_text(3.0 * sigma(axes.largest), 3.0 * sigma(axes.smallest)).c_str(),
      3.0 * geometry::to_degrees(sigma(l.estimate.covariance(2, 2))));
  if (moment.truth) {
    const geometry::Pose2& pose = l.estimate.pose;
    say("error: %s, %.2f deg", length_text((moment.truth->translation() - pose.translation()).norm()).c_str(),
        std::abs(geometry::to_degrees(geometry::angle_difference(moment.truth->theta, pose.theta))));
  }
  draw_ellipse_panel(canvas, moment, {corner.x(), y}, width);
}

void draw_foot(Canvas& canvas, double y, bool truth) {
  std::vector<LegendEntry> entries{{colors::kBlue, "estimate"}};
  if (truth) entries.push_back({colors::kOrange, "truth"});
  for (const LegendEntry& e : {LegendEntry{{150, 154, 162}, "plan"},
                               {colors::kGreen, "matched"},
                               {colors::kInk, "wall as seen"},
                               {color_of(PrimitiveType::kCorner), "corner"},
                               {color_of(PrimitiveType::kEdge), "edge"},
                               {color_of(PrimitiveType::kOther), "other"}}) {
    entries.push_back(e);
  }
  double x = legend(canvas, {14.0, y}, entries);
  const char* const hollow = "hollow: not matched";
  canvas.text({x, y}, hollow, colors::kInk, 8.0);
  x += text_width(hollow, 8.0) + 16.0;
  canvas.dashed({x, y - 4.0}, {x + 24.0, y - 4.0}, colors::kMuted, 1.2, 3.0);
  canvas.text({x + 30.0, y}, "direction only", colors::kInk, 8.0);
}

}  // namespace

cv::Mat plan_picture(const PlanView& view) {
  const Extent extent = extent_of(view);
  const Eigen::Vector2d size = extent.high - extent.low;
  const double map_width = 800.0, map_height = std::clamp(map_width * size.y() / size.x(), 430.0, 900.0);
  Canvas canvas(static_cast<int>(map_width + kPanel), static_cast<int>(map_height + 34.0));
  const GroundView ground(extent.low, extent.high, {0.0, 0.0}, {map_width, map_height});
  const Moment& now = view.history.back();
  const geometry::Pose2& pose = now.localization.estimate.pose;
  canvas.clip({0.0, 0.0}, {map_width, map_height});
  ground.grid(canvas);
  for (const geometry::Segment& wall : view.plan.walls)
    canvas.line(ground.at(wall.a), ground.at(wall.b), {150, 154, 162}, 2.4);
  for (const Eigen::Vector2d& mark : view.plan.verticals) canvas.disc(ground.at(mark), 2.0, {150, 154, 162});
  if (view.landmarks != nullptr) {
    for (const tracking::Track& t : view.tracks) {
      if (t.landmark == tracking::kNoLandmark || t.state != tracking::TrackState::kTracked) continue;
      draw_landmark(canvas, ground, *view.landmarks, t.landmark);
    }
  }
  draw_trails(canvas, ground, view.history);
  draw_tracks(canvas, ground, view, pose);
  draw_robot(canvas, ground, pose, view.robot_radius_m, colors::kBlue);
  std::vector<Point> outline;
  for (const Eigen::Vector2d& p :
       ellipse(pose.translation(), now.localization.estimate.covariance.topLeftCorner<2, 2>(), 3.0)) {
    outline.push_back(ground.at(p));
  }
  canvas.polyline(outline, colors::kBlue, 1.2);
  ground.scale_bar(canvas);
  canvas.clip();
  draw_panel(canvas, now, {map_width + 15.0, 12.0});
  draw_foot(canvas, map_height + 20.0, now.truth.has_value());
  return canvas.finish();
}

}  // namespace credo::results
