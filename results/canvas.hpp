// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "evidence/binary_mass.hpp"
#include "perception/scene.hpp"

namespace credo::results {

struct Color {
  int red = 0, green = 0, blue = 0;

  friend bool operator==(const Color&, const Color&) = default;
};

namespace colors {  // after Okabe and Ito: told apart by the colour-blind, too
inline constexpr Color kInk{40, 44, 52}, kFaint{205, 209, 215}, kMuted{125, 130, 140}, kPaper{255, 255, 255};
inline constexpr Color kBlue{0, 98, 168}, kOrange{222, 120, 0}, kGreen{0, 140, 100}, kRed{200, 58, 20};
inline constexpr Color kPurple{160, 72, 140}, kSky{86, 180, 233}, kYellow{236, 196, 40};
}  // namespace colors

[[nodiscard]] Color mixed(Color a, Color b, double share_of_b);
[[nodiscard]] Color color_of(perception::PrimitiveType type);
/// YES green, NO red, ignorance grey, in the proportion of the masses.
[[nodiscard]] Color color_of(const evidence::BinaryMass& mass);

enum class Anchor { kLeft, kCentre, kRight };

/// A drawing surface in pixels with smooth lines and text: everything is drawn several times as large and reduced at
/// the end. x right, y down. Text is ASCII.
class Canvas {
 public:
  using Point = Eigen::Vector2d;

  Canvas(int width, int height, Color background = colors::kPaper);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

  void line(Point a, Point b, Color color, double thickness = 1.0);
  void dashed(Point a, Point b, Color color, double thickness = 1.0, double dash = 6.0);
  void polyline(std::span<const Point> points, Color color, double thickness = 1.0);
  void polygon(std::span<const Point> points, Color fill, double opacity = 1.0);
  void box(Point corner, Point opposite, Color fill, double opacity = 1.0);
  void frame(Point corner, Point opposite, Color color, double thickness = 1.0);
  void disc(Point centre, double radius, Color fill);
  void circle(Point centre, double radius, Color color, double thickness = 1.0);
  /// From `from` to `to` [rad], counter-clockwise as seen (y down is taken care of).
  void arc(Point centre, double radius, double from, double to, Color color, double thickness);
  /// \param height  of a capital letter
  void text(Point baseline, std::string_view text, Color color = colors::kInk, double height = 9.0,
            Anchor anchor = Anchor::kLeft, double weight = 1.0);
  /// Turned by 90 degrees, reading upwards; centred.
  void text_upwards(Point centre, std::string_view text, Color color = colors::kInk, double height = 9.0);
  /// An image into a box, with the nearest pixel (true) or smoothly. CV_8UC1 or CV_8UC3.
  void image(const cv::Mat& pixels, Point corner, Point opposite, bool keep_pixels = true);

  /// Nothing outside of the box is drawn until the next call; an empty call ends it.
  void clip(Point corner, Point opposite);
  void clip();

  /// CV_8UC3, width x height.
  [[nodiscard]] cv::Mat finish() const;

 private:
  int width_, height_;
  cv::Mat whole_;
  cv::Mat view_;        // the part of whole_ that is drawn into
  Point offset_{0, 0};  // of view_ in whole_, in final pixels
};

[[nodiscard]] double text_width(std::string_view text, double height = 9.0);

/// What stands for what, one entry after the other: a swatch and a word.
struct LegendEntry {
  Color color;
  std::string_view text;
};
/// In one row from `left`, baseline at `y`. \returns the x where it ends
double legend(Canvas& canvas, Canvas::Point left, std::span<const LegendEntry> entries, double height = 8.0);

/// A bar from white to `full`, with what its ends stand for beside it.
void color_bar(Canvas& canvas, Color full, Canvas::Point top_left, double width, std::string_view low = "0",
               std::string_view high = "1");

}  // namespace credo::results
