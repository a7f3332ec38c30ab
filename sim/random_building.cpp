// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/random_building.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/segment.hpp"

namespace credo::sim {
namespace {

using geometry::Segment;
using Point = Eigen::Vector2d;

constexpr double kOffCorner_m = 0.15;     // of things on walls
constexpr double kBetweenThings_m = 0.2;  // things
constexpr double kFrontOfDoor_m = 0.6;
constexpr double kInFront_m = 0.03;   // of its wall: where a thing is asked for
constexpr double kAisle_m = 0.75;     // around what stands free
constexpr double kMappedShare = 0.7;  // of the furniture that cannot easily be moved
constexpr double kMappedBoxes = 0.4;  // of the boxes
constexpr int kPlacesTried = 8;       // to find a place

/// Puts things into one room, where there is room for them.
class Furnisher {
 public:
  Furnisher(const Room& room, const std::vector<Door>& doors, bool in_pairs, Builder& builder, Random& random)
      : room_(&room), in_pairs_(in_pairs), builder_(&builder), random_(&random) {
    for (const Door& door : doors) taken_.push_back({door.at, 0.5 * door.width_m + door.frame_m, kFrontOfDoor_m});
    for (const Point& corner : room.outline) {
      low_ = low_.cwiseMin(corner);
      high_ = high_.cwiseMax(corner);
    }
  }

  void add_windows() {
    for (const std::size_t wall : room_->outer) {
      const int count = static_cast<int>(side(wall).length() / random_->uniform(2.2, 3.2));
      for (int i = 0; i < count; ++i) {
        const double width = random_->uniform(1.0, 1.7);
        const bool radiator = random_->chance(0.6), mapped = random_->chance(kMappedShare);
        on_wall(wall, width, 0.0, [&](const Point& at) {
          builder_->add_overlay({.at = at,
                                 .width_m = width,
                                 .z0_m = 0.9,
                                 .z1_m = 2.1,
                                 .frame_m = 0.05,
                                 .marked = true,
                                 .material = "window"});
          if (radiator)
            builder_->add_fixture({.at = at, .width_m = width - 0.2, .z0_m = 0.08, .z1_m = 0.88, .in_plan = mapped});
        });
      }
    }
  }

  void add_posters(int count) {
    static constexpr const char* kLooks[] = {"poster", "board", "dark"};
    for (int i = 0; i < count; ++i) {
      const double width = random_->uniform(0.6, 1.5), z0 = random_->uniform(0.5, 0.9);
      const double z1 = z0 + random_->uniform(0.7, 1.1), frame = random_->chance(0.4) ? 0.03 : 0.0;
      const std::string look = kLooks[random_->bits() % 3];
      on_wall(any_wall(), width, 0.0, [&](const Point& at) {
        builder_->add_overlay({.at = at, .width_m = width, .z0_m = z0, .z1_m = z1, .frame_m = frame, .material = look});
      });
    }
  }

  void add_shelves(int count) {
    for (int i = 0; i < count; ++i) {
      const double width = random_->uniform(0.8, 1.8), depth = random_->uniform(0.25, 0.45);
      const double height = random_->uniform(1.1, 2.0);
      const bool mapped = random_->chance(kMappedShare), books = random_->chance(0.4) && !in_pairs_;
      on_wall(any_wall(), width, depth, [&](const Point& at) {
        builder_->add_fixture({.at = at,
                               .width_m = width,
                               .depth_m = depth,
                               .z1_m = height,
                               .in_plan = mapped,
                               .material = books ? "books" : "cabinet"});
      });
    }
  }

  /// Desks and crates with an aisle around them.
  void add_boxes(int count) {
    static constexpr const char* kLooks[] = {"wood", "cabinet", "dark", "concrete"};
    for (int i = 0; i < count; ++i) {
      const Point size(random_->uniform(0.4, 1.3), random_->uniform(0.4, 0.8));
      const double turn = random_->chance(0.5) ? 0.0 : random_->uniform(0.0, std::numbers::pi);
      const double top = random_->uniform(0.75, 1.5);
      const bool mapped = random_->chance(kMappedBoxes);
      const std::string look = kLooks[random_->bits() % 4];
      standing(0.5 * size.norm(), [&](const Point& at) { builder_->add_box(at, size, turn, 0.0, top, look, mapped); });
    }
  }

  void add_pillars(int count) {
    const double radius = random_->uniform(0.18, 0.32);
    const int sides = random_->chance(0.5) ? 4 : 16;
    for (int i = 0; i < count; ++i)
      standing(radius, [&](const Point& at) { builder_->add_pillar(at, radius, sides, 0.0, "concrete", true); });
  }

 private:
  struct Taken {
    Point at;
    double half_m;   ///< along a wall, or around
    double front_m;  ///< to be kept free of what stands
  };

