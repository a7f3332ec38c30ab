// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>

#include "apps/map_report.hpp"
#include "apps/shipped.hpp"

// Li X. 2006, "Sonar and laser": 20 m x 20 m in cells of 10 cm, 16 sonars and a laser of 181 beams, "Z" exploration.
namespace credo::apps {
namespace {

using evaluation::MapDrive;
using evaluation::MapMethod;
using mapping::Li2006SonarParams;
using mapping::Variant;

enum Sensors { kSonar = 1, kLaser = 2, kBoth = kSonar | kLaser };

struct SensedMethod {
  MapMethod method;
  Sensors sensors;
  std::string paper;
};

mapping::TrajectoryMappingParams sensed_params(const mapping::SonarParams& sonar, double laser_reliability) {
  mapping::TrajectoryMappingParams params;
  params.mapper.georeference.resolution_m = 0.1;
  params.mapper.sonar = sonar;
  params.mapper.laser.reliability = laser_reliability;
  return params;
}

Li2006SonarParams sonar(Variant variant, double rho_v, double reliability) {
  return {.epsilon_m = 0.05,
          .rho_v_per_m2 = rho_v,
          .reliability = reliability,
          .no_echo = {.reliability = 0.0},
          .variant = variant};
}

std::vector<SensedMethod> sensed_methods() {
  constexpr double kUndiscounted = 0.99, kLaserReliability = 0.95;  // p_i; not in the paper
  const Li2006SonarParams printed = sonar(Variant::kPrinted, 1.0, 0.7), resolved = sonar(Variant::kResolved, 1.0, 0.7);
  const Li2006SonarParams narrow = sonar(Variant::kResolved, 100.0, 0.7);
  return {
      {{"sonar, printed", sensed_params(printed, kLaserReliability), grids::ReadOut::kDsmc}, kSonar, ""},
      {{"sonar, resolved", sensed_params(resolved, kLaserReliability), grids::ReadOut::kDsmc}, kSonar, ""},
      {{"sonar, resolved, rho_v 100", sensed_params(narrow, kLaserReliability), grids::ReadOut::kDsmc}, kSonar, ""},
      {{"laser", sensed_params(resolved, kLaserReliability), grids::ReadOut::kDsmc}, kLaser, ""},
      {{"both, DSmT, printed, discounted", sensed_params(printed, kLaserReliability), grids::ReadOut::kDsmc},
       kBoth,
       "clearer"},
      {{"both, DSmT, resolved, discounted", sensed_params(resolved, kLaserReliability), grids::ReadOut::kDsmc},
       kBoth,
       "clearer"},
      {{"both, DSmT, resolved, not discounted",
        sensed_params(sonar(Variant::kResolved, 1.0, kUndiscounted), kUndiscounted), grids::ReadOut::kDsmc},
       kBoth,
       ""},
      {{"both, Dempster, the same masses", sensed_params(resolved, kLaserReliability), grids::ReadOut::kDempster},
       kBoth,
       ""},
      {{"both, resolved, rho_v 100", sensed_params(narrow, kLaserReliability), grids::ReadOut::kDempster}, kBoth, ""},
      {{"both, Credo's calibrated sonar", sensed_params(mapping::CalibratedSonarParams{}, kLaserReliability),
        grids::ReadOut::kDempster},
       kBoth,
       ""},
  };
}

MapDrive seen_by(const MapDrive& drive, Sensors sensors) {
  MapDrive part = drive;
  if (!(sensors & kSonar)) part.sweeps.clear();
  if (!(sensors & kLaser)) part.scans.clear();
  return part;
}

}  // namespace

MapReport reproduce_li2006(const ExperimentParams& params, const Report& report) {
  const sim::World world = sim::load_world(find_shipped("li2006", kWorlds));
  const std::vector<SensedMethod> all = sensed_methods();
  const int maps = params.seeds * static_cast<int>(all.size());
  int done = 0;
  MapTable table{"which sensors, which formulas", score_columns(), {}};
  table.columns.push_back({"conflict", 3});
  for (const SensedMethod& sensed : all)
    table.rows.push_back(empty_row(sensed.method.name, sensed.paper, table.columns.size()));
  MapReport result;
  for (int i = 0; i < params.seeds; ++i) {
    const MapDrive drive = evaluation::play_for_mapping(world, params.seed + static_cast<std::uint64_t>(i));
    for (std::size_t k = 0; k < all.size(); ++k) {
      const grids::MassMap map = evaluation::map_by(all[k].method, seen_by(drive, all[k].sensors)).map;
      const evaluation::MapScore score = evaluation::map_score(map, drive.truth);
      add_score(table.rows[k], score);
      table.rows[k].values.back().add(score.conflict);
      if (i == 0)
        result.maps.push_back({all[k].method.name, fmt::format("accuracy {:.2f} %", 100.0 * score.accuracy()), map});
      report(++done, maps);
    }
  }
  result.heading = fmt::format(
      "Li X. 2006: 20 m x 20 m, 16 sonars and a laser of 181 beams, \"Z\" exploration, cells of 10 cm; {} "
      "seeds from {}",
      params.seeds, params.seed);
  result.tables = {table};
  result.notes = {
      "The paper's claim is a picture: the map by DSmT is clearer than that by DST. From the same masses the two "
      "decide "
      "alike in every cell; DSmT's has the conflict, which tends to 1 wherever a cell was seen often.",
      "Printed, all four masses carry the same lambda, which the division by their sum cancels: a reading says the "
      "same at "
      "the edge of the cone as on its axis. Discounted by lambda, as resolved, it says less there. With rho_v = 1 the "
      "sonar draws walls half a metre thick, and the laser's evidence has to outweigh them.",
      "Eq. (4), printed, loses mass: the products of the reliabilities are not given to ignorance. The text does so, "
      "and "
      "so is it here. All cells begin vacuous: with Bel(occupied) = 1, as printed, none could ever become empty."};
  return result;
}

}  // namespace credo::apps
