// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/fleet_map.hpp"

#include "mapping/sequential_mapper.hpp"

namespace credo::evaluation {
namespace {

/// One map of several robots by a fold, whatever rig each has.
template <mapping::CellRule Rule>
class Centre {
 public:
  Centre(const mapping::MapperParams& params, const Rule& rule)
      : params_(params), rule_(rule), grid_(params.georeference) {}

  void take_in(const MapDrive& drive, const sensors::SonarSweep& sweep) {
    mapping::place_sweep(
        drive.rig, params_.georeference, params_.pose,
        {{drive.T_map_base.pose_at(sweep.time), Eigen::Matrix3d::Zero()}, {.yes = 1.0, .no = 0.0, .unknown = 0.0}},
        sweep, drive.T_map_base, counts_, placed_);
    const sensors::SonarRing& ring = drive.rig.sonar_rings[static_cast<std::size_t>(sweep.sensor)];
    const mapping::AnySonarModel model = mapping::sonar_model(ring, params_.sonar);
    for (const mapping::PlacedReading& reading : placed_)
      mapping::for_each_mass(params_.georeference, ring, model, reading,
                             [&](grids::CellIndex cell, const evidence::GridMass& mass) {
                               static_cast<void>(rule_.update(grid_.see(cell), mass, sweep.time));
                             });
  }
  [[nodiscard]] grids::MassMap masses() const {
    return grids::mass_map(grid_, [&](const typename Rule::Cell& cell) { return rule_.masses(cell); });
  }

 private:
  mapping::MapperParams params_;
  Rule rule_;
  grids::CellGrid<typename Rule::Cell> grid_;
  mapping::MappingCounts counts_;
  std::vector<mapping::PlacedReading> placed_;
};

}  // namespace

grids::MassMap fused_by_pcr2(const MapDrive& first, const MapDrive& second, const mapping::MapperParams& params,
                             Order order) {
  Centre<mapping::Pcr2Fold> centre(params, {});
  const auto all = [&](const MapDrive& drive) {
    for (const sensors::SonarSweep& sweep : drive.sweeps) centre.take_in(drive, sweep);
  };
  switch (order) {
    case Order::kFirstThenSecond:
      all(first);
      all(second);
      break;
    case Order::kSecondThenFirst:
      all(second);
      all(first);
      break;
    case Order::kByTime: {
      std::size_t i = 0, j = 0;
      while (i < first.sweeps.size() || j < second.sweeps.size()) {
        const bool take_first =
            j >= second.sweeps.size() || (i < first.sweeps.size() && first.sweeps[i].time <= second.sweeps[j].time);
        take_first ? centre.take_in(first, first.sweeps[i++]) : centre.take_in(second, second.sweeps[j++]);
      }
      break;
    }
  }
  return centre.masses();
}

grids::EvidentialGrid summed(const MapDrive& drive, const mapping::MapperParams& params) {
  mapping::TrajectoryMappingParams along;
  along.mapper = params;
  return mapping::map_along(drive.T_map_base, drive.rig, {}, drive.sweeps, along).grid;
}

}  // namespace credo::evaluation
