// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <sstream>

#include "datasets/format_error.hpp"
#include "datasets/text_file.hpp"
#include "evaluation/campaign_run.hpp"
#include "results/localization_table.hpp"

namespace credo::evaluation {
namespace {

/// The columns after those of localization.csv; two for each class of matches.
const std::vector<std::string>& columns() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list{"true_x [m]",         "true_y [m]",          "true_theta [rad]",
                                  "position_error [m]", "heading_error [rad]", "travelled [m]"};
    for (std::size_t i = 0; i < localization::kFaultClasses; ++i) {
      list.push_back(fault_class_name(i));
      list.push_back("wrong_" + fault_class_name(i));
    }
    list.insert(list.end(), {"degraded", "decidable", "events"});
    return list;
  }();
  return names;
}
constexpr std::string_view kRefused = "# refused: ";

std::string decidable_text(const std::optional<bool>& decidable) { return decidable ? *decidable ? "1" : "0" : ""; }

std::string line_of(const CampaignRow& row) {
  const Sample& sample = row.sample;
  const geometry::Pose2& truth = sample.truth;
  results::ExtendedRow line{
      .row = {sample.localization},
      .more = {fmt::format("{:.6f}", truth.x), fmt::format("{:.6f}", truth.y), fmt::format("{:.9f}", truth.theta),
               fmt::format("{:.6f}", sample.position_m()), fmt::format("{:.9f}", sample.heading_rad()),
               fmt::format("{:.3f}", row.travelled_m)}};
  for (const MatchCounts& counts : row.matches.classes)
    line.more.insert(line.more.end(), {std::to_string(counts.matches), std::to_string(counts.wrong)});
  line.more.insert(line.more.end(), {sample.degraded ? "1" : "0", decidable_text(row.decidable),
                                     fmt::format("{}", fmt::join(row.events, ";"))});
  return results::to_line(line);
}

/// Turns the texts of the columns into numbers.
class ColumnReader {
 public:
  ColumnReader(const std::filesystem::path& file, const results::ExtendedRow& row) : file_(file), row_(row) {}

  template <typename Number = double>
  Number number() {
    const std::string& text = row_.more[next_++];
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(static_cast<double>(value)))
      throw datasets::FormatError(file_, 0,
                                  fmt::format("at {} ns: expected a number in column '{}', found '{}'",
                                              row_.row.localization.time, columns()[next_ - 1], text));
    return value;
  }
  bool flag() { return number<int>() != 0; }
  std::optional<bool> optional_flag() {
    if (!row_.more[next_].empty()) return flag();
    ++next_;
    return std::nullopt;
  }
  std::vector<std::string> words() {
    std::vector<std::string> words;
    std::istringstream text(row_.more[next_++]);
    for (std::string word; std::getline(text, word, ';');) words.push_back(word);
    return words;
  }

 private:
  const std::filesystem::path& file_;
  const results::ExtendedRow& row_;
  std::size_t next_ = 0;
};

CampaignRow row_of(const std::filesystem::path& file, const results::ExtendedRow& extended) {
  ColumnReader read(file, extended);
  CampaignRow row;
  row.sample.localization = extended.row.localization;
  row.sample.truth.x = read.number();
  row.sample.truth.y = read.number();
  row.sample.truth.theta = read.number();
  (void)read.number();  // the errors follow from the poses
  (void)read.number();
  row.travelled_m = read.number();
  for (MatchCounts& counts : row.matches.classes)
    counts = {.matches = read.number<long>(), .wrong = read.number<long>()};
  row.sample.degraded = read.flag();
  row.decidable = read.optional_flag();
  row.events = read.words();
  return row;
}

/// What the file says of why there was no run; empty where there was one.
std::string refusal_in(const std::string& text) {
  const std::size_t at = text.find(kRefused);
  if (at == std::string::npos || (at > 0 && text[at - 1] != '\n')) return "";
  const std::size_t begin = at + kRefused.size();
  return text.substr(begin, text.find('\n', begin) - begin);
}

}  // namespace

void write_run(const std::filesystem::path& file, const CampaignRun& run) {
  std::string text = results::extended_header(columns());
  if (!run.refused.empty()) text.append(kRefused).append(run.refused).append("\n");
  for (const CampaignRow& row : run.rows) text += line_of(row);
  datasets::write_file_whole(file, text);
}

CampaignRun read_run(const std::filesystem::path& file, const RunKey& key) {
  CampaignRun run{.key = key, .rows = {}, .refused = refusal_in(datasets::read_text_file(file))};
  for (const results::ExtendedRow& row : results::read_extended_localization(file, columns()))
    run.rows.push_back(row_of(file, row));
  return run;
}

}  // namespace credo::evaluation
