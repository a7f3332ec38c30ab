// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/laser_calibration.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "evaluation/map_score.hpp"
#include "evidence/parameter_check.hpp"
#include "mapping/mapper.hpp"
#include "mapping/scan_painter.hpp"
#include "mapping/simple_mass.hpp"

namespace credo::evaluation {

using mapping::CalibratedLaserParams;

namespace {

using mapping::LaserKnots;
using mapping::NoiseLength;
using TrueState = TrueCells::State;

// What is tried: [m], and sigmas.
constexpr std::array<NoiseLength, 12> kMargins{{{0.025, 0.5},
                                                {0.025, 1.0},
                                                {0.025, 1.5},
                                                {0.025, 2.0},
                                                {0.0375, 0.5},
                                                {0.0375, 1.0},
                                                {0.0375, 1.5},
                                                {0.0375, 2.0},
                                                {0.05, 0.5},
                                                {0.05, 1.0},
                                                {0.05, 1.5},
                                                {0.05, 2.0}}};
constexpr std::array<NoiseLength, 12> kHalfWidths{{{0.0125, 0.0},
                                                   {0.0125, 0.5},
                                                   {0.0125, 1.0},
                                                   {0.025, 0.0},
                                                   {0.025, 0.5},
                                                   {0.025, 1.0},
                                                   {0.0375, 0.0},
                                                   {0.0375, 0.5},
                                                   {0.0375, 1.0},
                                                   {0.05, 0.0},
                                                   {0.05, 0.5},
                                                   {0.05, 1.0}}};
constexpr std::size_t kFirstMargin = kMargins.size() / 2;
constexpr std::size_t kFreeWeight = LaserKnots::kCount;  // comes after those of the hits
constexpr std::size_t kAllHits = kFreeWeight + 1;        // to be seen by any
constexpr double kProbed = 0.02;                         // a weight so small that its shares add up

/// Says one thing alone: that space is free, or what one weight of a hit says.
struct Probe {
  NoiseLength free_until, half;
  std::size_t weight;

  [[nodiscard]] evidence::GridMass free_mass() const {
    return mapping::simple_mass(weight == kFreeWeight ? -kProbed : 0.0);
  }
  [[nodiscard]] evidence::GridMass hit_mass() const {
    return mapping::simple_mass(weight == kFreeWeight ? 0.0 : kProbed);
  }
  [[nodiscard]] double free_margin(double reading_m, const sensors::RangeNoise& noise) const {
    return free_until.of(noise.sigma(reading_m));
  }
  [[nodiscard]] double half_width(double reading_m, const sensors::RangeNoise& noise) const {
    return half.of(noise.sigma(reading_m));
  }
  [[nodiscard]] double hit_share(double reading_m, const sensors::RangeNoise& noise) const {
    if (weight == kAllHits) return 1.0;
    double result = 0.0;
    mapping::for_each_hit_weight(noise.sigma(reading_m), reading_m,
                                 [&](std::size_t i, double share) { result += i == weight ? share : 0.0; });
    return result;
  }
  [[nodiscard]] double reliability() const { return mapping::kFullTrust; }
};
static_assert(mapping::LaserModel<Probe>);

/// The scans of a drive, and how much of each is new.
struct Scans {
  const sensors::MotionPath& T_map_base;
  const sensors::RangeFinder& finder;
  std::span<const sensors::RangeScan> scans;
  std::vector<double> shares;
  grids::Georeference georeference;

  /// Adds what a probe says to a grid. \returns what once counts; 0: the probe says nothing
  double paint(const Probe& probe, grids::EvidentialGrid& grid) const {
    const mapping::ScanParams params;
    mapping::LaserTables tables = mapping::laser_tables(probe, finder, params);
    if (probe.weight != kFreeWeight && std::ranges::max(tables.hit_share) == 0.0F) return 0.0;
    const double once = -(probe.weight == kFreeWeight ? tables.free : tables.hit).back().value().unknown;
    mapping::ScanPainter painter(finder, georeference, std::move(tables), params);
    mapping::PendingRegions pending;
    for (std::size_t i = 0; i < scans.size(); ++i) {
      if (!mapping::covers(T_map_base, scans[i].time, mapping::TrajectoryMappingParams{}.max_gap_s)) continue;
      const geometry::Pose2 pose = T_map_base.pose_at(scans[i].time);
      const mapping::PoseReliability trust({{pose, Eigen::Matrix3d::Zero()}, {.yes = 1.0, .no = 0.0, .unknown = 0.0}},
                                           georeference.resolution_m, {}, shares[i]);
      painter.paint(grid, pending, pose, trust, scans[i].ranges_m, T_map_base, scans[i].time);
    }
    pending.settle(grid);
    return once;
  }

