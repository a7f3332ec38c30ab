// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/acquisitions.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "datasets/image_file.hpp"

namespace credo::datasets {
namespace {

using sensors::Timestamp;
constexpr Timestamp kEarliest = std::numeric_limits<Timestamp>::min();
constexpr Timestamp kNever = std::numeric_limits<Timestamp>::max();

template <typename Row>
std::vector<Timestamp> times_of(const std::vector<Row>& rows) {
  std::vector<Timestamp> times;
  times.reserve(rows.size());
  for (const Row& row : rows) times.push_back(row.time);
  return times;
}

/// The times of the sensor that defines the acquisitions.
std::vector<Timestamp> acquisition_times(const Dataset& dataset) {
  const std::string& sensor = dataset.header.acquisition_sensor;
  if (sensor == dataset.camera_name) return times_of(dataset.images);
  for (std::size_t i = 0; i < dataset.range_finder_names.size(); ++i)
    if (dataset.range_finder_names[i] == sensor) return times_of(dataset.scans[i]);
  for (std::size_t i = 0; i < dataset.sonar_ring_names.size(); ++i)
    if (dataset.sonar_ring_names[i] == sensor) return times_of(dataset.sonar[i]);
  return {};
}

/// The row nearest to `time`: of equally near ones the earlier, of rows with one time the last. Null where none is near
/// enough.
template <typename Row>
const Row* nearest_row(const std::vector<Row>& rows, Timestamp time, Timestamp within) {
  const auto after =
      std::upper_bound(rows.begin(), rows.end(), time, [](Timestamp t, const Row& row) { return t < row.time; });
  const Row* nearest = nullptr;
  if (after != rows.begin()) nearest = &*(after - 1);
  if (after != rows.end() && (nearest == nullptr || after->time - time < time - nearest->time)) nearest = &*after;
  return nearest != nullptr && std::abs(nearest->time - time) <= within ? nearest : nullptr;
}

/// The rows with previous < time <= last.
template <typename Row>
std::span<const Row> rows_within(const std::vector<Row>& rows, Timestamp previous, Timestamp last) {
  const auto later = [](Timestamp t, const Row& row) { return t < row.time; };
  const auto begin = previous == kEarliest ? rows.begin() : std::upper_bound(rows.begin(), rows.end(), previous, later);
  return {begin, std::upper_bound(begin, rows.end(), last, later)};
}

/// The same of all sensors of a kind, by time; of one time by sensor.
template <typename Row>
std::vector<Row> all_rows_within(const std::vector<std::vector<Row>>& sensors, Timestamp previous, Timestamp last) {
  std::vector<Row> all;
  for (const std::vector<Row>& rows : sensors) {
    const std::span<const Row> within = rows_within(rows, previous, last);
    all.insert(all.end(), within.begin(), within.end());
  }
  std::stable_sort(all.begin(), all.end(), [](const Row& a, const Row& b) { return a.time < b.time; });
  return all;
}

bool all_nan(const std::vector<float>& ranges) {
  return std::all_of(ranges.begin(), ranges.end(), [](float range) { return std::isnan(range); });
}

/// A stretch of time that grows over what is put into it.
struct Stretch {
  Timestamp first = kNever;
  Timestamp last = kEarliest;

