// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <span>
#include <string>
#include <vector>

#include "results/canvas.hpp"

namespace credo::results {

/// Round numbers that divide [low, high] into about `wanted` steps of 1, 2, 2.5 or 5 times a power of ten.
[[nodiscard]] std::vector<double> ticks(double low, double high, int wanted = 5);
/// A tick as it is written beside the axis, with the decimals that the step needs.
[[nodiscard]] std::string tick_label(double value, double step);

/// A length for people: in cm, from 1 m on in m, and without decimals from 100 m on.
[[nodiscard]] std::string length_text(double metres);
/// Two lengths in the unit of the longer one: "1.3 x 1.2 cm".
[[nodiscard]] std::string size_text(double longer_m, double shorter_m);

/// A chart: series over one axis, with frame, grid, ticks, labels and legend (beside the title, or below it where it is
/// too long). Values that are not finite leave a gap.
class Plot {
 public:
  Plot(std::string title, std::string x_label, std::string y_label)
      : title_(std::move(title)), x_label_(std::move(x_label)), y_label_(std::move(y_label)) {}

  /// Without a label a series does not appear in the legend.
  Plot& line(std::vector<double> x, std::vector<double> y, Color color, std::string label = "", double thickness = 1.6);
  Plot& points(std::vector<double> x, std::vector<double> y, Color color, std::string label = "", double radius = 2.2);
  /// The area between two curves.
  Plot& band(std::vector<double> x, std::vector<double> low, std::vector<double> high, Color color,
             std::string label = "", double opacity = 0.25);
  /// From low[i] to high[i] at x[i], with caps: an interval for each value.
  Plot& whiskers(std::vector<double> x, std::vector<double> low, std::vector<double> high, Color color,
                 std::string label = "", double thickness = 1.2);
  /// A horizontal line across.
  Plot& level(double y, Color color, std::string label = "");
  /// A coloured strip along the foot of the chart from x[i] to x[i + 1] (the last as long as the one before).
  Plot& strip(std::vector<double> x, std::vector<Color> colors);
  Plot& x_limits(double low, double high);
  Plot& y_limits(double low, double high);

  /// Into a box of the canvas, labels included.
  void draw(Canvas& canvas, Canvas::Point corner, Canvas::Point opposite) const;

 private:
  enum class Kind { kLine, kPoints, kBand, kWhiskers, kLevel };
  struct Series {
    Kind kind;
    std::vector<double> x, y, high;
    Color color;
    std::string label;
    double size = 1.0;
    double opacity = 1.0;
  };
  struct Axes;

  void draw_series(Canvas& canvas, const Axes& axes, const Series& series) const;
  void draw_legend(Canvas& canvas, const Axes& axes) const;
  [[nodiscard]] double legend_width() const;
  void draw_strip(Canvas& canvas, const Axes& axes) const;
  [[nodiscard]] Axes fit(Canvas::Point corner, Canvas::Point opposite) const;

  std::string title_, x_label_, y_label_;
  std::vector<Series> series_;
  std::vector<double> strip_x_;
  std::vector<Color> strip_colors_;
  std::vector<double> x_limits_, y_limits_;  // empty: from the series
};

}  // namespace credo::results
