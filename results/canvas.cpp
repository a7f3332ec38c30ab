// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "results/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <string>

namespace credo::results {
namespace {

constexpr int kScale = 3;  // how many times as large everything is drawn
constexpr int kShift = 4;  // fractional bits of OpenCV's drawing functions
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kFontUnits = 21.0;  // height of a capital letter at font scale 1

cv::Scalar scalar(Color color) { return cv::Scalar(color.blue, color.green, color.red); }

cv::Point fixed(Canvas::Point p) {
  const auto rounded = [](double value) {
    return static_cast<int>(std::lround(std::clamp(value, -1e6, 1e6) * kScale * (1 << kShift)));
  };
  return {rounded(p.x()), rounded(p.y())};
}

int pixels(double length) { return std::max(1, static_cast<int>(std::lround(length * kScale))); }

std::vector<cv::Point> fixed(std::span<const Canvas::Point> points, Canvas::Point offset) {
  std::vector<cv::Point> result;
  result.reserve(points.size());
  for (const Canvas::Point& p : points) result.push_back(fixed(p - offset));
  return result;
}

}  // namespace

Color mixed(Color a, Color b, double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  const auto mix = [s](int x, int y) { return static_cast<int>(std::lround((1.0 - s) * x + s * y)); };
  return {mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue)};
}

Color color_of(perception::PrimitiveType type) {
  switch (type) {
    case perception::PrimitiveType::kCorner: return colors::kPurple;
    case perception::PrimitiveType::kEdge: return colors::kSky;  // blue is the estimate
    case perception::PrimitiveType::kWall: return colors::kOrange;
    case perception::PrimitiveType::kOther: return colors::kYellow;
  }
  return colors::kInk;
}

Color color_of(const evidence::BinaryMass& mass) {
  constexpr Color kUnknown{186, 188, 192};
  const double committed = std::max(mass.yes + mass.no, 1e-12);
  const Color side = mixed(colors::kGreen, colors::kRed, mass.no / committed);
  return mixed(side, kUnknown, mass.unknown);
}

Canvas::Canvas(int width, int height, Color background)
    : width_(width),
      height_(height),
      whole_(height * kScale, width * kScale, CV_8UC3, scalar(background)),
      view_(whole_) {}

void Canvas::clip(Point corner, Point opposite) {
  const auto bounded = [](double value, int limit) {
    return std::clamp(static_cast<int>(std::lround(value * kScale)), 0, limit);
  };
  const int left = bounded(corner.x(), whole_.cols), right = bounded(opposite.x(), whole_.cols);
  const int top = bounded(corner.y(), whole_.rows), bottom = bounded(opposite.y(), whole_.rows);
  view_ = whole_(cv::Rect(left, top, std::max(1, right - left), std::max(1, bottom - top)));
  offset_ = {static_cast<double>(left) / kScale, static_cast<double>(top) / kScale};
}

void Canvas::clip() {
  view_ = whole_;
  offset_ = {0, 0};
}

void Canvas::line(Point a, Point b, Color color, double thickness) {
  cv::line(view_, fixed(a - offset_), fixed(b - offset_), scalar(color), pixels(thickness), cv::LINE_AA, kShift);
}

void Canvas::dashed(Point a, Point b, Color color, double thickness, double dash) {
  const double length = (b - a).norm();
  if (!(length > 0.0)) return;
  constexpr double kMostDashes = 1000.0;  // of a line that leads far out of the picture they are longer
  dash = std::max(dash, 0.5 * length / kMostDashes);
  const Point step = (b - a) / length;
  for (double s = 0.0; s < length; s += 2.0 * dash)
    line(a + s * step, a + std::min(length, s + dash) * step, color, thickness);
}

void Canvas::polyline(std::span<const Point> points, Color color, double thickness) {
  if (points.size() < 2) return;
  const std::vector<std::vector<cv::Point>> all{fixed(points, offset_)};
  cv::polylines(view_, all, false, scalar(color), pixels(thickness), cv::LINE_AA, kShift);
}

void Canvas::polygon(std::span<const Point> points, Color fill, double opacity) {
  if (points.size() < 3) return;
  const std::vector<std::vector<cv::Point>> all{fixed(points, offset_)};
  if (opacity >= 1.0) {
    cv::fillPoly(view_, all, scalar(fill), cv::LINE_AA, kShift);
    return;
  }
  cv::Mat layer = view_.clone();
  cv::fillPoly(layer, all, scalar(fill), cv::LINE_AA, kShift);
  cv::addWeighted(layer, opacity, view_, 1.0 - opacity, 0.0, view_);
}

void Canvas::box(Point corner, Point opposite, Color fill, double opacity) {
  const std::vector<Point> points{corner, {opposite.x(), corner.y()}, opposite, {corner.x(), opposite.y()}};
  polygon(points, fill, opacity);
}

void Canvas::frame(Point corner, Point opposite, Color color, double thickness) {
  const std::vector<Point> points{corner, {opposite.x(), corner.y()}, opposite, {corner.x(), opposite.y()}, corner};
  polyline(points, color, thickness);
}

void Canvas::disc(Point centre, double radius, Color fill) {
  cv::circle(view_, fixed(centre - offset_), static_cast<int>(std::lround(radius * kScale * (1 << kShift))),
             scalar(fill), cv::FILLED, cv::LINE_AA, kShift);
}