  [[nodiscard]] Segment side(std::size_t wall) const {
    return {room_->outline[wall], room_->outline[(wall + 1) % room_->outline.size()]};
  }
  [[nodiscard]] std::size_t any_wall() { return random_->bits() % room_->outline.size(); }
  [[nodiscard]] Point opposite(const Point& at) const { return low_ + high_ - at; }

  [[nodiscard]] bool is_free(const Point& at, double half_m, double front_m) const {
    if (in_pairs_ && (at - opposite(at)).norm() < 2.0 * half_m + std::max(kBetweenThings_m, front_m)) return false;
    return std::none_of(taken_.begin(), taken_.end(), [&](const Taken& other) {
      return (at - other.at).norm() < half_m + other.half_m + std::max({kBetweenThings_m, front_m, other.front_m});
    });
  }

  template <typename Put>
  void put(const Point& at, double half_m, double front_m, const Put& put_at) {
    put_at(at);
    taken_.push_back({at, half_m, front_m});
    if (!in_pairs_) return;
    put_at(opposite(at));
    taken_.push_back({opposite(at), half_m, front_m});
  }

  template <typename Put>
  void on_wall(std::size_t wall, double width_m, double depth_m, const Put& put_at) {
    const Segment line = side(wall);
    const double least = 0.5 * width_m + kOffCorner_m + depth_m;
    if (line.length() < 2.0 * least) return;
    for (int i = 0; i < kPlacesTried; ++i) {
      const Point at =
          line.a + random_->uniform(least, line.length() - least) * line.direction() + kInFront_m * line.normal();
      if (!is_free(at, 0.5 * width_m, 0.0)) continue;
      return put(at, 0.5 * width_m, depth_m, put_at);
    }
  }

  template <typename Put>
  void standing(double radius_m, const Put& put_at) {
    for (int i = 0; i < kPlacesTried; ++i) {
      const Point at(random_->uniform(low_.x(), high_.x()), random_->uniform(low_.y(), high_.y()));
      bool near_wall = false;
      for (std::size_t wall = 0; wall < room_->outline.size(); ++wall)
        near_wall |= geometry::distance(at, side(wall)) < radius_m + kAisle_m;
      if (near_wall || !is_free(at, radius_m, kAisle_m)) continue;
      return put(at, radius_m, kAisle_m, put_at);
    }
  }

  const Room* room_;
  bool in_pairs_;
  Builder* builder_;
  Random* random_;
  Point low_ = Point::Constant(1e9);
  Point high_ = Point::Constant(-1e9);
  std::vector<Taken> taken_;
};

int draw_count(Random& random, int least, int most) {
  return least + static_cast<int>(random.bits() % static_cast<std::uint64_t>(most - least + 1));
}

void furnish(const Room& room, const std::vector<Door>& doors, bool in_pairs, Builder& builder, Random& random) {
  Furnisher furnisher(room, doors, in_pairs, builder, random);
  furnisher.add_windows();
  switch (room.use) {
    case RoomUse::kCorridor:
      furnisher.add_shelves(draw_count(random, 1, 3));
      furnisher.add_posters(draw_count(random, 4, 9));
      break;
    case RoomUse::kOffice:
      furnisher.add_shelves(draw_count(random, 2, 4));
      furnisher.add_posters(draw_count(random, 2, 4));
      furnisher.add_boxes(draw_count(random, 1, 3));
      break;
    case RoomUse::kHall:
      furnisher.add_pillars(in_pairs ? 1 : draw_count(random, 2, 6));
      furnisher.add_shelves(draw_count(random, 2, 5));
      furnisher.add_posters(draw_count(random, 4, 8));
      furnisher.add_boxes(in_pairs ? 1 : draw_count(random, 3, 6));
      break;
  }
}

}  // namespace

void build(const Layout& layout, BuildingKind kind, Random& random, World& world) {
  static constexpr const char* kWalls[] = {"wall", "wall", "grey_wall", "brick"};
  Builder builder(world);
  const bool modules = kind == BuildingKind::kModules;
  const std::uint64_t module_seed = random.bits();
  for (const Room& room : layout.rooms) {
    const bool module = modules && room.use == RoomUse::kOffice;
    builder.add_walls(room.outline, true, module ? "wall" : kWalls[random.bits() % 4], true);
    world.areas.push_back(room.outline);
  }
  for (const Door& door : layout.doors) builder.add_door(door);
  for (const Room& room : layout.rooms) {
    Random own(modules && room.use == RoomUse::kOffice ? module_seed : random.bits());
    furnish(room, layout.doors, kind == BuildingKind::kSymmetricRoom, builder, own);
  }
}

}  // namespace credo::sim
