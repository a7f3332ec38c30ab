// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/campaign_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "evaluation/campaign_measures.hpp"
#include "results/canvas.hpp"
#include "results/plot.hpp"

namespace credo::evaluation {
namespace {

using localization::Status;
using results::Canvas;
using results::Color;
namespace colors = results::colors;

// One row for each degradation, its name on the left.
constexpr double kNames_px = 130.0, kRow_px = 24.0, kTop_px = 64.0, kFoot_px = 30.0, kMargin_px = 24.0;

struct RowsLayout {
  std::vector<std::string> names;

  [[nodiscard]] int height() const {
    return static_cast<int>(kTop_px + kRow_px * static_cast<double>(names.size()) + kFoot_px);
  }
  [[nodiscard]] double middle(std::size_t row) const { return kTop_px + kRow_px * (static_cast<double>(row) + 0.5); }
  [[nodiscard]] double foot() const { return kTop_px + kRow_px * static_cast<double>(names.size()); }

  void draw_names(Canvas& canvas, const char* title) const {
    canvas.text({kMargin_px, 26}, title, colors::kInk, 11.0, results::Anchor::kLeft, 1.4);
    for (std::size_t i = 0; i < names.size(); ++i)
      canvas.text({kNames_px - 8, middle(i) + 4}, names[i], colors::kInk, 8.5, results::Anchor::kRight);
  }
};

/// The rows of one degradation that pass.
template <typename Passes>
std::vector<const CampaignRow*> rows_of(std::span<const CampaignRun> runs, const std::string& degradation,
                                        const Passes& passes) {
  std::vector<const CampaignRow*> rows;
  for (const CampaignRun& run : runs)
    if (run.key.degradation == degradation)
      for (const CampaignRow& row : run.rows)
        if (passes(row)) rows.push_back(&row);
  return rows;
}

/// An axis of powers of ten in a box of the picture.
struct LogAxis {
  double left_px, right_px;
  int low, high;  ///< powers of ten at the ends

  [[nodiscard]] double at(double value) const {
    const double power =
        std::clamp(std::log10(std::max(value, 1e-12)), static_cast<double>(low), static_cast<double>(high));
    return left_px + (right_px - left_px) * (power - low) / (high - low);
  }
  void draw(Canvas& canvas, const RowsLayout& layout, const char* title, double unit) const {
    canvas.text({0.5 * (left_px + right_px), kTop_px - 8}, title, colors::kMuted, 8.5, results::Anchor::kCentre);
    for (int power = low; power <= high; ++power) {
      const double x = at(std::pow(10.0, power));
      canvas.line({x, kTop_px}, {x, layout.foot()}, colors::kFaint);
      canvas.text({x, layout.foot() + 16}, fmt::format("{:g}", unit * std::pow(10.0, power)), colors::kMuted, 8.0,
                  results::Anchor::kCentre);
    }
  }
};

/// Whiskers from 5 to 95 %, a box of the quartiles, the median and the largest. Values are sorted here.
void draw_distribution(Canvas& canvas, std::vector<double> values, double y, const LogAxis& axis) {
  if (values.empty()) return;
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    return axis.at(values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)]);
  };
  canvas.line({at(0.05), y}, {at(0.95), y}, colors::kBlue, 1.5);
  canvas.box({at(0.25), y - 5}, {at(0.75), y + 5}, colors::kSky);
  canvas.line({at(0.5), y - 7}, {at(0.5), y + 7}, colors::kBlue, 2.5);
  canvas.disc({at(1.0), y}, 2.5, colors::kRed);
}

/// Kinds of acquisitions, from the best to the worst.
struct Kind {
  const char* name;
  Color color;
};
constexpr std::array kKinds{Kind{"available", colors::kGreen},
                            Kind{"misleading", colors::kRed},
                            Kind{"localized, protection level too large", colors::kYellow},
                            Kind{"uncertain", colors::kOrange},
                            Kind{"ambiguous", colors::kPurple},
                            Kind{"lost", colors::kInk},
                            Kind{"initializing", colors::kFaint}};

std::size_t kind_of(const Sample& sample, const ScoreParams& words) {
  if (is_misleading(sample, words)) return 1;
  if (is_available(sample, words)) return 0;
  switch (sample.localization.status) {
    case Status::kLocalized: return 2;
    case Status::kUncertain: return 3;
    case Status::kAmbiguous: return 4;
    case Status::kLost: return 5;
    case Status::kInitializing: break;
  }
  return 6;
}

}  // namespace

