// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/building.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "geometry/segment.hpp"
#include "sim/yaml_map.hpp"

namespace credo::sim {
namespace {

constexpr double kReach_m = 0.5;     // to the wall that a thing is put on
constexpr double kThickest_m = 0.4;  // wall between two rooms
constexpr double kRelief_m = 0.004;  // of frames and posters on a wall
constexpr double kHandleHeight_m = 1.0;

std::string printed(const Eigen::Vector2d& p) {
  std::ostringstream out;
  out << "[" << p.x() << ", " << p.y() << "]";
  return out.str();
}

}  // namespace

int index_of_material(const World& world, const std::string& name) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < world.materials.size(); ++i) {
    if (world.materials[i].name == name) return static_cast<int>(i);
    names.push_back(world.materials[i].name);
  }
  const std::string near = nearest_word(name, names);
  throw std::invalid_argument("unknown material '" + name + "'" +
                              (near.empty() ? "" : ": did you mean '" + near + "'?"));
}

void Builder::add_panel(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double z0_m, double z1_m, int material,
                        bool in_plan) {
  if ((b - a).norm() < 1e-3 || z1_m <= z0_m) return;
  world_->panels.push_back({a, b, z0_m, z1_m, material, in_plan});
}

void Builder::add_walls(const std::vector<Eigen::Vector2d>& points, bool closed, const std::string& name,
                        bool in_plan) {
  if (points.size() < 2) throw std::invalid_argument("a wall needs at least two points");
  const int wall = material(name);
  for (std::size_t i = 0; i + (closed ? 0U : 1U) < points.size(); ++i) {
    const std::size_t before = world_->panels.size();
    add_panel(points[i], points[(i + 1) % points.size()], 0.0, world_->ceiling_m, wall, in_plan);
    if (world_->panels.size() > before) walls_.push_back(static_cast<int>(before));
  }
}

void Builder::add_pillar(const Eigen::Vector2d& center, double radius_m, int sides, double turn_rad,
                         const std::string& name, bool in_plan) {
  if (sides < 3 || radius_m <= 0.0) throw std::invalid_argument("a pillar needs at least 3 sides and a radius");
  const auto corner = [&](int i) -> Eigen::Vector2d {
    const double angle = turn_rad + 2.0 * std::numbers::pi * (i + 0.5) / sides;
    return center + radius_m * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  };
  for (int i = 0; i < sides; ++i) add_panel(corner(i), corner(i + 1), 0.0, world_->ceiling_m, material(name), in_plan);
}

void Builder::add_box(const Eigen::Vector2d& center, const Eigen::Vector2d& size, double turn_rad, double z0_m,
                      double z1_m, const std::string& name, bool in_plan) {
  const geometry::Pose2 T_map_box{center.x(), center.y(), turn_rad};
  const Eigen::Vector2d h = 0.5 * size;
  const Eigen::Vector2d corners[4] = {
      T_map_box * Eigen::Vector2d(-h.x(), -h.y()), T_map_box * Eigen::Vector2d(h.x(), -h.y()),
      T_map_box * Eigen::Vector2d(h.x(), h.y()), T_map_box * Eigen::Vector2d(-h.x(), h.y())};
  for (int i = 0; i < 4; ++i) add_panel(corners[i], corners[(i + 1) % 4], z0_m, z1_m, material(name), in_plan);
}

Builder::Spot Builder::nearest_wall(const Eigen::Vector2d& at) const {
  Spot spot;
  double least = kReach_m;
  for (const int index : walls_) {
    const Panel& panel = world_->panels[static_cast<std::size_t>(index)];
    const Eigen::Vector2d along = (panel.b - panel.a).normalized();
    const double s = std::clamp(along.dot(at - panel.a), 0.0, (panel.b - panel.a).norm());
    const Eigen::Vector2d foot = panel.a + s * along;
    if (const double distance = (at - foot).norm(); distance < least) {
      least = distance;
      const double side = geometry::cross(along, at - foot) >= 0.0 ? 1.0 : -1.0;
      spot = {index, foot, along, side * Eigen::Vector2d(-along.y(), along.x())};
    }
  }
  if (least == kReach_m) throw std::invalid_argument("there is no wall within 0.5 m of " + printed(at));
  return spot;
}

