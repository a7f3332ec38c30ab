// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "results/plot.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace credo::results {

using Point = Canvas::Point;

namespace {
constexpr double kTitleHeight = 10.0, kLegendHeight = 8.0;  // of a capital letter
}  // namespace

std::vector<double> ticks(double low, double high, int wanted) {
  if (!(high > low) || !std::isfinite(high - low)) return {low};
  const double rough = (high - low) / std::max(1, wanted);
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * power;
  for (const double factor : {1.0, 2.0, 2.5, 5.0}) {
    if (factor * power >= 0.999 * rough) {
      step = factor * power;
      break;
    }
  }
  std::vector<double> result;
  for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k += 1.0)
    result.push_back(k * step + 0.0);
  return result;
}

std::string tick_label(double value, double step) {
  int decimals = 0;
  for (double s = step; decimals < 6 && std::abs(s - std::round(s)) > 1e-6 * std::max(1.0, std::abs(s)); s *= 10.0)
    ++decimals;
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", decimals, std::abs(value) < 1e-9 * step ? 0.0 : value);
  return text;
}

namespace {

/// How lengths of about some metres are written.
struct LengthUnit {
  double per_metre;
  int decimals;
  const char* name;

  static LengthUnit of(double metres) {
    if (std::abs(metres) < 1.0) return {100.0, 1, "cm"};
    return {1.0, std::abs(metres) < 100.0 ? 2 : 0, "m"};
  }
};

}  // namespace

std::string length_text(double metres) {
  const LengthUnit unit = LengthUnit::of(metres);
  char text[64];
  std::snprintf(text, sizeof text, "%.*f %s", unit.decimals, metres * unit.per_metre, unit.name);
  return text;
}

std::string size_text(double longer_m, double shorter_m) {
  const LengthUnit unit = LengthUnit::of(longer_m);
  char text[96];
  std::snprintf(text, sizeof text, "%.*f x %.*f %s", unit.decimals, longer_m * unit.per_metre, unit.decimals,
                shorter_m * unit.per_metre, unit.name);
  return text;
}

struct Plot::Axes {
  double x0 = 0, x1 = 1, y0 = 0, y1 = 1;            // data
  double left = 0, right = 1, top = 0, bottom = 1;  // canvas
  double title = 0;                                 // baseline
  [[nodiscard]] Point at(double x, double y) const {
    return {left + (x - x0) / (x1 - x0) * (right - left), bottom - (y - y0) / (y1 - y0) * (bottom - top)};
  }
};

Plot& Plot::line(std::vector<double> x, std::vector<double> y, Color color, std::string label, double thickness) {
  series_.push_back({Kind::kLine, std::move(x), std::move(y), {}, color, std::move(label), thickness});
  return *this;
}

Plot& Plot::points(std::vector<double> x, std::vector<double> y, Color color, std::string label, double radius) {
  series_.push_back({Kind::kPoints, std::move(x), std::move(y), {}, color, std::move(label), radius});
  return *this;
}

Plot& Plot::band(std::vector<double> x, std::vector<double> low, std::vector<double> high, Color color,
                 std::string label, double opacity) {
  series_.push_back(
      {Kind::kBand, std::move(x), std::move(low), std::move(high), color, std::move(label), 1.0, opacity});
  return *this;
}

Plot& Plot::whiskers(std::vector<double> x, std::vector<double> low, std::vector<double> high, Color color,
                     std::string label, double thickness) {
  series_.push_back(
      {Kind::kWhiskers, std::move(x), std::move(low), std::move(high), color, std::move(label), thickness});
  return *this;
}

Plot& Plot::level(double y, Color color, std::string label) {
  series_.push_back({Kind::kLevel, {}, {y}, {}, color, std::move(label)});
  return *this;
}

Plot& Plot::strip(std::vector<double> x, std::vector<Color> colors) {
  strip_x_ = std::move(x);
  strip_colors_ = std::move(colors);
  return *this;
}

Plot& Plot::x_limits(double low, double high) {
  x_limits_ = {low, high};
  return *this;
}

Plot& Plot::y_limits(double low, double high) {
  y_limits_ = {low, high};
  return *this;
}

namespace {

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void include(std::span<const double> values) {
    for (const double v : values) {
      if (!std::isfinite(v)) continue;
      low = std::min(low, v);
      high = std::max(high, v);
    }
  }
  /// \param margin  share of the range added at both ends
  [[nodiscard]] std::pair<double, double> widened(double margin) const {
    if (!(low <= high)) return {0.0, 1.0};
    const double reach = high > low ? high - low : std::max(1e-3, std::abs(high));
    return {low - margin * reach - (high > low ? 0.0 : 0.5 * reach),
            high + margin * reach + (high > low ? 0.0 : 0.5 * reach)};
  }
};

void draw_whisker(Canvas& canvas, const Point& low, const Point& high, Color color, double thickness) {
  const Point half_cap(3.0, 0.0);
  canvas.line(low, high, color, thickness);
  canvas.line(low - half_cap, low + half_cap, color, thickness);
  canvas.line(high - half_cap, high + half_cap, color, thickness);
}

}  // namespace