  /// Calls take(place of the cell, how often) for each cell that a probe speaks of.
  template <typename Take>
  void count(const Probe& probe, std::span<const LaserCalibration::Cell> cells, const Take& take) const {
    grids::EvidentialGrid grid(georeference);
    const double once = paint(probe, grid);
    if (once == 0.0) return;
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (const double said = -grid.at(cells[i].at).value().unknown; said > 0.0) take(i, said / once);
  }

  /// All cells that any probe speaks of.
  [[nodiscard]] grids::EvidentialGrid seen() const {
    grids::EvidentialGrid grid(georeference);
    paint({kMargins.front(), kHalfWidths.front(), kFreeWeight}, grid);
    paint({kMargins.back(), kHalfWidths.back(), kAllHits}, grid);
    return grid;
  }
};

/// The cells of a true map that were seen and can be learned from.
std::vector<LaserCalibration::Cell> cells_of(const TrueCells& truth, const grids::EvidentialGrid& seen,
                                             int empty_stride) {
  std::vector<LaserCalibration::Cell> cells;
  int far_from_walls = 0;
  const grids::CellBox& box = truth.box();
  for (int y = box.min.y; y < box.min.y + box.height; ++y)
    for (int x = box.min.x; x < box.min.x + box.width; ++x) {
      if (seen.at({x, y}) == evidence::FixedLogCommonality{}) continue;
      const TrueState state = truth.at({x, y});
      const bool occupied = state == TrueState::kOccupied;
      const bool near = truth.near({x, y}, occupied ? TrueState::kEmpty : TrueState::kOccupied, kWallTolerance);
      if (state == TrueState::kUnknown || (occupied && !near)) continue;
      if (!near && far_from_walls++ % empty_stride != 0) continue;
      cells.push_back({.at = {x, y},
                       .occupied = occupied,
                       .near = near,
                       .count = near ? 1.0 : static_cast<double>(empty_stride),
                       .free = std::vector<float>(kMargins.size(), 0.0F),
                       .hit = std::vector<std::vector<LogisticRegression::Entry>>(kHalfWidths.size())});
    }
  return cells;
}

mapping::LaserWeights laser_weights(const LogisticRegression::Fit& fit) {
  return {.free_weight = std::max(0.0, -fit.weights[kFreeWeight]),
          .hit_weights = {fit.weights.begin(), fit.weights.begin() + LaserKnots::kCount}};
}

/// Drawn to what all hits have in common, so that a weight that the drives tell little of is no other than that.
LogisticRegression::Fit fit_drawn_together(const LogisticRegression& regression) {
  std::vector<std::uint32_t> pools(LaserKnots::kCount + 1, 0);
  pools[kFreeWeight] = 1;
  const LogisticRegression::Fit common = regression.pooled(pools).fit();
  std::vector<double> towards(LaserKnots::kCount + 1, common.weights[0]);
  towards[kFreeWeight] = common.weights[1];
  return regression.fit(towards);
}

}  // namespace

LaserCalibration::LaserCalibration(const LaserCalibrationParams& params) : params_(params) {
  const evidence::ParameterCheck check("laser calibration: ");
  check.positive("resolution_m", params.resolution_m);
  check.at_least("empty_stride", params.empty_stride, 1);
  check.at_least("alone_stride", params.alone_stride, 1);
  static_cast<void>(LogisticRegression(1, params.regression));  // checks its own
}

void LaserCalibration::add(const sensors::MotionPath& T_map_base, const sensors::RangeFinder& finder,
                           std::span<const sensors::RangeScan> scans, const datasets::OccupancyMap& truth,
                           const CalibrationProgress& progress) {
  const grids::Georeference georeference{.resolution_m = params_.resolution_m};
  const TrueCells true_cells(truth, georeference, box_of(truth, georeference));
  const Scans drive{T_map_base, finder, scans, mapping::new_shares(T_map_base, scans, {}), georeference};
  std::vector<Cell> cells = cells_of(true_cells, drive.seen(), params_.empty_stride);
  constexpr double kProbes = kMargins.size() + kHalfWidths.size() * LaserKnots::kCount;
  int probed = 0;
  const auto count = [&](const Probe& probe, const auto& take) {
    drive.count(probe, cells, take);
    if (progress) progress(++probed / kProbes);
  };
  for (std::size_t k = 0; k < kMargins.size(); ++k)
    count({kMargins[k], kHalfWidths.front(), kFreeWeight},
          [&](std::size_t i, double times) { cells[i].free[k] = static_cast<float>(times); });
  for (std::size_t k = 0; k < kHalfWidths.size(); ++k)
    for (std::size_t weight = 0; weight < LaserKnots::kCount; ++weight)
      count({kMargins.back(), kHalfWidths[k], weight}, [&](std::size_t i, double times) {
        cells[i].hit[k].push_back({static_cast<std::uint32_t>(weight), static_cast<float>(times)});
      });
  SingleScans single{.T_map_base = T_map_base,
                     .finder = finder,
                     .scans = {},
                     .first_cell = cells_.size(),
                     .last_cell = cells_.size() + cells.size()};
  const auto stride = static_cast<std::size_t>(params_.alone_stride);
  for (std::size_t i = 0; i < scans.size(); i += stride) single.scans.push_back(scans[i]);
  single_scans_.push_back(std::move(single));
  cells_.insert(cells_.end(), std::make_move_iterator(cells.begin()), std::make_move_iterator(cells.end()));
}

LogisticRegression::Fit LaserCalibration::fit_with(std::size_t margin, std::size_t half_width) const {
  LogisticRegression regression(LaserKnots::kCount + 1, params_.regression);
  std::vector<LogisticRegression::Entry> entries;
  for (const Cell& cell : cells_) {
    entries = cell.hit[half_width];
    if (cell.free[margin] > 0.0F) entries.push_back({static_cast<std::uint32_t>(kFreeWeight), cell.free[margin]});
    regression.add(entries, cell.occupied, cell.count);
  }
  return fit_drawn_together(regression);
}

/// A row is what one scan says of one cell beside a wall's face. Of all cells in a scan nearly all are empty, which one
/// would find in the weights, as the regression has no constant; there, about as many are occupied.
LogisticRegression::Fit LaserCalibration::fit_alone(std::size_t margin, std::size_t half_width,
                                                    const CalibrationProgress& progress) const {
  LogisticRegression regression(LaserKnots::kCount + 1, params_.regression);
  std::size_t drives = 0;
  std::vector<std::vector<LogisticRegression::Entry>> rows;
  for (const SingleScans& drive : single_scans_) {
    const auto cells = std::span(cells_).subspan(drive.first_cell, drive.last_cell - drive.first_cell);
    for (const sensors::RangeScan& scan : drive.scans) {
      rows.assign(cells.size(), {});
      const Scans one{drive.T_map_base, drive.finder, {&scan, 1}, {1.0}, {.resolution_m = params_.resolution_m}};
      for (std::size_t weight = 0; weight <= LaserKnots::kCount; ++weight)
        one.count({kMargins[margin], kHalfWidths[half_width], weight}, cells, [&](std::size_t i, double times) {
          rows[i].push_back({static_cast<std::uint32_t>(weight), static_cast<float>(times)});
        });
      for (std::size_t i = 0; i < cells.size(); ++i)
        if (cells[i].near && !rows[i].empty()) regression.add(rows[i], cells[i].occupied, cells[i].count);
      if (progress) progress(static_cast<double>(drives) / static_cast<double>(single_scans_.size()));
    }
    ++drives;
  }
  return fit_drawn_together(regression);
}

CalibratedLaserParams LaserCalibration::fit(const CalibrationProgress& progress) const {
  if (cells_.empty()) throw std::invalid_argument("laser calibration: no scan was of a cell whose truth is known");
  std::size_t margin = kFirstMargin, half_width = 0;
  LogisticRegression::Fit best = fit_with(margin, half_width);
  const auto try_with = [&](std::size_t other_margin, std::size_t other_half_width) {
    const NoiseLength &free = kMargins[other_margin], &half = kHalfWidths[other_half_width];
    if (half.least_m > free.least_m || half.sigmas > free.sigmas) return;
    if (progress) progress(0.0);
    LogisticRegression::Fit fit = fit_with(other_margin, other_half_width);
    if (fit.loss >= best.loss) return;
    best = std::move(fit);
    margin = other_margin;
    half_width = other_half_width;
  };
  double before = 0.0;
  do {
    before = best.loss;
    for (std::size_t k = 0; k < kHalfWidths.size(); ++k) try_with(margin, k);
    for (std::size_t k = 0; k < kMargins.size(); ++k) try_with(k, half_width);
  } while (best.loss < before);
  return {.free_margin = kMargins[margin],
          .half_width = kHalfWidths[half_width],
          .summed = laser_weights(best),
          .alone = laser_weights(fit_alone(margin, half_width, progress))};
}

MapDrive laser_drive(std::uint64_t seed, const sim::RandomWorldParams& params, double sigma_m) {
  sim::World world = sim::random_world(seed, params);
  world.camera.reset();
  if (sigma_m > 0.0) world.range_finders.front().finder.noise = {.sigma_0_m = sigma_m, .k_per_m = 0.0};
  return play_for_mapping(world, seed);
}

void add_simulated_drive(LaserCalibration& calibration, std::uint64_t seed, sim::RandomWorldParams params,
                         const CalibrationProgress& progress) {
  constexpr auto kFlight = LaserKnots::kSigma;
  const bool flight = seed % 2 == 0;
  if (flight) params.range_preset = "tof-lms";
  const MapDrive drive = laser_drive(seed, params, flight ? kFlight[seed / 2 % kFlight.size()] : 0.0);
  calibration.add(drive.T_map_base, drive.rig.range_finders.front(), drive.scans, drive.truth, progress);
}

}  // namespace credo::evaluation
