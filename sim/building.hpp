// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/world.hpp"

namespace credo::sim {

/// A door in a wall, from one side to the other of a wall between two rooms.
struct Door {
  enum class Kind { kOpening, kClosed };
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  ///< the middle of the door, on or near a wall
  Kind kind = Kind::kClosed;
  double width_m = 0.9;
  double height_m = 2.05;
  double frame_m = 0.06;                          ///< width of the frame around it
  std::optional<double> leaf_rad = std::nullopt;  ///< of an opening: it stands open, on the side of `at`, at this angle
  std::string material = "door";
  bool planned_closed = false;  ///< an opening that the floor plan does not show: there, the door is closed
};

/// A flat thing on a wall: a poster, a window, a board, a pipe, a step in the paint.
struct Overlay {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  double width_m = 1.0;
  double z0_m = 1.0;
  double z1_m = 1.8;
  double frame_m = 0.0;  ///< a dark frame around it
  bool marked = false;   ///< the floor plan shows its vertical edges
  std::string material = "poster";
};

/// A box that stands against a wall: a radiator, a shelf, a cupboard. Its front has the material, its sides are plain.
struct Fixture {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  double width_m = 1.0;
  double depth_m = 0.1;
  double z0_m = 0.0;
  double z1_m = 1.0;
  bool in_plan = true;
  std::string material = "radiator";
};

/// The place of a material in World::materials. \throws std::invalid_argument  with the nearest known name
[[nodiscard]] int index_of_material(const World& world, const std::string& name);

/// A building drawn as an architect would, turned into panels: rooms by their inner faces, doors cut through whatever
/// faces lie on both sides of a wall, things put on the nearest wall.
class Builder {
 public:
  /// \param world  receives panels and marks; its materials and ceiling must be complete.
  explicit Builder(World& world) : world_(&world) {}

  /// A polyline of walls from floor to ceiling; closed if the last point is to be joined to the first.
  void add_walls(const std::vector<Eigen::Vector2d>& points, bool closed, const std::string& material, bool in_plan);
  /// A regular prism; 4 sides with `turn_rad` = 0 have faces along x and y, and `radius_m` goes to the corners.
  void add_pillar(const Eigen::Vector2d& center, double radius_m, int sides, double turn_rad,
                  const std::string& material, bool in_plan);
  void add_box(const Eigen::Vector2d& center, const Eigen::Vector2d& size, double turn_rad, double z0_m, double z1_m,
               const std::string& material, bool in_plan);
  /// \throws std::invalid_argument  if there is no wall within 0.5 m, or the door does not fit into it.
  void add_door(const Door& door);
  void add_overlay(const Overlay& overlay);
  void add_fixture(const Fixture& fixture);

 private:
  /// A place on a wall: the direction along it, and away from it towards where it was asked for.
  struct Spot {
    int panel = 0;
    Eigen::Vector2d foot, along, away;
  };
  [[nodiscard]] int material(const std::string& name) const { return index_of_material(*world_, name); }
  [[nodiscard]] Spot nearest_wall(const Eigen::Vector2d& at) const;
  [[nodiscard]] std::vector<int> faces_of(const Spot& spot, double width_m) const;
  void cut(int panel, const Spot& spot, const Door& door);
  void cut_opening(const Door& door, const Spot& spot);
  void put_on(const Spot& spot, double from, double to, double z0_m, double z1_m, double off_m, int material);
  void add_frame(const Spot& spot, const Door& door);
  void add_panel(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double z0_m, double z1_m, int material,
                 bool in_plan);

  World* world_;
  std::vector<int> walls_;  ///< panels from floor to ceiling that things can be put on
};

/// The materials that every world knows.
[[nodiscard]] std::vector<Material> common_materials();

}  // namespace credo::sim
