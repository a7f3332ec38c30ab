// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sim/random.hpp"
#include "sim/trajectory.hpp"
#include "sim/world.hpp"

namespace credo::sim {

/// Where a horizontal plane cuts somebody.
struct Disc {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double radius_m = 0.0;
  int material = 0;  ///< index into World::materials
};

/// World::people who walk about in the free space between the walls, each to goals of their own, mostly near the robot;
/// they stand still now and then. They see the robot coming and get out of its way where there is room, and walk
/// through one another. The whole walk is drawn at the start: where somebody is, is a function of the time.
class Crowd {
 public:
  /// \throws std::invalid_argument  for a world with people that does not know what they wear (common_materials)
  Crowd(const World& world, const Trajectory& way, std::uint64_t seed);

  [[nodiscard]] bool empty() const { return people_.empty(); }
  /// Everybody as cut at a height, at `seconds` from the start; who is not as tall is left out.
  [[nodiscard]] std::vector<Disc> cut(double height_m, double seconds) const;
  /// Everybody as prisms: trousers, shirt, head.
  [[nodiscard]] std::vector<Panel> panels(double seconds) const;

 private:
  struct Part {
    double z0_m, z1_m, radius_m;
    int material;
  };
  struct Person {
    std::vector<Part> parts;
    std::vector<Eigen::Vector2d> places;  ///< every kStep_s
  };
  [[nodiscard]] Person dressed(const World& world, Random& random) const;
  [[nodiscard]] static Eigen::Vector2d place_of(const Person& person, double seconds);

  std::vector<Person> people_;
};

/// Where a ray, along a unit direction, meets a disc from outside: the distance and |cosine| of the incidence.
struct DiscHit {
  double range_m = 0.0;
  double cos_incidence = 1.0;
  int material = 0;
};
/// The nearest of some discs within `max_range_m`, if any.
[[nodiscard]] std::optional<DiscHit> first_hit(std::span<const Disc> discs, const Eigen::Vector2d& origin,
                                               const Eigen::Vector2d& direction, double max_range_m);

}  // namespace credo::sim