/// The faces that a door at `spot` goes through: parallel, at most a wall's thickness away, and long enough.
std::vector<int> Builder::faces_of(const Spot& spot, double width_m) const {
  std::vector<int> faces;
  for (const int index : walls_) {
    const Panel& panel = world_->panels[static_cast<std::size_t>(index)];
    const Eigen::Vector2d along = (panel.b - panel.a).normalized();
    if (std::abs(geometry::cross(along, spot.along)) > 0.02) continue;
    if (std::abs(geometry::cross(along, spot.foot - panel.a)) > kThickest_m) continue;
    const double s = along.dot(spot.foot - panel.a);
    if (s - 0.5 * width_m > 0.0 && s + 0.5 * width_m < (panel.b - panel.a).norm()) faces.push_back(index);
  }
  return faces;
}

/// Leaves the hole of a door in a panel, with the wall above it.
void Builder::cut(int index, const Spot& spot, const Door& door) {
  const Panel panel = world_->panels[static_cast<std::size_t>(index)];
  const Eigen::Vector2d along = (panel.b - panel.a).normalized();
  const double s = along.dot(spot.foot - panel.a);
  const double half = 0.5 * door.width_m;
  const Eigen::Vector2d from = panel.a + (s - half) * along, to = panel.a + (s + half) * along;
  world_->panels[static_cast<std::size_t>(index)].b = from;
  walls_.push_back(static_cast<int>(world_->panels.size()));
  world_->panels.push_back({to, panel.b, panel.z0_m, panel.z1_m, panel.material, panel.in_plan});
  add_panel(from, to, door.height_m, panel.z1_m, panel.material, false);
  if (door.planned_closed)
    world_->only_planned.push_back({from, to, 0.0, door.height_m, panel.material, panel.in_plan});
}

/// A thin strip on the wall, between two places along it.
void Builder::put_on(const Spot& spot, double from, double to, double z0_m, double z1_m, double off_m, int material) {
  const Eigen::Vector2d base = spot.foot + off_m * spot.away;
  add_panel(base + from * spot.along, base + to * spot.along, z0_m, z1_m, material, false);
}

void Builder::add_frame(const Spot& spot, const Door& door) {
  const double half = 0.5 * door.width_m, outer = half + door.frame_m;
  const int frame = material("frame");
  put_on(spot, -outer, -half, 0.0, door.height_m, kRelief_m, frame);
  put_on(spot, half, outer, 0.0, door.height_m, kRelief_m, frame);
  put_on(spot, -outer, outer, door.height_m, door.height_m + door.frame_m, kRelief_m, frame);
  if (door.frame_m <= 0.0) return;
  world_->marks.push_back(spot.foot - outer * spot.along);
  world_->marks.push_back(spot.foot + outer * spot.along);
}

/// Through every face of the wall; the sides of the hole join the faces.
void Builder::cut_opening(const Door& door, const Spot& spot) {
  const std::vector<int> faces = faces_of(spot, door.width_m);
  double low = 0.0, high = 0.0;
  const Eigen::Vector2d across(-spot.along.y(), spot.along.x());
  for (const int face : faces) {
    const double off = across.dot(world_->panels[static_cast<std::size_t>(face)].a - spot.foot);
    low = std::min(low, off);
    high = std::max(high, off);
    cut(face, spot, door);
  }
  for (const double side : {-0.5, 0.5}) {
    const Eigen::Vector2d jamb = spot.foot + side * door.width_m * spot.along;
    add_panel(jamb + low * across, jamb + high * across, 0.0, door.height_m, material("frame"), !door.planned_closed);
  }
  for (const double off : {low, high}) {
    if (high - low < 1e-3) continue;
    const Eigen::Vector2d outwards = (off == low ? -1.0 : 1.0) * across;
    add_frame({spot.panel, spot.foot + off * across, spot.along, outwards}, door);
  }
}

void Builder::add_door(const Door& door) {
  const Spot spot = nearest_wall(door.at);
  if (faces_of(spot, door.width_m + 2.0 * door.frame_m).empty())
    throw std::invalid_argument("the door at " + printed(door.at) + " does not fit into its wall");
  const double half = 0.5 * door.width_m;
  if (door.kind == Door::Kind::kClosed) {
    put_on(spot, -half, half, 0.0, door.height_m, kRelief_m, material(door.material));
    put_on(spot, half - 0.2, half - 0.06, kHandleHeight_m, kHandleHeight_m + 0.03, 0.05, material("dark"));
    add_frame(spot, door);
    world_->marks.push_back(spot.foot - half * spot.along);
    world_->marks.push_back(spot.foot + half * spot.along);
    return;
  }
  cut_opening(door, spot);
  if (!door.leaf_rad) return;
  const Eigen::Vector2d hinge = spot.foot + half * spot.along + 0.01 * spot.away;
  const Eigen::Vector2d leaf = -std::cos(*door.leaf_rad) * spot.along + std::sin(*door.leaf_rad) * spot.away;
  world_->leaves.push_back({spot.foot, hinge, -spot.along, spot.away, world_->panels.size()});
  add_panel(hinge, hinge + (door.width_m - 0.02) * leaf, 0.01, door.height_m, material(door.material), false);
}

