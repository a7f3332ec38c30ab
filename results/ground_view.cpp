// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "results/ground_view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/principal_axes.hpp"
#include "results/plot.hpp"

namespace credo::results {

using Point = Canvas::Point;

GroundView::GroundView(Eigen::Vector2d low, Eigen::Vector2d high, Point corner, Point opposite)
    : middle_(0.5 * (low + high)), centre_(0.5 * (corner + opposite)), corner_(corner), opposite_(opposite) {
  const Eigen::Vector2d size = (high - low).cwiseMax(1e-3);
  scale_ = std::min((opposite.x() - corner.x()) / size.x(), (opposite.y() - corner.y()) / size.y());
}

Eigen::Vector2d GroundView::low() const {
  return {middle_.x() + (corner_.x() - centre_.x()) / scale_, middle_.y() - (opposite_.y() - centre_.y()) / scale_};
}

Eigen::Vector2d GroundView::high() const {
  return {middle_.x() + (opposite_.x() - centre_.x()) / scale_, middle_.y() - (corner_.y() - centre_.y()) / scale_};
}

void GroundView::grid(Canvas& canvas, Color color) const {
  const Eigen::Vector2d from = low(), to = high();
  const std::vector<double> xs = ticks(from.x(), to.x(), 10);
  const double step = xs.size() > 1 ? xs[1] - xs[0] : 1.0;
  for (const double x : xs) canvas.line(at({x, from.y()}), at({x, to.y()}), color, 0.7);
  for (double y = std::ceil(from.y() / step) * step; y <= to.y(); y += step) {
    canvas.line(at({from.x(), y}), at({to.x(), y}), color, 0.7);
  }
}

void GroundView::scale_bar(Canvas& canvas) const {
  const std::vector<double> xs = ticks(low().x(), high().x(), 6);
  const double step = xs.size() > 1 ? xs[1] - xs[0] : 1.0;
  const std::string label =
      step >= 1.0 ? tick_label(step, step) + " m" : tick_label(100.0 * step, 100.0 * step) + " cm";
  const double room = std::max(pixels(step), text_width(label, 8.5));
  // In the corner; in the middle where the box is hardly wider than the bar.
  const double middle = std::max(opposite_.x() - 12.0 - 0.5 * room, std::min(centre_.x(), opposite_.x() - 0.5 * room));
  const Point end{middle + 0.5 * pixels(step), opposite_.y() - 10.0}, start{end.x() - pixels(step), end.y()};
  canvas.box({middle - 0.5 * room - 6.0, end.y() - 22.0}, {middle + 0.5 * room + 6.0, end.y() + 7.0}, colors::kPaper,
             0.85);
  canvas.line(start, end, colors::kInk, 1.6);
  canvas.line({start.x(), end.y() - 4.0}, {start.x(), end.y() + 4.0}, colors::kInk, 1.6);
  canvas.line({end.x(), end.y() - 4.0}, {end.x(), end.y() + 4.0}, colors::kInk, 1.6);
  canvas.text({middle, end.y() - 8.0}, label, colors::kInk, 8.5, Anchor::kCentre);
}

std::vector<Eigen::Vector2d> ellipse(const Eigen::Vector2d& centre, const Eigen::Matrix2d& covariance, double sigmas) {
  constexpr int kSteps = 72;
  const geometry::PrincipalAxes axes = geometry::principal_axes(covariance);
  const double major = sigmas * std::sqrt(std::max(0.0, axes.largest));
  const double minor = sigmas * std::sqrt(std::max(0.0, axes.smallest));
  const double c = std::cos(axes.angle), s = std::sin(axes.angle);
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kSteps;
    const double along = major * std::cos(angle), across = minor * std::sin(angle);
    points.emplace_back(centre.x() + c * along - s * across, centre.y() + s * along + c * across);
  }
  return points;
}

void draw_robot(Canvas& canvas, const GroundView& view, const geometry::Pose2& pose, double radius_m, Color color) {
  const Point centre = view.at(pose.translation());
  const double radius = std::max(5.0, view.pixels(radius_m));
  canvas.disc(centre, radius, mixed(color, colors::kPaper, 0.55));
  canvas.circle(centre, radius, color, 1.6);
  canvas.line(centre, centre + radius * Point(std::cos(pose.theta), -std::sin(pose.theta)), color, 2.2);
}

void draw_mark(Canvas& canvas, Point at, perception::PrimitiveType type, double size, bool filled) {
  const Color color = color_of(type), inside = filled ? color : colors::kPaper;
  const double s = size;
  switch (type) {
    case perception::PrimitiveType::kCorner: {
      const double half = 0.85 * s;
      canvas.box({at.x() - half, at.y() - half}, {at.x() + half, at.y() + half}, inside);
      canvas.frame({at.x() - half, at.y() - half}, {at.x() + half, at.y() + half}, filled ? colors::kInk : color, 1.0);
      break;
    }
    case perception::PrimitiveType::kEdge: {
      const std::vector<Point> diamond{{at.x(), at.y() - 1.2 * s},
                                       {at.x() + 1.2 * s, at.y()},
                                       {at.x(), at.y() + 1.2 * s},
                                       {at.x() - 1.2 * s, at.y()},
                                       {at.x(), at.y() - 1.2 * s}};
      canvas.polygon(diamond, inside);
      canvas.polyline(diamond, filled ? colors::kInk : color, 1.0);
      break;
    }
    case perception::PrimitiveType::kWall:
    case perception::PrimitiveType::kOther:
      canvas.disc(at, s, inside);
      canvas.circle(at, s, filled ? colors::kInk : color, 1.0);
      break;
  }
}

}  // namespace credo::results
