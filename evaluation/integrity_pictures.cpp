// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/integrity_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "results/plot.hpp"

namespace credo::evaluation {
namespace {

using results::Canvas;
using results::Color;
using results::Plot;
namespace colors = results::colors;

constexpr double kPanelWidth = 600.0, kPanelHeight = 480.0;

/// Two charts beside each other, and a line of text below.
cv::Mat side_by_side(const Plot& left, const Plot& right, const std::string& note) {
  Canvas canvas(static_cast<int>(2.0 * kPanelWidth), static_cast<int>(kPanelHeight + 30.0));
  left.draw(canvas, {0.0, 0.0}, {kPanelWidth, kPanelHeight});
  right.draw(canvas, {kPanelWidth, 0.0}, {2.0 * kPanelWidth, kPanelHeight});
  canvas.text({66.0, kPanelHeight + 16.0}, note, colors::kMuted, 8.5);
  return canvas.finish();
}

Plot unit_square(const char* title, const char* x_label, const char* y_label) {
  Plot plot(title, x_label, y_label);
  plot.x_limits(-0.02, 1.02).y_limits(-0.02, 1.02);
  return plot;
}

double largest_of(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

std::string with_value(const std::string& name, const std::optional<double>& value) {
  return value ? fmt::format("{} {:.3f}", name, *value) : name;
}

Color color_of(ProtectionRegion region) {
  switch (region) {
    case ProtectionRegion::kNominal: return colors::kGreen;
    case ProtectionRegion::kUnavailable: return colors::kFaint;
    case ProtectionRegion::kMisleading: return colors::kOrange;
    case ProtectionRegion::kHazardous: return colors::kRed;
  }
  return colors::kInk;
}

/// What lies beyond the axes is drawn at their ends.
Plot protection_plot(const ProtectionDiagram& diagram, const char* title, const char* unit, double per_unit) {
  const double limit = diagram.limit * per_unit, reach = 1.4 * limit;
  Plot plot(title, fmt::format("error [{}]", unit), fmt::format("protection level [{}]", unit));
  plot.x_limits(0.0, reach).y_limits(0.0, reach);
  plot.line({0.0, reach}, {0.0, reach}, colors::kMuted, "", 1.0);
  plot.level(limit, colors::kMuted).line({limit, limit}, {0.0, limit}, colors::kMuted, "", 1.0);
  for (const ProtectionRegion region : {ProtectionRegion::kUnavailable, ProtectionRegion::kNominal,
                                        ProtectionRegion::kMisleading, ProtectionRegion::kHazardous}) {
    std::vector<double> errors, levels;
    for (const ProtectionPoint& point : diagram.points) {
      if (point.region != region) continue;
      errors.push_back(std::min(point.error * per_unit, 0.99 * reach));
      levels.push_back(std::min(point.level * per_unit, 0.99 * reach));
    }
    const std::string label = fmt::format("{} {}", to_string(region), errors.size());
    plot.points(std::move(errors), std::move(levels), color_of(region), label, 2.0);
  }
  return plot;
}

/// The share of the events that are answered within so many acquisitions, as stairs.
template <typename Event>
void add_stairs(Plot& plot, const std::vector<Event>& events, std::optional<Response> Event::*response, double until,
                Color color, const std::string& label) {
  if (events.empty()) return;
  std::vector<double> answers, x{0.0}, y{0.0};
  for (const Event& event : events) {
    if (event.*response) answers.push_back((event.*response)->acquisitions);
  }
  std::sort(answers.begin(), answers.end());
  for (const double answer : answers) {
    x.insert(x.end(), 2, answer);
    const double before = y.back();
    y.push_back(before);
    y.push_back(before + 1.0 / static_cast<double>(events.size()));
  }
  x.push_back(until);
  y.push_back(y.back());
  plot.line(std::move(x), std::move(y), color, fmt::format("{} ({})", label, events.size()), 2.0);
}

}  // namespace

cv::Mat detection_picture(const Integrity& integrity) {
  constexpr std::array kColors{colors::kBlue, colors::kOrange, colors::kPurple, colors::kGreen};
  Plot roc =
      unit_square("ROC, and the area under it", "share of the others taken for lost", "share of the lost caught");
  Plot precision = unit_square("Precision, and its mean over recall", "share of the lost caught (recall)",
                               "share of the caught that is lost");
  roc.line({0.0, 1.0}, {0.0, 1.0}, colors::kFaint);
  if (const auto base = integrity.lost.share()) precision.level(*base, colors::kMuted);
  for (std::size_t i = 0; i < integrity.detectors.size(); ++i) {
    const auto& [name, curve] = integrity.detectors[i];
    std::vector<double> recall{0.0}, false_alarms{0.0}, precisions;
    for (const OperatingPoint& point : curve.points) {
      recall.push_back(point.recall);
      false_alarms.push_back(point.false_alarm_share);
      precisions.push_back(point.precision);
    }
    if (!precisions.empty()) precisions.insert(precisions.begin(), precisions.front());
    const Color color = kColors[i % kColors.size()];
    const double thickness = i == 0 ? 2.4 : 1.4;
    if (!curve.points.empty()) {
      roc.line(std::move(false_alarms), recall, color, with_value(name, curve.auroc), thickness);
      precision.line(std::move(recall), std::move(precisions), color, with_value(name, curve.average_precision),
                     thickness);
    }
  }
  return side_by_side(roc, precision,
                      fmt::format("{} of {} poses are lost; dashed: their share, which is the precision of a guess",
                                  integrity.lost.count, integrity.lost.of));
}

cv::Mat calibration_picture(const Integrity& integrity) {
  Plot reliability = unit_square("Reliability of BetP(YES)", "BetP(YES)", "share correct");
  Plot interval("Calibration of [Bel, Pl]", "bin of the grid over (Bel, Pl), by Bel, then Pl", "share correct");
  std::vector<double> p, share, low, high;
  for (const ReliabilityBin& bin : integrity.reliability.bins) {
    p.push_back(bin.probability);
    share.push_back(*bin.came_true.share());
    low.push_back(bin.came_true.interval().lower);
    high.push_back(bin.came_true.interval().upper);
  }
  reliability.line({0.0, 1.0}, {0.0, 1.0}, colors::kFaint, "calibrated")
      .whiskers(p, low, high, colors::kBlue)
      .points(p, share, colors::kBlue, "10 bins of equal count, 95 %", 3.5);
  const std::vector<BeliefBin>& bins = integrity.belief_interval.bins;
  for (std::size_t i = 0; i < bins.size(); ++i) {
    const double x = static_cast<double>(i) + 1.0;
    const Color color = bins[i].agrees() ? colors::kGreen : colors::kRed;
    const Bounds frequency = bins[i].came_true.interval();
    interval.band({x - 0.3, x + 0.3}, {bins[i].belief, bins[i].belief}, {bins[i].plausibility, bins[i].plausibility},
                  colors::kSky, i == 0 ? "[Bel, Pl]" : "", 0.6);
    interval.whiskers({x}, {frequency.lower}, {frequency.upper}, color)
        .points({x}, {*bins[i].came_true.share()}, color, "", 3.5);
  }
  interval.x_limits(0.0, static_cast<double>(bins.size()) + 1.0).y_limits(-0.02, 1.02);
  return side_by_side(reliability, interval,
                      fmt::format("ECE {:.3f}, Brier {:.3f}; whiskers: 95 % of the frequency (Clopper-Pearson); green: "
                                  "it meets [Bel, Pl], red: it does not",
                                  integrity.reliability.calibration_error, integrity.reliability.brier));
}

cv::Mat risk_picture(const Integrity& integrity) {
  std::vector<double> coverage, lost, position, heading;
  for (const RiskPoint& point : integrity.risk) {
    coverage.push_back(point.coverage);
    lost.push_back(100.0 * point.lost);
    position.push_back(100.0 * point.mean_position_m);
    heading.push_back(10.0 * geometry::to_degrees(point.mean_heading_rad));
  }
  Plot risk("Lost among the accepted", "share accepted, best believed first", "lost [%]");
  Plot error("Mean error of the accepted", "share accepted, best believed first", "[cm], [0.1 deg]");
  const auto show_from_zero = [](Plot& plot, double largest) { plot.x_limits(0.0, 1.0).y_limits(0.0, 1.05 * largest); };
  show_from_zero(risk, std::max(1.0, largest_of(lost)));
  show_from_zero(error, std::max({1.0, largest_of(position), largest_of(heading)}));
  risk.line(coverage, lost, colors::kRed, "", 2.0);
  error.line(coverage, position, colors::kBlue, "position [cm]", 2.0)
      .line(coverage, heading, colors::kOrange, "heading [0.1 deg]", 2.0);
  return side_by_side(risk, error, "accepted by BetP(YES); what is equally believed is accepted together");
}

cv::Mat protection_picture(const Integrity& integrity) {
  return side_by_side(
      protection_plot(integrity.position, "Position", "cm", 100.0),
      protection_plot(integrity.heading, "Heading", "deg", geometry::to_degrees(1.0)),
      "right of the diagonal the error is above its level; dashed: the largest level that is available; "
      "what is beyond the axes is drawn at their ends");
}

cv::Mat timing_picture(const Integrity& integrity) {
  constexpr double kUntil = 20.0;  // acquisitions
  Canvas canvas(static_cast<int>(2.0 * kPanelWidth), static_cast<int>(kPanelHeight));
  Plot plot("Answered in time", "acquisitions since it happened", "share answered");
  plot.x_limits(0.0, kUntil).y_limits(0.0, 1.02);
  add_stairs(plot, integrity.episodes, &LostEpisode::alert, kUntil, colors::kBlue, "lost: alert");
  add_stairs(plot, integrity.kidnaps, &Kidnap::alert, kUntil, colors::kOrange, "kidnapped: alert");
  add_stairs(plot, integrity.kidnaps, &Kidnap::recovery, kUntil, colors::kGreen, "kidnapped: recovered");
  plot.draw(canvas, {0.0, 0.0}, {2.0 * kPanelWidth, kPanelHeight});
  return canvas.finish();
}

cv::Mat consistency_picture(std::span<const Consistency> consistencies) {
  constexpr double kWidth = 1100.0, kHeight = 230.0;
  Canvas canvas(static_cast<int>(kWidth), static_cast<int>(kHeight * static_cast<double>(consistencies.size()) + 20.0));
  for (std::size_t k = 0; k < consistencies.size(); ++k) {
    const Consistency& c = consistencies[k];
    const double top = 3.0 * c.bounds.upper;
    std::vector<double> index, anees;
    for (std::size_t i = 0; i < c.indices.size(); ++i) {
      index.push_back(static_cast<double>(c.indices[i]));
      anees.push_back(std::min(c.anees[i], 0.99 * top));
    }
    const bool last = k + 1 == consistencies.size();
    const char* const what = c.dimension == 3 ? "pose" : c.dimension == 2 ? "position" : "heading";
    Plot plot(fmt::format("ANEES of the {} over {} run{}", what, c.runs, c.runs == 1 ? "" : "s"),
              last ? "acquisition" : "", "ANEES");
    plot.band({index.front(), index.back()}, {c.bounds.lower, c.bounds.lower}, {c.bounds.upper, c.bounds.upper},
              colors::kSky, fmt::format("95 % of an honest covariance; {:.0f} % inside", 100.0 * c.share_inside), 0.4)
        .level(c.dimension, colors::kMuted)
        .line(index, anees, colors::kBlue, fmt::format("mean {:.2f}; cut off at {:.0f}", c.mean, top))
        .points(index, anees, colors::kBlue)
        .y_limits(0.0, top);
    const double y = kHeight * static_cast<double>(k);
    plot.draw(canvas, {0.0, y}, {kWidth, y + kHeight + (last ? 20.0 : 0.0)});
  }
  return canvas.finish();
}

}  // namespace credo::evaluation
