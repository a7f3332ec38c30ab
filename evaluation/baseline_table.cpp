// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/baseline_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "evaluation/consistency.hpp"

namespace credo::evaluation {
namespace {

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double share_of(const std::vector<bool>& flags) {
  return static_cast<double>(std::ranges::count(flags, true)) / static_cast<double>(flags.size());
}

/// The smallest value that `share` of the values do not exceed.
double quantile(std::vector<double> values, double share) {
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(rank, 1) - 1);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

std::optional<double> auroc_of(const LocalizerRecord& record) {
  std::vector<double> good, bad;
  for (std::size_t i = 0; i < record.lost.size(); ++i) (record.lost[i] ? bad : good).push_back(record.confidence[i]);
  return auroc(good, bad);
}

/// As a field of a table of comma-separated values (RFC 4180).
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char letter : text) result += letter == '"' ? std::string("\"\"") : std::string(1, letter);
  return result + '"';
}

}  // namespace

localization::ProtectionLevels gaussian_protection(const geometry::PoseEstimate& estimate) {
  const double xx = estimate.covariance(0, 0), yy = estimate.covariance(1, 1), xy = estimate.covariance(0, 1);
  const double largest = 0.5 * (xx + yy) + std::hypot(0.5 * (xx - yy), xy);
  const double position = kProtectionFactor * std::sqrt(std::max(0.0, largest));
  const double heading = kProtectionFactor * std::sqrt(std::max(0.0, estimate.covariance(2, 2)));
  return {position, position, heading, heading};
}

LocalizerRecord& LocalizerRecord::operator+=(const LocalizerRecord& other) {
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  append(position_m, other.position_m);
  append(heading_rad, other.heading_rad);
  append(confidence, other.confidence);
  append(nees, other.nees);
  append(lost, other.lost);
  append(available, other.available);
  append(misleading, other.misleading);
  seconds += other.seconds;
  return *this;
}

LocalizerRecord record(std::span<const results::LocalizationRow> rows, std::span<const datasets::TimedPose> truth,
                       double seconds, const ScoreParams& params) {
  LocalizerRecord result;
  result.seconds = seconds;
  for (const results::LocalizationRow& row : rows) {
    const auto pose = truth_at(truth, row.localization.time, params);
    if (!pose) continue;
    const geometry::PoseEstimate& estimate = row.localization.estimate;
    const double position = (estimate.pose.translation() - pose->translation()).norm();
    const double heading = std::abs(geometry::angle_difference(estimate.pose.theta, pose->theta));
    const localization::ProtectionLevels& level = row.localization.protection;
    const bool available = row.localization.status == localization::Status::kLocalized &&
                           level.position_high_m <= params.available_level_m &&
                           level.heading_high_rad <= geometry::to_radians(params.available_level_deg);
    result.position_m.push_back(position);
    result.heading_rad.push_back(heading);
    result.confidence.push_back(row.localization.belief.pignistic());
    result.nees.push_back(nees(estimate, *pose));
    result.lost.push_back(position > params.lost_above_m || heading > geometry::to_radians(params.lost_above_deg));
    result.available.push_back(available);
    result.misleading.push_back(available && (position > level.position_high_m || heading > level.heading_high_rad));
  }
  return result;
}

LocalizerSummary summarise(const LocalizerRecord& record) {
  if (record.position_m.empty()) throw std::invalid_argument("no acquisition has a truth to compare with");
  const std::size_t n = record.position_m.size();
  return {.acquisitions = static_cast<int>(n),
          .mean_position_m = mean_of(record.position_m),
          .p95_position_m = quantile(record.position_m, 0.95),
          .mean_heading_rad = mean_of(record.heading_rad),
          .lost = share_of(record.lost),
          .available = share_of(record.available),
          .misleading = share_of(record.misleading),
          .mean_nees = mean_of(record.nees),
          .lost_count = static_cast<int>(std::ranges::count(record.lost, true)),
          .auroc = auroc_of(record),
          .ms_per_update = 1e3 * record.seconds / static_cast<double>(n)};
}

std::string to_text(std::span<const LocalizerLine> lines) {
  std::string text = fmt::format("  {:<24} {:>8} {:>8} {:>8} {:>6} {:>9} {:>10} {:>8} {:>6} {:>7}\n", "", "mean",
                                 "95 %", "heading", "lost", "available", "misleading", "NEES", "AUROC", "ms");
  for (const LocalizerLine& line : lines) {
    if (!line.summary) {
      text += fmt::format("  {:<24} not run: {}\n", line.name, line.note);
      continue;
    }
    const LocalizerSummary& s = *line.summary;
    text += fmt::format(
        "  {:<24} {:>5.2f} cm {:>5.2f} cm {:>4.2f} deg {:>4.1f} % {:>7.1f} % {:>8.1f} % {:>8.2f} {:>6} {:>7.2f}{}\n",
        line.name, 100.0 * s.mean_position_m, 100.0 * s.p95_position_m, geometry::to_degrees(s.mean_heading_rad),
        100.0 * s.lost, 100.0 * s.available, 100.0 * s.misleading, s.mean_nees,
        s.auroc ? fmt::format("{:.3f}", *s.auroc) : "-", s.ms_per_update, line.note.empty() ? "" : "  " + line.note);
  }
  return text;
}

std::string localizer_table_terms(const ScoreParams& p) {
  return fmt::format(
      "mean, 95 %, heading: error of position and mean error of heading at the acquisition's time, not aligned\n"
      "lost: error > {} m or > {} deg\n"
      "available: status localized (a baseline has no other) and protection level <= {} m and {} deg; Credo's level\n"
      "  is its integrity monitor's, a baseline's {} standard deviations (1e-5, two-sided normal) of its own\n"
      "  covariance: position along the longest axis, and heading\n"
      "misleading: available, yet the error is above the protection level\n"
      "NEES: mean over the acquisitions, correlated in time; 3 expected\n"
      "AUROC: of each localizer's own confidence against lost; '-' unless some are lost and some not;\n"
      "  over fewer than 200 lost acquisitions an indication, no more\n"
      "ms: of one update on a scene that is there already\n",
      p.lost_above_m, p.lost_above_deg, p.available_level_m, p.available_level_deg, kProtectionFactor);
}

std::string localizer_csv_header() {
  return "dataset,localizer,acquisitions,mean_position_m,p95_position_m,mean_heading_rad,lost,available,misleading,"
         "mean_nees,lost_count,auroc,ms_per_update,note\n";
}

std::string to_csv(const std::string& dataset, std::span<const LocalizerLine> lines) {
  std::string text;
  for (const LocalizerLine& line : lines) {
    text += fmt::format("{},{},", quoted(dataset), quoted(line.name));
    if (line.summary) {
      const LocalizerSummary& s = *line.summary;
      text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},", s.acquisitions, s.mean_position_m, s.p95_position_m,
                          s.mean_heading_rad, s.lost, s.available, s.misleading, s.mean_nees, s.lost_count,
                          s.auroc ? fmt::format("{}", *s.auroc) : "", s.ms_per_update);
    } else {
      text += ",,,,,,,,,,,";
    }
    text += quoted(line.note) + '\n';
  }
  return text;
}

}  // namespace credo::evaluation