  void cover(Timestamp time, double margin_s = 0.0) {
    const Timestamp margin = sensors::from_seconds(std::abs(margin_s));
    first = std::min(first, time - margin);
    last = std::max(last, time + margin);
  }
};

/// From before the first to after the last reading of an acquisition, beams and firings included.
Stretch stretch_of(const sensors::Acquisition& acquisition, const sensors::Rig& rig) {
  Stretch stretch;
  stretch.cover(acquisition.time);
  if (acquisition.image && rig.camera) stretch.cover(acquisition.image->time, 0.5 * rig.camera->exposure_s);
  const auto cover_scan = [&](const sensors::RangeScan& scan) {
    stretch.cover(scan.time, 0.5 * rig.range_finders[static_cast<std::size_t>(scan.sensor)].scan_time_s);
  };
  if (acquisition.scan) cover_scan(*acquisition.scan);
  for (const sensors::RangeScan& scan : acquisition.scans) cover_scan(scan);
  for (const sensors::SonarSweep& sweep : acquisition.sonar) {
    stretch.cover(sweep.time);
    for (const double firing : rig.sonar_rings[static_cast<std::size_t>(sweep.sensor)].firing_times_s)
      stretch.cover(sweep.time + sensors::from_seconds(firing));
  }
  return stretch;
}

/// Appends a row; one that was taken at a stop with the rest around it (AcquisitionParams::stop_and_go_from_s).
void append_row(const std::vector<sensors::OdometryReading>& rows, std::size_t index, double stop_and_go_from_s,
                std::vector<sensors::OdometryReading>& path) {
  constexpr Timestamp kRest = sensors::MotionPath::kLongestExtrapolation;
  const sensors::OdometryReading& row = rows[index];
  const Timestamp from = sensors::from_seconds(stop_and_go_from_s);
  const bool has_previous = index > 0, has_next = index + 1 < rows.size();
  const Timestamp before = has_previous ? row.time - rows[index - 1].time : kNever;
  const Timestamp after = has_next ? rows[index + 1].time - row.time : kNever;
  const bool at_a_stop = rows.size() > 1 && before > from && after > from;
  if (at_a_stop) path.push_back({row.time - (has_previous ? before / 4 : kRest), row.T_odom_base});
  path.push_back(row);
  if (at_a_stop) path.push_back({row.time + (has_next ? after / 4 : kRest), row.T_odom_base});
}

/// The odometry rows from the last one not after the stretch's start to the first one not before its end.
sensors::MotionPath path_over(const std::vector<sensors::OdometryReading>& rows, const Stretch& stretch,
                              double stop_and_go_from_s) {
  const auto earlier = [](const sensors::OdometryReading& row, Timestamp t) { return row.time < t; };
  const auto later = [](Timestamp t, const sensors::OdometryReading& row) { return t < row.time; };
  auto begin = std::upper_bound(rows.begin(), rows.end(), stretch.first, later);
  if (begin != rows.begin()) --begin;
  auto end = std::lower_bound(begin, rows.end(), stretch.last, earlier);
  if (end != rows.end()) ++end;
  // Two rows at least where there are two: a path continues beyond its end with the velocity there.
  if (end - begin < 2 && begin != rows.begin()) --begin;
  if (end - begin < 2 && end != rows.end()) ++end;
  std::vector<sensors::OdometryReading> path;
  for (auto row = begin; row != end; ++row)
    append_row(rows, static_cast<std::size_t>(row - rows.begin()), stop_and_go_from_s, path);
  return sensors::MotionPath(std::move(path));
}

/// Whether odometry says where the robot was at a time, which it does for a moment beyond its ends.
bool knows(const std::vector<sensors::OdometryReading>& rows, Timestamp time) {
  return !rows.empty() && time >= rows.front().time - sensors::MotionPath::kLongestExtrapolation &&
         time <= rows.back().time + sensors::MotionPath::kLongestExtrapolation;
}

/// Fills path and motion. Where odometry has not begun or has died, both stay empty.
void add_motion(const Dataset& dataset, const AcquisitionParams& params, std::optional<Timestamp> previous,
                sensors::Acquisition& acquisition) {
  if (!dataset.header.rig.odometry || !knows(dataset.odometry, acquisition.time) ||
      (previous && !knows(dataset.odometry, *previous)))
    return;
  Stretch stretch = stretch_of(acquisition, dataset.header.rig);
  if (previous) stretch.cover(*previous);
  acquisition.path = path_over(dataset.odometry, stretch, params.stop_and_go_from_s);
  if (previous) acquisition.motion = dataset.header.rig.odometry->along(acquisition.path, *previous, acquisition.time);
}

/// The rows with previous < time <= last in the lists of an acquisition at `last`.
sensors::Acquisition rows_between(const Dataset& dataset, std::optional<Timestamp> previous, Timestamp last) {
  const Timestamp after = previous.value_or(kEarliest);
  sensors::Acquisition acquisition;
  acquisition.scans = all_rows_within(dataset.scans, after, last);
  acquisition.sonar = all_rows_within(dataset.sonar, after, last);
  const auto odometry = rows_within(dataset.odometry, after, last);
  acquisition.odometry.assign(odometry.begin(), odometry.end());
  acquisition.time = last;
  return acquisition;
}

}  // namespace

Acquisitions::Acquisitions(const Dataset& dataset, const AcquisitionParams& params)
    : dataset_(&dataset), params_(params), times_(acquisition_times(dataset)) {
  for (std::size_t row = 0; row < times_.size(); ++row)
    if (row + 1 == times_.size() || times_[row + 1] != times_[row]) rows_.push_back(row);
  times_.erase(std::unique(times_.begin(), times_.end()), times_.end());
}

sensors::Acquisition gather(const Dataset& dataset, std::optional<Timestamp> previous, Timestamp time,
                            std::optional<sensors::OmniImage> image, const AcquisitionParams& params) {
  sensors::Acquisition acquisition = rows_between(dataset, previous, time);
  acquisition.image = std::move(image);
  if (!dataset.scans.empty()) {
    const Timestamp within = sensors::from_seconds(params.nearest_within_s);
    const sensors::RangeScan* scan = nearest_row(dataset.scans.front(), time, within);
    if (scan != nullptr && !all_nan(scan->ranges_m)) acquisition.scan = *scan;
  }
  add_motion(dataset, params, previous, acquisition);
  return acquisition;
}

std::optional<Timestamp> Acquisitions::time_before(std::size_t index) const {
  return index == 0 ? std::nullopt : std::optional(times_[index - 1]);
}

std::optional<sensors::OmniImage> Acquisitions::image_of(std::size_t index) const {
  const bool by_camera = dataset_->header.acquisition_sensor == dataset_->camera_name;
  const ImageFile* image =
      by_camera ? &dataset_->images[rows_[index]]
                : nearest_row(dataset_->images, times_[index], sensors::from_seconds(params_.nearest_within_s));
  if (image == nullptr || image->file.empty()) return std::nullopt;
  const sensors::OmniCamera& camera = *dataset_->header.rig.camera;
  const auto read = [&] { return read_grey_image(image->file, camera.width_px, camera.height_px); };
  return sensors::OmniImage{image->time, with_row(image->listed_in, image->line, read)};
}

sensors::Acquisition Acquisitions::read(std::size_t index) const {
  assert(index < size());
  return gather(*dataset_, time_before(index), times_[index], image_of(index), params_);
}

sensors::Acquisition Acquisitions::trailing() const {
  sensors::Acquisition acquisition = rows_between(*dataset_, time_before(size()), kNever);
  acquisition.time = times_.empty() ? 0 : times_.back();
  for (const auto& scan : acquisition.scans) acquisition.time = std::max(acquisition.time, scan.time);
  for (const auto& sweep : acquisition.sonar) acquisition.time = std::max(acquisition.time, sweep.time);
  for (const auto& row : acquisition.odometry) acquisition.time = std::max(acquisition.time, row.time);
  add_motion(*dataset_, params_, time_before(size()), acquisition);
  return acquisition;
}

}  // namespace credo::datasets
