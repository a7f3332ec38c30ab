// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstddef>
#include <iterator>
#include <optional>
#include <vector>

#include "datasets/dataset.hpp"
#include "sensors/acquisition.hpp"

namespace credo::datasets {

struct AcquisitionParams {
  /// The row of another camera or range finder belongs to an acquisition if it is at most this far from it.
  double nearest_within_s = 0.1;
  /// An odometry row farther than this from both its neighbours was taken at a stop: no robot that drives reports so
  /// rarely, but one that stops for each acquisition does. The path then rests around the row and moves in the middle
  /// half of the interval, so that a scan taken at a stop is not bent by a motion that came later.
  double stop_and_go_from_s = 1.0;
};

/// The acquisition at a time, of the rows of a dataset and an image that is at hand: for readings that never were on
/// disk, and what Acquisitions does for those that are. `dataset.images` is not looked at.
/// \param previous  the time of the acquisition before; nothing for the first
[[nodiscard]] sensors::Acquisition gather(const Dataset& dataset, std::optional<sensors::Timestamp> previous,
                                          sensors::Timestamp time, std::optional<sensors::OmniImage> image,
                                          const AcquisitionParams& params = {});

/// The acquisitions of a dataset, in order of time (docs/dataset-format.md, "Time"):
///
///     for (const sensors::Acquisition& acquisition : Acquisitions(dataset)) ...
///
/// Each sonar sweep, each scan and each odometry row is in exactly one acquisition's lists, or in trailing(). Rows of
/// the acquisition sensor with the same time are one acquisition, that of the last of them.
class Acquisitions {
 public:
  /// \param dataset  must outlive this
  explicit Acquisitions(const Dataset& dataset, const AcquisitionParams& params = {});
  explicit Acquisitions(Dataset&&, const AcquisitionParams& = {}) = delete;

  [[nodiscard]] std::size_t size() const { return times_.size(); }
  /// Of each acquisition. [ns]
  [[nodiscard]] const std::vector<sensors::Timestamp>& times() const { return times_; }

  /// Acquisition `index` in [0, size()); decodes its image. A pure function: any order, any thread.
  /// \throws FormatError if the image cannot be decoded or does not fit the camera.
  [[nodiscard]] sensors::Acquisition read(std::size_t index) const;

  /// The rows after the last acquisition: its `scans`, `sonar`, `odometry` and `path` are filled; `time` is that of the
  /// last row (of the last acquisition where nothing follows it), `motion` leads from the last acquisition to there.
  [[nodiscard]] sensors::Acquisition trailing() const;

  /// Reads one acquisition after the other; single pass.
  class Iterator {
   public:
    using iterator_category = std::input_iterator_tag;
    using value_type = sensors::Acquisition;
    using difference_type = std::ptrdiff_t;
    using pointer = const sensors::Acquisition*;
    using reference = sensors::Acquisition;

    Iterator(const Acquisitions* all, std::size_t index) : all_(all), index_(index) {}
    [[nodiscard]] sensors::Acquisition operator*() const { return all_->read(index_); }
    Iterator& operator++() { return ++index_, *this; }
    Iterator operator++(int) { return {all_, index_++}; }
    friend bool operator==(const Iterator&, const Iterator&) = default;

   private:
    const Acquisitions* all_;
    std::size_t index_;
  };
  [[nodiscard]] Iterator begin() const { return {this, 0}; }
  [[nodiscard]] Iterator end() const { return {this, size()}; }

 private:
  [[nodiscard]] std::optional<sensors::Timestamp> time_before(std::size_t index) const;
  [[nodiscard]] std::optional<sensors::OmniImage> image_of(std::size_t index) const;

  const Dataset* dataset_;
  AcquisitionParams params_;
  std::vector<sensors::Timestamp> times_;
  std::vector<std::size_t> rows_;  ///< of the acquisition sensor, for each acquisition
};

}  // namespace credo::datasets
