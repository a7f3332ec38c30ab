// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <concepts>
#include <functional>
#include <utility>

#include "evidence/grid_mass.hpp"
#include "evidence/parameter_check.hpp"
#include "mapping/variant.hpp"
#include "sensors/sonar_ring.hpp"

namespace credo::mapping {

/// The beam shape lambda: 1 on the axis, 0 at the edge of the cone (Li X. 2006, eq. (9); Li X. 2007, eq. (9); Li P.,
/// eq. (12)).
[[nodiscard]] double beam_weight(double theta_rad, double beam_width_rad);

/// What is not in the papers: nothing came back. Specular walls give it as often as free space, so it says little.
struct NoEchoParams {
  double reliability = 0.05;  ///< of "empty"; 0: no evidence
  double range_m = 2.0;       ///< and up to here only, or the ring's range_max where that is nearer
};

/// What a transducer says where nothing came back.
class NoEcho {
 public:
  /// Taken as an echo from beyond the range: free space as of Li X. 2007, eq. (5), with R - 2 eps = range_max.
  /// \throws std::invalid_argument if a parameter is out of its range.
  NoEcho(const sensors::SonarRing& ring, const NoEchoParams& params);
  /// \param mass  of a cell at rho_m, theta_rad. \param reach_m  vacuous beyond
  NoEcho(std::function<evidence::GridMass(double rho_m, double theta_rad)> mass, double reliability, double reach_m)
      : mass_(std::move(mass)), reliability_(reliability), reach_m_(reach_m) {}

  [[nodiscard]] evidence::GridMass mass(double rho_m, double theta_rad) const { return mass_(rho_m, theta_rad); }
  [[nodiscard]] double reliability() const { return reliability_; }
  [[nodiscard]] double reach() const { return reach_m_; }

 private:
  std::function<evidence::GridMass(double, double)> mass_;
  double reliability_, reach_m_;
};

/// Checks what all models need of a ring. \throws std::invalid_argument if the beam is not between 0 and pi wide, or
/// the range is empty.
void check_ring(const sensors::SonarRing& ring);

/// What an echo of a transducer says about a cell at distance `rho` and angle `theta` from the beam axis, and how far
/// it is to be trusted; what it says where nothing came back. Lengths from the transducer; masses before discounting.
template <typename Model>
concept SonarModel = requires(const Model& model, double rho_m, double theta_rad, double reading_m) {
  { model.mass(rho_m, theta_rad, reading_m) } -> std::same_as<evidence::GridMass>;
  { model.reliability() } -> std::convertible_to<double>;     // in [0, 1]
  { model.reach(reading_m) } -> std::convertible_to<double>;  // vacuous beyond
  { model.no_echo() } -> std::same_as<const NoEcho&>;
};

/// Any model, chosen at run time.
class AnySonarModel {
 public:
  template <SonarModel Model>
  explicit AnySonarModel(const Model& model)
      : mass_([model](double rho, double theta, double reading) { return model.mass(rho, theta, reading); }),
        reach_([model](double reading) { return model.reach(reading); }),
        reliability_(model.reliability()),
        no_echo_(model.no_echo()) {}

  [[nodiscard]] evidence::GridMass mass(double rho_m, double theta_rad, double reading_m) const {
    return mass_(rho_m, theta_rad, reading_m);
  }
  [[nodiscard]] double reliability() const { return reliability_; }
  [[nodiscard]] double reach(double reading_m) const { return reach_(reading_m); }
  [[nodiscard]] const NoEcho& no_echo() const { return no_echo_; }

 private:
  std::function<evidence::GridMass(double, double, double)> mass_;
  std::function<double(double)> reach_;
  double reliability_;
  NoEcho no_echo_;
};
static_assert(SonarModel<AnySonarModel>);

}  // namespace credo::mapping
