// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "geometry/pose.hpp"
#include "results/canvas.hpp"

namespace credo::results {

/// How a piece of ground is laid on a canvas: x right and y up, the same scale along both.
class GroundView {
 public:
  /// Fits [low, high] metres into the box, centred.
  GroundView(Eigen::Vector2d low, Eigen::Vector2d high, Canvas::Point corner, Canvas::Point opposite);

  [[nodiscard]] Canvas::Point at(const Eigen::Vector2d& ground) const {
    return {centre_.x() + (ground.x() - middle_.x()) * scale_, centre_.y() - (ground.y() - middle_.y()) * scale_};
  }
  [[nodiscard]] double pixels(double metres) const { return metres * scale_; }
  [[nodiscard]] Eigen::Vector2d low() const;  ///< of the box [m]
  [[nodiscard]] Eigen::Vector2d high() const;

  /// Lines every 1, 2 or 5 m (times a power of ten), and a bar that says how long one is.
  void grid(Canvas& canvas, Color color = {238, 240, 243}) const;
  void scale_bar(Canvas& canvas) const;

 private:
  Eigen::Vector2d middle_;
  Canvas::Point centre_, corner_, opposite_;
  double scale_ = 1.0;
};

/// The points of an ellipse of `sigmas` standard deviations.
[[nodiscard]] std::vector<Eigen::Vector2d> ellipse(const Eigen::Vector2d& centre, const Eigen::Matrix2d& covariance,
                                                   double sigmas);

/// A robot seen from above.
void draw_robot(Canvas& canvas, const GroundView& view, const geometry::Pose2& pose, double radius_m, Color color);

/// A mark in the colour and the shape of a type: square, diamond, bar, disc; hollow where it is not `filled`.
void draw_mark(Canvas& canvas, Canvas::Point at, perception::PrimitiveType type, double size, bool filled = true);

}  // namespace credo::results