void Canvas::circle(Point centre, double radius, Color color, double thickness) {
  cv::circle(view_, fixed(centre - offset_), static_cast<int>(std::lround(radius * kScale * (1 << kShift))),
             scalar(color), pixels(thickness), cv::LINE_AA, kShift);
}

void Canvas::arc(Point centre, double radius, double from, double to, Color color, double thickness) {
  const int steps = std::max(2, static_cast<int>(std::abs(to - from) * radius / 3.0));
  std::vector<Point> points;
  for (int i = 0; i <= steps; ++i) {
    const double angle = from + (to - from) * i / steps;
    points.push_back(centre + radius * Point(std::cos(angle), -std::sin(angle)));
  }
  polyline(points, color, thickness);
}

double text_width(std::string_view text, double height) {
  int baseline = 0;
  const cv::Size size = cv::getTextSize(std::string(text), kFont, kScale * height / kFontUnits, 1, &baseline);
  return static_cast<double>(size.width) / kScale;
}

void Canvas::text(Point baseline, std::string_view text, Color color, double height, Anchor anchor, double weight) {
  const double width = text_width(text, height);
  Point start = baseline - offset_;
  if (anchor == Anchor::kCentre) start.x() -= 0.5 * width;
  if (anchor == Anchor::kRight) start.x() -= width;
  const int thickness = std::max(1, static_cast<int>(std::lround(0.115 * height * kScale * weight)));
  cv::putText(
      view_, std::string(text),
      cv::Point(static_cast<int>(std::lround(start.x() * kScale)), static_cast<int>(std::lround(start.y() * kScale))),
      kFont, kScale * height / kFontUnits, scalar(color), thickness, cv::LINE_AA);
}

void Canvas::text_upwards(Point centre, std::string_view text, Color color, double height) {
  const double width = text_width(text, height), margin = height;
  const int long_side = pixels(width + 2.0 * margin), short_side = pixels(3.0 * height);
  const cv::Rect target(static_cast<int>((centre.x() - offset_.x()) * kScale) - short_side / 2,
                        static_cast<int>((centre.y() - offset_.y()) * kScale) - long_side / 2, short_side, long_side);
  if ((target & cv::Rect(0, 0, view_.cols, view_.rows)) != target) return;
  cv::Mat turned;
  cv::rotate(view_(target), turned, cv::ROTATE_90_CLOCKWISE);
  const int thickness = std::max(1, static_cast<int>(std::lround(0.115 * height * kScale)));
  cv::putText(turned, std::string(text), cv::Point(pixels(margin), pixels(2.0 * height)), kFont,
              kScale * height / kFontUnits, scalar(color), thickness, cv::LINE_AA);
  cv::Mat back;
  cv::rotate(turned, back, cv::ROTATE_90_COUNTERCLOCKWISE);
  back.copyTo(view_(target));
}

void Canvas::image(const cv::Mat& source, Point corner, Point opposite, bool keep_pixels) {
  const cv::Size size(pixels(opposite.x() - corner.x()), pixels(opposite.y() - corner.y()));
  cv::Mat color, scaled;
  if (source.channels() == 1)
    cv::cvtColor(source, color, cv::COLOR_GRAY2BGR);
  else
    color = source;
  const bool reduces = size.width < color.cols;
  cv::resize(color, scaled, size, 0, 0, reduces ? cv::INTER_AREA : keep_pixels ? cv::INTER_NEAREST : cv::INTER_CUBIC);
  const cv::Point at(static_cast<int>(std::lround((corner.x() - offset_.x()) * kScale)),
                     static_cast<int>(std::lround((corner.y() - offset_.y()) * kScale)));
  const cv::Rect wanted(at, size), visible = wanted & cv::Rect(0, 0, view_.cols, view_.rows);
  if (visible.empty()) return;
  scaled(cv::Rect(visible.tl() - at, visible.size())).copyTo(view_(visible));
}

cv::Mat Canvas::finish() const {
  cv::Mat result;
  cv::resize(whole_, result, cv::Size(width_, height_), 0, 0, cv::INTER_AREA);
  return result;
}

double legend(Canvas& canvas, Canvas::Point left, std::span<const LegendEntry> entries, double height) {
  double x = left.x();
  for (const LegendEntry& entry : entries) {
    canvas.box({x, left.y() - height}, {x + 1.4 * height, left.y()}, entry.color);
    x += 1.4 * height + 5.0;
    canvas.text({x, left.y()}, entry.text, colors::kInk, height);
    x += text_width(entry.text, height) + 16.0;
  }
  return x;
}

void color_bar(Canvas& canvas, Color full, Canvas::Point top_left, double width, std::string_view low,
               std::string_view high) {
  constexpr int kSteps = 30;
  constexpr double kHeight = 8.0;
  const double left = top_left.x(), top = top_left.y();
  for (int i = 0; i < kSteps; ++i)
    canvas.box({left + width * i / kSteps, top}, {left + width * (i + 1) / kSteps, top + kHeight},
               mixed(colors::kPaper, full, (i + 0.5) / kSteps));
  canvas.frame(top_left, {left + width, top + kHeight}, colors::kMuted, 0.7);
  canvas.text({left - 5.0, top + kHeight}, low, colors::kInk, 7.5, Anchor::kRight);
  canvas.text({left + width + 5.0, top + kHeight}, high, colors::kInk, 7.5);
}

}  // namespace credo::results
