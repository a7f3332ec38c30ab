// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <filesystem>
#include <memory>

#include "datasets/dataset.hpp"

namespace credo::datasets {

struct WriterParams {
  bool overwrite = false;   ///< replace a dataset that is already there; anything else is never replaced
  int png_compression = 1;  ///< 0 (none) .. 9 (smallest, slow)
};

/// Writes a dataset row by row (docs/dataset-format.md). Everything goes into a temporary folder beside the target,
/// which takes the target's name when finish() has written the last byte; without finish() the destructor removes it,
/// so that nothing half-written is ever found. Ranges are written with 4 decimals [m], poses with 6, 9 for angles.
class DatasetWriter {
 public:
  /// \param header  an empty `acquisition_sensor` is written as the default; a sensor's folder is made for each of the
  /// rig \throws std::runtime_error if the target is there and may not be replaced, or the folder cannot be made
  /// \throws std::invalid_argument if the header would not be accepted when read (zero beams, an empty floor plan, ...)
  DatasetWriter(const std::filesystem::path& target, const DatasetHeader& header, const WriterParams& params = {});
  ~DatasetWriter();
  DatasetWriter(DatasetWriter&&) noexcept;
  DatasetWriter& operator=(DatasetWriter&&) noexcept;

  // Times of one sensor must not decrease; std::invalid_argument where they do, where the number of readings or the
  // size of an image does not fit the rig, or where a pose is not finite; std::runtime_error where the disk is full.
  void add_image(sensors::Timestamp time, const cv::Mat& pixels);  ///< CV_8UC1 or CV_8UC3 (BGR); empty = no measurement
  void add_scan(const sensors::RangeScan& scan);
  void add_sonar(const sensors::SonarSweep& sweep);
  void add_odometry(const sensors::OdometryReading& reading);
  void add_truth(const TimedPose& T_map_base);
  void add_true_vertical(const TrueVertical& vertical);
  void add_event(const Event& event);
  /// Says that every event will be added, so that the dataset has an events.csv even if none comes.
  void record_events();

  /// Where a file that belongs to the dataset but has no writer here (truth_map.yaml, SOURCE.txt) is to be put before
  /// finish().
  [[nodiscard]] const std::filesystem::path& working_folder() const;

  /// Closes everything and puts the dataset in its place. Nothing may be added afterwards.
  /// \throws std::runtime_error if a file could not be written whole or the target came to be in the meantime
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace credo::datasets
