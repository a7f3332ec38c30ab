// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/sonar_regions.hpp"

#include <algorithm>
#include <cmath>

namespace credo::mapping {

using evidence::GridMass;
using evidence::ParameterCheck;

GridMass sonar_su(double rho_m, double theta_rad, double reading_m, double half_width_rad, double unit_m) {
  if (rho_m > reading_m || rho_m < 0.0 || std::abs(theta_rad) > half_width_rad) return GridMass::vacuous();
  const double chord_distance = reading_m * std::cos(half_width_rad);
  if (rho_m * std::cos(theta_rad) < chord_distance)
    return {.empty = 1.0, .occupied = 0.0, .conflict = 0.0, .unknown = 0.0};  // eq. (11)
  const double occupied = std::min(1.0, unit_m / (2.0 * chord_distance * std::tan(half_width_rad)));
  return {.empty = 0.0, .occupied = occupied, .conflict = 0.0, .unknown = 1.0 - occupied};  // eq. (10)
}

SuSonar::SuSonar(const sensors::SonarRing& ring, const SuParams& params)
    : half_width_rad_(0.5 * ring.beam_width_rad), params_(params), no_echo_(ring, params.no_echo) {
  check_ring(ring);
  const ParameterCheck check("sonar model: ");
  check.positive("unit_m", params.unit_m);
  check.share("reliability", params.reliability);
}

double SuSonar::reach(double reading_m) const { return reading_m; }

ArcRegion arc_region(double rho_m, double reading_m, double epsilon_m) {
  if (rho_m < reading_m - epsilon_m) return ArcRegion::kBefore;
  return rho_m <= reading_m + epsilon_m ? ArcRegion::kOn : ArcRegion::kBeyond;
}

GridMass sonar_zhu(ArcRegion region, double rho, double cells) {
  switch (region) {
    case ArcRegion::kBefore: return {.empty = rho, .occupied = 0.0, .conflict = 0.0, .unknown = 1.0 - rho};
    case ArcRegion::kOn: return {.empty = 0.0, .occupied = 1.0 / cells, .conflict = 0.0, .unknown = 1.0 - 1.0 / cells};
    case ArcRegion::kBeyond: break;
  }
  return GridMass::vacuous();
}

ZhuSonar::ZhuSonar(const sensors::SonarRing& ring, const ZhuParams& params)
    : ring_(ring), params_(params), no_echo_(ring, params.no_echo) {
  check_ring(ring);
  const ParameterCheck check("sonar model: ");
  check.positive("epsilon_m", params.epsilon_m);
  check.share("rho", params.rho);
  check.positive("cell_m", params.cell_m);
  check.require(params.cells_of_arc == 0.0 || (std::isfinite(params.cells_of_arc) && params.cells_of_arc >= 1.0),
                "cells_of_arc", params.cells_of_arc, "0, or a number of at least 1");
  check.share("reliability", params.reliability);
}

double ZhuSonar::cells_of_arc(double reading_m) const {
  if (params_.cells_of_arc > 0.0) return params_.cells_of_arc;
  const double near = std::max(0.0, reading_m - params_.epsilon_m), far = reading_m + params_.epsilon_m;
  const double area = 0.5 * ring_.beam_width_rad * (far * far - near * near);
  return std::max(1.0, std::round(area / (params_.cell_m * params_.cell_m)));
}

GridMass ZhuSonar::mass(double rho_m, double theta_rad, double reading_m) const {
  if (std::abs(theta_rad) > 0.5 * ring_.beam_width_rad) return GridMass::vacuous();
  return sonar_zhu(arc_region(rho_m, reading_m, params_.epsilon_m), params_.rho, cells_of_arc(reading_m));
}

double ZhuSonar::reach(double reading_m) const { return reading_m + params_.epsilon_m; }

}  // namespace credo::mapping
