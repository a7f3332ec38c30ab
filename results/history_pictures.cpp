// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "results/pictures.hpp"
#include "results/plot.hpp"
#include "results/status_colors.hpp"

namespace credo::results {
namespace {

using localization::Status;
using Point = Canvas::Point;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::vector<double> times(std::span<const Moment> history) {
  std::vector<double> result;
  for (const Moment& m : history) {
    result.push_back(sensors::seconds_between(history.front().localization.time, m.localization.time));
  }
  return result;
}

std::vector<Color> statuses(std::span<const Moment> history) {
  std::vector<Color> result;
  for (const Moment& m : history) result.push_back(color_of(m.localization.status));
  return result;
}

/// One component of the error with the band that it should stay in. [m], [deg]
struct ErrorSeries {
  std::vector<double> error, low, high;
  void add(double e, double sigma) {
    error.push_back(e);
    low.push_back(-3.0 * sigma);
    high.push_back(3.0 * sigma);
  }
};

std::array<ErrorSeries, 3> errors(std::span<const Moment> history) {
  std::array<ErrorSeries, 3> series;
  for (const Moment& m : history) {
    const geometry::PoseEstimate& estimate = m.localization.estimate;
    const auto sigma = [&](int i) { return std::sqrt(std::max(0.0, estimate.covariance(i, i))); };
    const geometry::Pose2 truth = m.truth.value_or(geometry::Pose2{kNan, kNan, kNan});
    series[0].add(estimate.pose.x - truth.x, sigma(0));
    series[1].add(estimate.pose.y - truth.y, sigma(1));
    const double heading = m.truth ? geometry::angle_difference(estimate.pose.theta, truth.theta) : kNan;
    series[2].add(geometry::to_degrees(heading), geometry::to_degrees(sigma(2)));
  }
  return series;
}

/// Limits -reach..reach that show the errors and most of the bands, so that one wide band does not flatten all the
/// rest.
double reach_of(const ErrorSeries& s) {
  double largest = 1e-6;
  for (const double e : s.error) {
    if (std::isfinite(e)) largest = std::max(largest, std::abs(e));
  }
  std::vector<double> bands = s.high;
  std::sort(bands.begin(), bands.end());
  const double usual =
      bands.empty() ? 0.0 : bands[static_cast<std::size_t>(0.9 * static_cast<double>(bands.size() - 1))];
  return 1.15 * std::max(largest, usual);
}

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

/// What the band is, and how far it goes where the chart does not show it whole.
std::string band_label(const ErrorSeries& s, double reach, bool degrees) {
  const double widest = s.high.empty() ? 0.0 : *std::max_element(s.high.begin(), s.high.end());
  if (!(widest > reach)) return "+-3 sigma";
  return "+-3 sigma (cut off; up to " + (degrees ? tick_label(widest, 0.1) + " deg" : length_text(widest)) + ")";
}

void status_legend(Canvas& canvas, double y) {
  canvas.text({66.0, y}, "status:", colors::kInk, 8.5);
  legend(canvas, {118.0, y},
         std::vector<LegendEntry>{{color_of(Status::kLocalized), "localized"},
                                  {color_of(Status::kUncertain), "uncertain"},
                                  {color_of(Status::kAmbiguous), "ambiguous"},
                                  {color_of(Status::kLost), "lost"},
                                  {color_of(Status::kInitializing), "initializing"}},
         8.5);
}

/// Rows of the track chart: the longest-lived ones, in the order in which they appear.
std::vector<int> rows_of(std::span<const Moment> history, std::size_t most) {
  std::map<int, int> lifetimes;
  for (const Moment& m : history) {
    for (const TrackSample& t : m.tracks) ++lifetimes[t.id];
  }
  std::vector<std::pair<int, int>> by_lifetime;  // (-lifetime, id)
  for (const auto& [id, lifetime] : lifetimes) by_lifetime.emplace_back(-lifetime, id);
  std::sort(by_lifetime.begin(), by_lifetime.end());
  by_lifetime.resize(std::min(by_lifetime.size(), most));
  std::vector<int> ids;
  for (const auto& [lifetime, id] : by_lifetime) ids.push_back(id);
  std::sort(ids.begin(), ids.end());
  return ids;
}

void draw_tracks(Canvas& canvas, std::span<const Moment> history, Point corner, Point opposite) {
  const std::vector<int> ids = rows_of(history, 60);
  const std::vector<double> t = times(history);
  const double left = corner.x() + 66.0, right = opposite.x() - 16.0, top = corner.y() + 30.0;
  const double row =
      std::min(14.0, (opposite.y() - top - 8.0) / static_cast<double>(std::max<std::size_t>(1, ids.size())));
  const double last_step = t.size() > 1 ? t.back() - t[t.size() - 2] : 1.0;
  const double duration = std::max(1e-9, t.back() + last_step);
  const auto x_of = [&](double time) { return left + time / duration * (right - left); };
  canvas.text({left, corner.y() + 20.0}, "Belief in each track", colors::kInk, 10.0, Anchor::kLeft, 1.25);
  for (std::size_t i = 0; i < history.size(); ++i) {
    const double from = x_of(t[i]), to = x_of(i + 1 < t.size() ? t[i + 1] : duration);
    for (const TrackSample& sample : history[i].tracks) {
      const auto found = std::lower_bound(ids.begin(), ids.end(), sample.id);
      if (found == ids.end() || *found != sample.id) continue;
      const double y = top + row * static_cast<double>(found - ids.begin());
      const bool seen = sample.state == tracking::TrackState::kTracked;
      canvas.box({from, y + (seen ? 1.0 : 0.36 * row)}, {to, y + row - (seen ? 1.0 : 0.36 * row)},
                 color_of(sample.existence));
      const bool first = i == 0 || std::none_of(history[i - 1].tracks.begin(), history[i - 1].tracks.end(),
                                                [&](const TrackSample& other) { return other.id == sample.id; });
      if (first) canvas.box({from - 4.0, y + 1.0}, {from, y + row - 1.0}, color_of(sample.type));
    }
  }
  canvas.frame({left - 5.0, top - 2.0}, {right, top + row * static_cast<double>(ids.size()) + 2.0}, colors::kMuted,
               0.8);
}

}  // namespace

cv::Mat error_picture(std::span<const Moment> history) {
  constexpr int kWidth = 1100, kChart = 230;
  Canvas canvas(kWidth, 3 * kChart + 60);
  const std::vector<double> t = times(history);
  const auto series = errors(history);
  const std::array<const char*, 3> titles{"Error in x", "Error in y", "Error in heading"};
  const bool in_metres = std::max(reach_of(series[0]), reach_of(series[1])) >= 1.0;
  for (int i = 0; i < 3; ++i) {
    const ErrorSeries& s = series[static_cast<std::size_t>(i)];
    const bool degrees = i == 2;
    const double reach = reach_of(s), unit = degrees || in_metres ? 1.0 : 100.0;
    Plot plot(titles[static_cast<std::size_t>(i)], degrees ? "time [s]" : "",
              degrees     ? "[deg]"
              : in_metres ? "[m]"
                          : "[cm]");
    const std::vector<double> error = scaled(s.error, unit);
    plot.band(t, scaled(s.low, unit), scaled(s.high, unit), colors::kSky, band_label(s, reach, degrees), 0.4)
        .level(0.0, colors::kMuted)
        .line(t, error, colors::kBlue, "error")
        .points(t, error, colors::kBlue)
        .y_limits(-unit * reach, unit * reach)
        .strip(t, statuses(history));
    plot.draw(canvas, {0.0, static_cast<double>(i * kChart)}, {kWidth, (i + 1) * kChart + (i == 2 ? 22.0 : 0.0)});
  }
  status_legend(canvas, 3 * kChart + 46.0);
  return canvas.finish();
}

cv::Mat belief_picture(std::span<const Moment> history) {
  constexpr int kWidth = 1100, kChart = 250;
  const double rows = 14.0 * static_cast<double>(rows_of(history, 60).size());
  const double track_height = std::clamp(rows + 44.0, 120.0, 620.0);
  Canvas canvas(kWidth, static_cast<int>(kChart + track_height + 66.0));
  const std::vector<double> t = times(history);
  std::vector<double> zero, yes, plausible, one, conflict;
  for (const Moment& m : history) {
    zero.push_back(0.0);
    yes.push_back(m.localization.belief.yes);
    plausible.push_back(m.localization.belief.yes + m.localization.belief.unknown);
    one.push_back(1.0);
    conflict.push_back(m.localization.conflict);
  }
  const Color yes_color = color_of(evidence::BinaryMass{1, 0, 0}), no_color = color_of(evidence::BinaryMass{0, 1, 0});
  Plot plot("Belief in the localization", "time [s]", "mass");
  plot.band(t, zero, yes, yes_color, "YES", 0.85)
      .band(t, yes, plausible, color_of(evidence::BinaryMass{0, 0, 1}), "unknown", 0.7)
      .band(t, plausible, one, no_color, "NO", 0.85)
      .line(t, conflict, colors::kInk, "conflict met", 1.6)
      .y_limits(0.0, 1.0)
      .strip(t, statuses(history));
  plot.draw(canvas, {0.0, 0.0}, {kWidth, kChart});
  draw_tracks(canvas, history, {0.0, kChart + 4.0}, {kWidth, kChart + track_height});
  const double y = kChart + track_height + 22.0;
  canvas.text({66.0, y}, "tracks: belief", colors::kInk, 8.5);
  const double x =
      legend(canvas, {166.0, y},
             std::vector<LegendEntry>{
                 {yes_color, "YES"}, {color_of(evidence::BinaryMass{0, 0, 1}), "unknown"}, {no_color, "NO"}},
             8.5);
  canvas.text({x, y}, "thin: not seen; starts as", colors::kInk, 8.5);
  legend(canvas, {x + text_width("thin: not seen; starts as", 8.5) + 10.0, y},
         std::vector<LegendEntry>{{color_of(perception::PrimitiveType::kCorner), "corner"},
                                  {color_of(perception::PrimitiveType::kEdge), "edge"},
                                  {color_of(perception::PrimitiveType::kWall), "wall"},
                                  {color_of(perception::PrimitiveType::kOther), "other"}},
         8.5);
  status_legend(canvas, y + 24.0);
  return canvas.finish();
}

}  // namespace credo::results