void Builder::add_overlay(const Overlay& overlay) {
  const Spot spot = nearest_wall(overlay.at);
  const double half = 0.5 * overlay.width_m, outer = half + overlay.frame_m;
  put_on(spot, -half, half, overlay.z0_m, overlay.z1_m, kRelief_m, material(overlay.material));
  if (overlay.frame_m > 0.0) {
    const int frame = material("frame");
    const double z0 = overlay.z0_m - overlay.frame_m, z1 = overlay.z1_m + overlay.frame_m;
    put_on(spot, -outer, -half, z0, z1, kRelief_m, frame);
    put_on(spot, half, outer, z0, z1, kRelief_m, frame);
    put_on(spot, -half, half, z0, overlay.z0_m, kRelief_m, frame);
    put_on(spot, -half, half, overlay.z1_m, z1, kRelief_m, frame);
  }
  if (!overlay.marked) return;
  world_->marks.push_back(spot.foot - outer * spot.along);
  world_->marks.push_back(spot.foot + outer * spot.along);
}

void Builder::add_fixture(const Fixture& fixture) {
  const Spot spot = nearest_wall(fixture.at);
  const double half = 0.5 * fixture.width_m;
  const Eigen::Vector2d a = spot.foot - half * spot.along, b = spot.foot + half * spot.along;
  const Eigen::Vector2d out = fixture.depth_m * spot.away;
  const int front = material(fixture.material), side = material("cabinet");
  add_panel(a, a + out, fixture.z0_m, fixture.z1_m, side, fixture.in_plan);
  add_panel(a + out, b + out, fixture.z0_m, fixture.z1_m, front, fixture.in_plan);
  add_panel(b + out, b, fixture.z0_m, fixture.z1_m, side, fixture.in_plan);
}

std::vector<Material> common_materials() {
  const auto plain = [](const char* name, double albedo) { return Material{.name = name, .albedo = albedo}; };
  std::vector<Material> materials{plain("plain", 0.8),  plain("frame", 0.32), plain("door", 0.55),
                                  plain("dark", 0.07),  plain("wood", 0.42),  plain("cabinet", 0.6),
                                  plain("board", 0.92), plain("poster", 0.3)};
  materials[3].infrared = 0.1;
  materials.push_back({.name = "wall", .albedo = 0.8, .skirting = true});
  materials.push_back({.name = "grey_wall", .albedo = 0.6, .skirting = true});
  materials.push_back({.name = "brick", .albedo = 0.5, .infrared = 0.5, .sonar_critical_rad = 0.7});
  materials.push_back({.name = "concrete", .albedo = 0.55, .infrared = 0.6, .sonar_critical_rad = 0.5});
  materials.push_back({.name = "radiator",
                       .albedo = 0.85,
                       .pattern = Pattern::kStripes,
                       .period_m = 0.08,
                       .contrast = 0.4,
                       .sonar_critical_rad = 0.6});
  materials.push_back({.name = "books",
                       .albedo = 0.75,
                       .pattern = Pattern::kBooks,
                       .period_m = 0.045,
                       .contrast = 0.8,
                       .infrared = 0.5,
                       .sonar_critical_rad = 0.7});
  const auto cloth = [](const char* name, double albedo, double infrared) {
    return Material{.name = name, .albedo = albedo, .infrared = infrared, .sonar_critical_rad = 0.7};
  };
  materials.push_back(cloth("dark_cloth", 0.08, 0.2));
  materials.push_back(cloth("grey_cloth", 0.3, 0.45));
  materials.push_back(cloth("bright_cloth", 0.75, 0.75));
  materials.push_back(cloth("skin", 0.45, 0.5));
  materials.push_back({.name = "window", .albedo = 0.2, .emission = 1.6, .infrared = 0.1, .miss_share = 0.7});
  materials.push_back({.name = "glass", .albedo = 0.45, .infrared = 0.15, .miss_share = 0.7});
  return materials;
}

}  // namespace credo::sim