cv::Mat error_picture(const CampaignSpec& spec, std::span<const CampaignRun> runs) {
  const RowsLayout layout{spec.degradations};
  Canvas canvas(920, layout.height());
  layout.draw_names(canvas, "Errors by degradation: median, quartiles, 5 to 95 %, largest (not aligned)");
  const LogAxis position{kNames_px + 8, 510, -3, 1}, heading{550, 896, -3, 2};
  position.draw(canvas, layout, "position [cm]", 100.0);
  heading.draw(canvas, layout, "heading [deg]", 1.0);
  for (std::size_t i = 0; i < layout.names.size(); ++i) {
    std::vector<double> positions, headings;
    for (const CampaignRow* row :
         rows_of(runs, layout.names[i], [](const CampaignRow& r) { return r.sample.placed(); })) {
      positions.push_back(row->sample.position_m());
      headings.push_back(geometry::to_degrees(row->sample.heading_rad()));
    }
    draw_distribution(canvas, std::move(positions), layout.middle(i), position);
    draw_distribution(canvas, std::move(headings), layout.middle(i), heading);
  }
  return canvas.finish();
}

cv::Mat availability_picture(const CampaignSpec& spec, std::span<const CampaignRun> runs, const ScoreParams& words) {
  const RowsLayout layout{spec.degradations};
  Canvas canvas(920, layout.height());
  layout.draw_names(canvas, "What the acquisitions of each degradation were");
  std::vector<results::LegendEntry> entries;
  for (const Kind& kind : kKinds) entries.push_back({kind.color, kind.name});
  results::legend(canvas, {kNames_px, kTop_px - 10}, entries);
  constexpr double kWidth_px = 620.0;
  for (std::size_t i = 0; i < layout.names.size(); ++i) {
    std::array<std::size_t, kKinds.size()> counts{};
    const auto rows = rows_of(runs, layout.names[i], [](const CampaignRow&) { return true; });
    for (const CampaignRow* row : rows) ++counts[kind_of(row->sample, words)];
    if (rows.empty()) continue;
    double x = kNames_px;
    for (std::size_t k = 0; k < kKinds.size(); ++k) {
      const double wide = kWidth_px * static_cast<double>(counts[k]) / static_cast<double>(rows.size());
      // However few they are, misleading ones are seen.
      if (counts[k] > 0)
        canvas.box({x, layout.middle(i) - 8}, {x + std::max(wide, k == 1 ? 2.0 : 0.0), layout.middle(i) + 8},
                   kKinds[k].color);
      x += wide;
    }
    const double available = static_cast<double>(counts[0] + counts[1]) / static_cast<double>(rows.size());
    canvas.text({kNames_px + kWidth_px + 10, layout.middle(i) + 4},
                fmt::format("{:.1f} %, {} misleading", 100.0 * available, counts[1]), colors::kInk, 8.0);
  }
  return canvas.finish();
}

cv::Mat protection_picture(std::span<const CampaignRun> runs, const ScoreParams& words) {
  constexpr double kFurthest_m = 1.0;
  enum { kAlert, kLocalized, kMisleading, kGroups };
  std::array<std::vector<double>, kGroups> errors, levels;
  for (const CampaignRun& run : runs)
    for (const CampaignRow& row : run.rows) {
      const double level = row.sample.localization.protection.position_high_m;
      if (!row.sample.placed() || std::isnan(level)) continue;
      const std::size_t group = is_misleading(row.sample, words) ? kMisleading
                                : is_alert(row.sample)           ? kAlert
                                                                 : kLocalized;
      errors[group].push_back(std::min(row.sample.position_m(), kFurthest_m));
      levels[group].push_back(std::min(level, kFurthest_m));
    }
  results::Plot plot("", "position error [m]", "upper protection level [m]");
  plot.line({0.0, kFurthest_m}, {0.0, kFurthest_m}, colors::kInk, "error = protection level");
  plot.level(words.available_level_m, colors::kOrange, "alert limit");
  plot.points(errors[kAlert], levels[kAlert], colors::kMuted, "alert", 1.5);
  plot.points(errors[kLocalized], levels[kLocalized], colors::kBlue, "localized", 1.5);
  plot.points(errors[kMisleading], levels[kMisleading], colors::kRed, "misleading", 2.5);
  plot.y_limits(0.0, kFurthest_m);
  Canvas canvas(760, 620);
  plot.draw(canvas, {10, 10}, {750, 610});
  return canvas.finish();
}

}  // namespace credo::evaluation
