// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <concepts>

#include "evidence/grid_mass.hpp"
#include "mapping/variant.hpp"
#include "sensors/range_finder.hpp"

namespace credo::mapping {

/// What a beam says: free up to `reading - free_margin`, occupied within the half-width of the reading, nothing
/// elsewhere.
template <typename Model>
concept LaserModel = requires(const Model& model, const sensors::RangeNoise& noise, double reading_m) {
  { model.free_mass() } -> std::convertible_to<evidence::GridMass>;
  { model.hit_mass() } -> std::convertible_to<evidence::GridMass>;
  { model.free_margin(reading_m, noise) } -> std::convertible_to<double>;  // before the reading [m]
  { model.half_width(reading_m, noise) } -> std::convertible_to<double>;   // of the occupied interval, <= margin [m]
  { model.hit_share(reading_m, noise) } -> std::convertible_to<double>;    // discounts hit_mass further, in [0, 1]
  { model.reliability() } -> std::convertible_to<double>;                  // discounts both, in [0, 1)
};

struct Li2006LaserParams {
  double epsilon_m = 0.05;    ///< half of the occupied interval (Li X. 2006, eqs. (10)-(12))
  double free_sigmas = 3.0;   ///< free space ends at least this many sigma of the range before the reading
  double hit_sigmas = 1.0;    ///< and the occupied interval has at least this many to either side
  double reliability = 0.95;  ///< discounts every reading
  Variant variant = Variant::kResolved;
};

/// Laser of Li X. 2006, eqs. (10)-(12): free (.9, .05, .05), occupied (.05, .9, .05). The paper's +-5 cm holds for time
/// of flight; a triangulating range finder's error grows with the square of the range. So free space ends 3 sigma
/// before the reading, the occupied interval is a sigma wide to either side, and, as the wall is in one place of it
/// only, its evidence is discounted by the share eps / half_width. As printed: +-eps at any range, not discounted.
class Li2006Laser {
 public:
  /// \throws std::invalid_argument if a parameter is out of its range.
  explicit Li2006Laser(const Li2006LaserParams& params = {});

  [[nodiscard]] evidence::GridMass free_mass() const;
  [[nodiscard]] evidence::GridMass hit_mass() const;
  [[nodiscard]] double free_margin(double reading_m, const sensors::RangeNoise& noise) const;
  [[nodiscard]] double half_width(double reading_m, const sensors::RangeNoise& noise) const;
  [[nodiscard]] double hit_share(double reading_m, const sensors::RangeNoise& noise) const;
  [[nodiscard]] double reliability() const;

 private:
  [[nodiscard]] bool is_printed() const;

  Li2006LaserParams params_;
};
static_assert(LaserModel<Li2006Laser>);

/// Li X. 2006, eqs. (10)-(12), without discounting: the masses of a cell at `rho_m` for a reading at `reading_m`.
[[nodiscard]] evidence::GridMass laser_li2006(double rho_m, double reading_m, double epsilon_m);

}  // namespace credo::mapping
