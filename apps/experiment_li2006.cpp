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
  mapping::TrajectoryMappingParams params = evaluation::as_in_papers(sonar);
  params.mapper.georeference.resolution_m = 0.1;
  params.mapper.laser = mapping::Li2006LaserParams{.reliability = laser_reliability};
  return params;
}

/// The same with readings from one place as Credo has them (mapping/freshness.hpp).
mapping::TrajectoryMappingParams ours(const mapping::SonarParams& sonar, double laser_reliability) {
  mapping::TrajectoryMappingParams params = sensed_params(sonar, laser_reliability);
  params.mapper.freshness = {};
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
      {{"both, Credo's calibrated sonar", ours(mapping::CalibratedSonarParams{}, kLaserReliability),
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

MapTable sensed_table(const std::string& title, const std::vector<SensedMethod>& methods) {
  MapTable table{title, score_columns(), {}};
  table.columns.push_back({"conflict", 3});
  for (const SensedMethod& sensed : methods)
    table.rows.push_back(empty_row(sensed.method.name, sensed.paper, table.columns.size()));
  return table;
}

/// Adds the maps of a drive to a table.
/// \param shown  gets the maps, too, unless null
void add_drive(MapTable& table, const std::vector<SensedMethod>& methods, const MapDrive& drive,
               std::vector<ShownMap>* shown, const std::function<void()>& made) {
  for (std::size_t k = 0; k < methods.size(); ++k) {
    const grids::MassMap map = evaluation::map_by(methods[k].method, seen_by(drive, methods[k].sensors)).map;
    const evaluation::MapScore score = evaluation::map_score(map, drive.truth);
    add_score(table.rows[k], score);
    table.rows[k].values.back().add(score.conflict);
    if (shown != nullptr)
      shown->push_back({methods[k].method.name, fmt::format("accuracy {:.2f} %", 100.0 * score.accuracy()), map});
    made();
  }
}

const std::vector<std::string> kSensedNotes{
    "Poses: the paper's robot has no other than its ego-motion from the laser's lines, with odometry as prior, from a "
    "known start. The second table is of the same readings from where they were taken.",
    "The paper's claim is a picture: the map by DSmT is clearer than that by DST. From the same masses the two decide "
    "alike in every cell; DSmT's has the conflict, which tends to 1 wherever a cell was seen often.",
    "Printed, all four masses carry the same lambda, which the division by their sum cancels: a reading says the same "
    "at "
    "the edge of the cone as on its axis. Discounted by lambda, as resolved, it says less there. With rho_v = 1 the "
    "sonar draws walls half a metre thick, and the laser's evidence has to outweigh them.",
    "Eq. (4), printed, loses mass: the products of the reliabilities are not given to ignorance. The text does so, and "
    "so is it here. All cells begin vacuous: with Bel(occupied) = 1, as printed, none could ever become empty."};

}  // namespace

MapReport reproduce_li2006(const ExperimentParams& params, const Report& report) {
  const sim::World world = sim::load_world(find_shipped("li2006", kWorlds));
  const std::vector<SensedMethod> methods = sensed_methods();
  const int maps = params.seeds * static_cast<int>(2 * methods.size());
  int done = 0;
  const auto made = [&] { report(++done, maps); };
  MapReport result;
  MapTable moved = sensed_table("poses by ego-motion, as in the paper", methods);
  MapTable exact = sensed_table("the same readings with exact poses", methods);
  MapTable poses{"ego-motion against the truth, from the start on",
                 {{"mean error cm", 1, 100.0}, {"at the end cm", 1, 100.0}},
                 {empty_row("position", "", 2)}};
  for (int i = 0; i < params.seeds; ++i) {
    const std::uint64_t seed = params.seed + static_cast<std::uint64_t>(i);
    const evaluation::EgoMotionDrive ego = evaluation::play_with_ego_motion(world, seed);
    poses.rows[0].values[0].add(ego.mean_error_m);
    poses.rows[0].values[1].add(ego.last_error_m);
    add_drive(moved, methods, ego.drive, i == 0 ? &result.maps : nullptr, made);
    add_drive(exact, methods, evaluation::play_for_mapping(world, seed), nullptr, made);
  }
  result.heading =
      fmt::format("Li X. 2006: 20 m x 20 m, 16 sonars and a laser of 181 beams, \"Z\" exploration, cells of 10 cm; {}",
                  params.seeds_text());
  result.tables = {moved, exact, poses};
  result.notes = kSensedNotes;
  return result;
}

}  // namespace credo::apps
