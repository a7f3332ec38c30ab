// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "results/experiment_pictures.hpp"

#include <algorithm>
#include <limits>

#include "results/ground_view.hpp"
#include "results/plot.hpp"

namespace credo::results {
namespace {

constexpr Color kPlanColor{150, 154, 162};

void draw_plus(Canvas& canvas, Canvas::Point at, Color color) {
  constexpr double kArm = 5.0;
  canvas.line(at - Canvas::Point(kArm, 0.0), at + Canvas::Point(kArm, 0.0), color, 1.6);
  canvas.line(at - Canvas::Point(0.0, kArm), at + Canvas::Point(0.0, kArm), color, 1.6);
}

void draw_cross(Canvas& canvas, Canvas::Point at, Color color) {
  constexpr double kArm = 4.0;
  canvas.line(at - Canvas::Point(kArm, kArm), at + Canvas::Point(kArm, kArm), color, 1.4);
  canvas.line(at - Canvas::Point(kArm, -kArm), at + Canvas::Point(kArm, -kArm), color, 1.4);
}

/// What the picture has to show: plan and positions.
GroundView view_of(const geometry::FloorPlan& plan, std::span<const NamedDrive> drives, Canvas::Point opposite) {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  const auto include = [&](const Eigen::Vector2d& point) { low = low.cwiseMin(point), high = high.cwiseMax(point); };
  for (const geometry::Segment& wall : plan.walls) include(wall.a), include(wall.b);
  for (const NamedDrive& drive : drives)
    for (const Moment& moment : drive.history) include(moment.localization.estimate.pose.translation());
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(0.3);
  return {low - margin, high + margin, {0.0, 0.0}, opposite};
}

std::vector<double> numbers_from(int first, std::size_t count) {
  std::vector<double> numbers(count);
  for (std::size_t i = 0; i < count; ++i) numbers[i] = first + static_cast<double>(i);
  return numbers;
}

}  // namespace

cv::Mat positions_picture(const geometry::FloorPlan& plan, std::span<const NamedDrive> drives) {
  constexpr int kWidth = 1100, kHeight = 460, kFoot = 30;
  Canvas canvas(kWidth, kHeight + kFoot);
  const GroundView ground = view_of(plan, drives, {kWidth, kHeight});
  canvas.clip({0.0, 0.0}, {kWidth, kHeight});
  ground.grid(canvas);
  for (const geometry::Segment& wall : plan.walls) canvas.line(ground.at(wall.a), ground.at(wall.b), kPlanColor, 2.4);
  for (const Eigen::Vector2d& mark : plan.verticals) canvas.disc(ground.at(mark), 2.0, kPlanColor);
  std::vector<LegendEntry> entries{{colors::kMuted, "+ true position, x computed:"}};
  for (const NamedDrive& drive : drives) {
    entries.push_back({drive.color, drive.name});
    for (const Moment& moment : drive.history) {
      if (moment.truth) draw_plus(canvas, ground.at(moment.truth->translation()), colors::kMuted);
      draw_cross(canvas, ground.at(moment.localization.estimate.pose.translation()), drive.color);
    }
  }
  ground.scale_bar(canvas);
  canvas.clip();
  legend(canvas, {14.0, kHeight + 20.0}, entries, 8.5);
  return canvas.finish();
}

cv::Mat beliefs_picture(std::span<const NamedDrive> drives) {
  constexpr int kWidth = 1100, kHeight = 320;
  Canvas canvas(kWidth, kHeight);
  Plot plot("Belief in the localization", "acquisition", "m_l(YES)");
  for (const NamedDrive& drive : drives) {
    std::vector<double> beliefs;
    for (const Moment& moment : drive.history) beliefs.push_back(moment.localization.belief.yes);
    const std::vector<double> numbers = numbers_from(1, beliefs.size());
    plot.line(numbers, beliefs, drive.color, drive.name).points(numbers, beliefs, drive.color);
  }
  plot.y_limits(0.0, 1.0).draw(canvas, {0.0, 0.0}, {kWidth, kHeight});
  return canvas.finish();
}

cv::Mat track_life_picture(const std::string& title, std::span<const TrackSample> samples, int first, bool lost) {
  constexpr int kWidth = 900, kHeight = 320, kFoot = 26;
  Canvas canvas(kWidth, kHeight + kFoot);
  std::vector<double> yes, no, unknown;
  std::vector<Color> strip;
  for (const TrackSample& sample : samples) {
    yes.push_back(sample.existence.yes);
    no.push_back(sample.existence.no);
    unknown.push_back(sample.existence.unknown);
    const bool seen = sample.state == tracking::TrackState::kTracked;
    strip.push_back(seen ? color_of(sample.type) : colors::kFaint);
  }
  const std::vector<double> numbers = numbers_from(first, samples.size());
  Plot plot(title, "acquisition", "mass");
  plot.line(numbers, yes, colors::kGreen, "YES")
      .points(numbers, yes, colors::kGreen)
      .line(numbers, no, colors::kRed, "NO")
      .points(numbers, no, colors::kRed)
      .line(numbers, unknown, colors::kMuted, "unknown")
      .y_limits(0.0, 1.0)
      .strip(numbers, strip);
  if (lost) plot.points({numbers.back()}, {no.back()}, colors::kRed, "lost", 6.0);
  plot.draw(canvas, {0.0, 0.0}, {kWidth, kHeight});
  using perception::PrimitiveType;
  legend(canvas, {66.0, kHeight + 16.0},
         std::vector<LegendEntry>{{color_of(PrimitiveType::kEdge), "seen as an edge"},
                                  {color_of(PrimitiveType::kCorner), "corner"},
                                  {color_of(PrimitiveType::kWall), "wall"},
                                  {color_of(PrimitiveType::kOther), "other"},
                                  {colors::kFaint, "not seen"}},
         8.5);
  return canvas.finish();
}

}  // namespace credo::results
