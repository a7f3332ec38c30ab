// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "sim/world.hpp"

namespace credo::sim {

/// An upright cylinder that stands or moves about: the robot, a person.
struct Body {
  double radius_m = 0.25;
  double height_m = 1.0;
};

/// The places that a body can reach from where it is without touching anything: a grid of cells, each with its distance
/// to the nearest panel, of all that are ever there, as low as the body is tall.
class FreeSpace {
 public:
  /// \param from  a place where the body can be; nothing is reached from one where it cannot
  FreeSpace(const World& world, const Body& body, const Eigen::Vector2d& from);

  [[nodiscard]] bool reaches(const Eigen::Vector2d& place) const;
  /// Distance to the nearest panel, at most kFar_m (of a body that is wide itself, a little more than its radius); 0
  /// outside of the grid. [m]
  [[nodiscard]] double clearance(const Eigen::Vector2d& place) const;
  /// The centres of the reached cells with at least this clearance, row by row.
  [[nodiscard]] std::vector<Eigen::Vector2d> places(double clearance_m = 0.0) const;

  /// A short way that keeps off the walls where there is room, as few straight legs, `from` and `to` included; empty
  /// where either is not reached.
  [[nodiscard]] std::vector<Eigen::Vector2d> route(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;

  /// The place that is reached most easily, by the same measure, and the way to it.
  struct Goal {
    std::size_t place = 0;  ///< index
    std::vector<Eigen::Vector2d> way;
  };
  /// \param places  at least one; those that are not reached are passed over
  /// \return nothing where none of them is reached
  [[nodiscard]] std::optional<Goal> nearest(const Eigen::Vector2d& from,
                                            const std::vector<Eigen::Vector2d>& places) const;

  static constexpr double kCell_m = 0.1;
  static constexpr double kFar_m = 1.0;

 private:
  [[nodiscard]] int cell_of(const Eigen::Vector2d& place) const;
  [[nodiscard]] Eigen::Vector2d centre_of(int cell) const;
  [[nodiscard]] bool is_clear(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;
  [[nodiscard]] std::vector<int> cheapest_cells(int from, const std::vector<bool>& is_goal) const;
  [[nodiscard]] std::vector<Eigen::Vector2d> straightened(const Eigen::Vector2d& from, const std::vector<int>& cells,
                                                          const Eigen::Vector2d& to) const;
  void keep_off(const Panel& panel);
  void flood(int from);

  double radius_m_;
  double far_m_;
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();
  int width_ = 0;
  int height_ = 0;
  std::vector<float> clearance_;
  std::vector<bool> reached_;
};

}  // namespace credo::sim
