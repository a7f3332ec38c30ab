// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "mapping/sonar_model.hpp"

namespace credo::mapping {

// Models that split the cone into regions with constant masses: Su's, which Li X. 2007 compares itself with, and Zhu's.

struct SuParams {
  double unit_m = 0.05;  ///< length that the chord is counted in, so that 1/chord is a mass: the side of a cell. With 1
                         ///< m, the literal reading, it is none for readings below two metres
  double reliability = 1.0;  ///< as in print: "empty" is certain, and no later reading can change it
  NoEchoParams no_echo{.reliability = 0.0};
};

/// Li X. 2007, eqs. (10), (11): between the chord and the arc 1 / chord occupied, the rest unknown; before the chord
/// empty for certain. theta outside of the cone, or beyond the reading: vacuous. A chord shorter than `unit_m` is
/// occupied for certain.
[[nodiscard]] evidence::GridMass sonar_su(double rho_m, double theta_rad, double reading_m, double half_width_rad,
                                          double unit_m);

class SuSonar {
 public:
  /// \throws std::invalid_argument if a parameter is out of its range, or the ring cannot be mapped (check_ring).
  SuSonar(const sensors::SonarRing& ring, const SuParams& params = {});

  [[nodiscard]] evidence::GridMass mass(double rho_m, double theta_rad, double reading_m) const {
    return sonar_su(rho_m, theta_rad, reading_m, half_width_rad_, params_.unit_m);
  }
  [[nodiscard]] double reliability() const { return params_.reliability; }
  [[nodiscard]] double reach(double reading_m) const;
  [[nodiscard]] const NoEcho& no_echo() const { return no_echo_; }

 private:
  double half_width_rad_;
  SuParams params_;
  NoEcho no_echo_;
};
static_assert(SonarModel<SuSonar>);

/// Zhu, "Ultrasonic sensor model": before the arc, on it, and beyond.
enum class ArcRegion { kBefore, kOn, kBeyond };

/// The region of a cell; the ends of the arc [R - eps, R + eps] belong to it (in print region III begins at R - eps).
[[nodiscard]] ArcRegion arc_region(double rho_m, double reading_m, double epsilon_m);

/// Zhu, eqs. (2)-(4).
/// \param rho    mass of "empty" before the arc, in [0, 1]
/// \param cells  of the arc, at least 1: one of them is occupied
[[nodiscard]] evidence::GridMass sonar_zhu(ArcRegion region, double rho, double cells);

struct ZhuParams {
  double epsilon_m = 0.05;  ///< range error
  double rho =
      0.2;  ///< mass of "empty"; not in the paper. A large one outweighs many readings of "occupied": 1 / cells
  double cell_m = 0.05;       ///< side of a cell, which the cells of the arc are counted in
  double cells_of_arc = 0.0;  ///< n of eq. (3), where it is the same for all readings; 0: as many as the arc has
  double reliability = 1.0;   ///< as in print
  NoEchoParams no_echo{.reliability = 0.0};  ///< "effective only when the sensor can receive the echo"
};

class ZhuSonar {
 public:
  /// \throws std::invalid_argument as SuSonar.
  ZhuSonar(const sensors::SonarRing& ring, const ZhuParams& params = {});

  [[nodiscard]] evidence::GridMass mass(double rho_m, double theta_rad, double reading_m) const;
  [[nodiscard]] double reliability() const { return params_.reliability; }
  [[nodiscard]] double reach(double reading_m) const;
  [[nodiscard]] const NoEcho& no_echo() const { return no_echo_; }
  /// How many cells the arc of a reading has: its area in cells, at least 1.
  [[nodiscard]] double cells_of_arc(double reading_m) const;

 private:
  sensors::SonarRing ring_;
  ZhuParams params_;
  NoEcho no_echo_;
};
static_assert(SonarModel<ZhuSonar>);

}  // namespace credo::mapping
