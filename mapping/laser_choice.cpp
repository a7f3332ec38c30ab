// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/laser_choice.hpp"

#include <array>
#include <stdexcept>
#include <string>

namespace credo::mapping {
namespace {

// In the order of LaserParams.
constexpr std::array<std::string_view, 3> kLaserNames{"li2006", "bayes", "calibrated"};
static_assert(kLaserNames.size() == std::variant_size_v<LaserParams>);

struct TableMaker {
  const sensors::RangeFinder& finder;
  const ScanParams& params;
  ReadingsTaken taken;

  LaserTables operator()(const Li2006LaserParams& p) const { return laser_tables(Li2006Laser(p), finder, params); }
  LaserTables operator()(const BayesLaserParams& p) const { return laser_tables(BayesLaser(p), finder, params); }
  LaserTables operator()(const CalibratedLaserParams& p) const {
    return laser_tables(CalibratedLaser(p, taken), finder, params);
  }
};

}  // namespace

LaserTables laser_tables(const LaserParams& laser, const sensors::RangeFinder& range_finder, const ScanParams& params,
                         ReadingsTaken taken) {
  return std::visit(TableMaker{range_finder, params, taken}, laser);
}

std::string_view name_of(const LaserParams& params) { return kLaserNames[params.index()]; }

std::span<const std::string_view> laser_model_names() { return kLaserNames; }

LaserParams laser_params(std::string_view name) {
  if (name == "li2006") return Li2006LaserParams{};
  if (name == "bayes") return BayesLaserParams{};
  if (name == "calibrated") return default_calibrated_laser();
  throw std::invalid_argument("no laser model is called '" + std::string(name) +
                              "': expected li2006, bayes or calibrated");
}

}  // namespace credo::mapping