Plot::Axes Plot::fit(Point corner, Point opposite) const {
  Range xs, ys;
  for (const Series& s : series_) {
    xs.include(s.x);
    ys.include(s.y);
    ys.include(s.high);
  }
  xs.include(strip_x_);
  Axes axes;
  std::tie(axes.x0, axes.x1) = x_limits_.empty() ? xs.widened(0.0) : std::pair{x_limits_[0], x_limits_[1]};
  std::tie(axes.y0, axes.y1) = y_limits_.empty() ? ys.widened(0.06) : std::pair{y_limits_[0], y_limits_[1]};
  if (!(axes.x1 > axes.x0)) axes.x1 = axes.x0 + 1.0;
  if (!(axes.y1 > axes.y0)) axes.y1 = axes.y0 + 1.0;
  axes.left = corner.x() + 66.0;
  axes.right = opposite.x() - 16.0;
  axes.title = corner.y() + 25.0;
  axes.top = corner.y() + (title_.empty() ? 14.0 : 34.0);
  if (text_width(title_, kTitleHeight) + legend_width() > axes.right - axes.left) axes.top += 18.0;
  axes.bottom = opposite.y() - (x_label_.empty() ? 24.0 : 42.0);
  return axes;
}

void Plot::draw_series(Canvas& canvas, const Axes& axes, const Series& s) const {
  if (s.kind == Kind::kLevel) {
    canvas.dashed(axes.at(axes.x0, s.y[0]), axes.at(axes.x1, s.y[0]), s.color, 1.2);
    return;
  }
  std::vector<Point> run, run_high;
  const auto flush = [&] {
    if (s.kind == Kind::kLine) canvas.polyline(run, s.color, s.size);
    if (s.kind == Kind::kBand) {
      run.insert(run.end(), run_high.rbegin(), run_high.rend());
      canvas.polygon(run, s.color, s.opacity);
    }
    run.clear();
    run_high.clear();
  };
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    const bool interval = s.kind == Kind::kBand || s.kind == Kind::kWhiskers;
    if (!std::isfinite(s.y[i]) || (interval && !std::isfinite(s.high[i]))) {
      flush();
      continue;
    }
    if (s.kind == Kind::kWhiskers) {
      draw_whisker(canvas, axes.at(s.x[i], s.y[i]), axes.at(s.x[i], s.high[i]), s.color, s.size);
      continue;
    }
    if (s.kind == Kind::kPoints) {
      canvas.disc(axes.at(s.x[i], s.y[i]), s.size, s.color);
      continue;
    }
    run.push_back(axes.at(s.x[i], s.y[i]));
    if (s.kind == Kind::kBand) run_high.push_back(axes.at(s.x[i], s.high[i]));
  }
  flush();
}

void Plot::draw_strip(Canvas& canvas, const Axes& axes) const {
  constexpr double kHeight = 7.0;
  if (!strip_x_.empty())
    canvas.box({axes.left, axes.bottom - kHeight - 2.0}, {axes.right, axes.bottom}, colors::kPaper);
  for (std::size_t i = 0; i < strip_x_.size(); ++i) {
    const double last_step = i > 0 ? strip_x_[i] - strip_x_[i - 1] : axes.x1 - axes.x0;
    const double end = i + 1 < strip_x_.size() ? strip_x_[i + 1] : strip_x_[i] + last_step;
    canvas.box({axes.at(strip_x_[i], 0).x(), axes.bottom - kHeight}, {axes.at(end, 0).x(), axes.bottom},
               strip_colors_[i]);
  }
}

double Plot::legend_width() const {
  double width = 0.0;
  for (const Series& s : series_) width += s.label.empty() ? 0.0 : text_width(s.label, kLegendHeight) + 32.0;
  return width;
}

void Plot::draw_legend(Canvas& canvas, const Axes& axes) const {
  std::vector<LegendEntry> entries;
  for (const Series& s : series_) {
    if (s.label.empty()) continue;
    entries.push_back(
        {s.kind == Kind::kBand ? mixed(colors::kPaper, s.color, std::max(0.3, s.opacity)) : s.color, s.label});
  }
  legend(canvas, {axes.right - legend_width() + 12.0, axes.top - 9.0}, entries, kLegendHeight);
}

void Plot::draw(Canvas& canvas, Point corner, Point opposite) const {
  const Axes axes = fit(corner, opposite);
  const auto xs = ticks(axes.x0, axes.x1, std::max(2, static_cast<int>((axes.right - axes.left) / 90.0)));
  const auto ys = ticks(axes.y0, axes.y1, std::max(2, static_cast<int>((axes.bottom - axes.top) / 40.0)));
  for (const double x : xs) canvas.line(axes.at(x, axes.y0), axes.at(x, axes.y1), {232, 234, 238}, 0.7);
  for (const double y : ys) canvas.line(axes.at(axes.x0, y), axes.at(axes.x1, y), {232, 234, 238}, 0.7);
  canvas.clip({axes.left, axes.top}, {axes.right, axes.bottom});
  for (const Series& s : series_) draw_series(canvas, axes, s);
  draw_strip(canvas, axes);
  canvas.clip();
  canvas.frame({axes.left, axes.top}, {axes.right, axes.bottom}, colors::kMuted, 0.8);
  const double x_step = xs.size() > 1 ? xs[1] - xs[0] : 1.0, y_step = ys.size() > 1 ? ys[1] - ys[0] : 1.0;
  for (const double x : xs) {
    canvas.text({axes.at(x, 0).x(), axes.bottom + 15.0}, tick_label(x, x_step), colors::kInk, 8.0, Anchor::kCentre);
  }
  for (const double y : ys) {
    canvas.text({axes.left - 6.0, axes.at(0, y).y() + 4.0}, tick_label(y, y_step), colors::kInk, 8.0, Anchor::kRight);
  }
  canvas.text({axes.left, axes.title}, title_, colors::kInk, kTitleHeight, Anchor::kLeft, 1.25);
  canvas.text({0.5 * (axes.left + axes.right), axes.bottom + 33.0}, x_label_, colors::kInk, 8.5, Anchor::kCentre);
  canvas.text_upwards({corner.x() + 13.0, 0.5 * (axes.top + axes.bottom)}, y_label_, colors::kInk, 8.5);
  draw_legend(canvas, axes);
}

}  // namespace credo::results
