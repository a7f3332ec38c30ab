// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cmath>

#include "sim/random_building.hpp"

namespace credo::sim {
namespace {

using Point = Eigen::Vector2d;

constexpr double kWall_m = 0.12;          // between two rooms
constexpr double kDoorOffCorner_m = 0.8;  // of the middle of a door
constexpr double kOpenShare = 0.75;       // of the doors of rooms
constexpr double kLeafShare = 0.5;        // of the open doors: the leaf is still there
constexpr double kJoinedShare = 0.25;     // of neighbouring rooms that have a door between them

/// Where a row of rooms is put: along a wall, away from it.
struct Side {
  Point origin;
  Point along;
  Point away;
  double length_m;
  double depth_m;

  [[nodiscard]] Point at(double s, double d) const { return origin + s * along + d * away; }
};

struct Sizes {
  double narrowest_m = 3.0;
  double widest_m = 5.5;
  double joined_share = kJoinedShare;
};

Room rectangle(const Point& low, const Point& high, RoomUse use) {
  return {{low, {high.x(), low.y()}, high, {low.x(), high.y()}}, use, {}};
}

/// Turned the right way round, whatever the handedness of the side.
Room room_on(const Side& side, double from, double to) {
  Room room{{side.at(from, kWall_m), side.at(to, kWall_m), side.at(to, side.depth_m), side.at(from, side.depth_m)},
            RoomUse::kOffice,
            {2}};
  const bool clockwise = side.along.x() * side.away.y() - side.along.y() * side.away.x() < 0.0;
  if (clockwise) {
    std::reverse(room.outline.begin(), room.outline.end());
    room.outer = {0};
  }
  return room;
}

Door draw_door(const Point& at, double open_share, Random& random) {
  Door door;
  door.at = at;
  door.width_m = random.uniform(0.85, 1.05);
  if (!random.chance(open_share)) return door;
  door.kind = Door::Kind::kOpening;
  if (random.chance(kLeafShare)) door.leaf_rad = random.uniform(1.5, 2.1);
  return door;
}

/// Rooms side by side along a wall, each with a door in it.
void add_row(const Side& side, const Sizes& sizes, Random& random, Layout& layout) {
  const double mean = random.uniform(sizes.narrowest_m, sizes.widest_m);
  const int count = std::max(1, static_cast<int>(std::round(side.length_m / mean)));
  std::vector<double> shares;
  double sum = 0.0;
  for (int i = 0; i < count; ++i) sum += shares.emplace_back(random.uniform(0.8, 1.2));
  double from = 0.0;
  for (int i = 0; i < count; ++i) {
    const double width = side.length_m * shares[static_cast<std::size_t>(i)] / sum;
    const double to = from + width - (i + 1 < count ? kWall_m : 0.0);
    layout.rooms.push_back(room_on(side, from, to));
    const double place =
        random.uniform(from + kDoorOffCorner_m, std::max(from + kDoorOffCorner_m, to - kDoorOffCorner_m));
    layout.doors.push_back(draw_door(side.at(place, kWall_m + 0.02), kOpenShare, random));
    if (i > 0 && random.chance(sizes.joined_share))
      layout.doors.push_back(
          {.at = side.at(from, random.uniform(kWall_m + 1.0, side.depth_m - 1.0)), .kind = Door::Kind::kOpening});
    from += width;
  }
}

Side above(double x0, double y, double length, double depth) { return {{x0, y}, {1, 0}, {0, 1}, length, depth}; }
Side below(double x0, double y, double length, double depth) { return {{x0, y}, {1, 0}, {0, -1}, length, depth}; }
Side right_of(double x, double y0, double length, double depth) { return {{x, y0}, {0, 1}, {1, 0}, length, depth}; }

Layout corridor(const Sizes& sizes, double length, double width, Random& random) {
  Layout layout;
  layout.rooms.push_back(rectangle({0, 0}, {length, width}, RoomUse::kCorridor));
  add_row(above(0, width, length, random.uniform(3.4, 5.2)), sizes, random, layout);
  add_row(below(0, 0, length, random.uniform(3.2, 4.8)), sizes, random, layout);
  layout.doors.push_back({.at = {0, 0.5 * width}});
  return layout;
}

Layout l_shape(Random& random) {
  const double length = random.uniform(9.0, 14.0), up = random.uniform(8.0, 12.0), width = random.uniform(1.8, 2.4);
  Layout layout;
  layout.rooms.push_back(
      {{{0, 0}, {length, 0}, {length, up}, {length - width, up}, {length - width, width}, {0, width}},
       RoomUse::kCorridor,
       {2, 5}});
  add_row(below(0, 0, length, random.uniform(3.0, 4.5)), {}, random, layout);
  add_row(above(0, width, length - width - kWall_m, random.uniform(3.5, 5.0)), {}, random, layout);
  add_row(right_of(length, 0, up, random.uniform(3.2, 4.5)), {}, random, layout);
  return layout;
}

Layout t_shape(Random& random) {
  const double length = random.uniform(11.0, 16.0), down = random.uniform(5.0, 7.5), width = random.uniform(1.8, 2.4);
  const double left = random.uniform(0.35, 0.65) * length - 0.5 * width, right = left + width;
  Layout layout;
  layout.rooms.push_back(
      {{{0, 0}, {left, 0}, {left, -down}, {right, -down}, {right, 0}, {length, 0}, {length, width}, {0, width}},
       RoomUse::kCorridor,
       {2, 5, 7}});
  add_row(above(0, width, length, random.uniform(3.4, 4.8)), {}, random, layout);
  add_row(below(0, 0, left - kWall_m, random.uniform(3.2, down)), {}, random, layout);
  add_row(below(right + kWall_m, 0, length - right - kWall_m, random.uniform(3.2, down)), {}, random, layout);
  return layout;
}

Layout hall(Random& random) {
  const double length = random.uniform(9.0, 14.0), width = random.uniform(6.0, 9.0);
  Layout layout;
  layout.rooms.push_back(rectangle({0, 0}, {length, width}, RoomUse::kHall));
  layout.rooms.back().outer = {0, 1, 3};
  add_row(above(0, width, length, random.uniform(3.2, 4.5)), {}, random, layout);
  layout.doors.push_back({.at = {length, random.uniform(1.0, width - 1.0)}, .width_m = 1.2});
  layout.doors.push_back({.at = {0, random.uniform(1.0, width - 1.0)}, .width_m = 1.6});
  return layout;
}

Layout two_halls(Random& random) {
  const double first = random.uniform(6.0, 9.5), second = random.uniform(5.5, 8.0);
  const double width = random.uniform(5.5, 8.0), other = random.uniform(4.5, width);
  Layout layout;
  layout.rooms.push_back(rectangle({0, 0}, {first, width}, RoomUse::kHall));
  layout.rooms.back().outer = {0, 3};
  layout.rooms.push_back(rectangle({first + kWall_m, 0}, {first + kWall_m + second, other}, RoomUse::kHall));
  layout.rooms.back().outer = {0, 1, 2};
  layout.doors.push_back({.at = {first, random.uniform(1.6, other - 1.6)},
                          .kind = Door::Kind::kOpening,
                          .width_m = random.uniform(1.4, 2.0)});
  add_row(above(0, width, first, random.uniform(3.2, 4.2)), {}, random, layout);
  layout.doors.push_back({.at = {0, 0.5 * width}});
  return layout;
}

/// Rooms of the same size with the door at the same place.
Layout modules(Random& random) {
  const int count = 4 + static_cast<int>(random.bits() % 3);
  const double module = random.uniform(3.2, 3.8), depth = random.uniform(3.6, 4.6), width = random.uniform(1.8, 2.2);
  const double place = random.uniform(kDoorOffCorner_m, module - kDoorOffCorner_m - kWall_m);
  Layout layout;
  layout.rooms.push_back(rectangle({0, 0}, {count * module - kWall_m, width}, RoomUse::kCorridor));
  const Side side = above(0, width, count * module - kWall_m, depth);
  for (int i = 0; i < count; ++i) {
    layout.rooms.push_back(room_on(side, i * module, (i + 1) * module - kWall_m));
    layout.doors.push_back({.at = side.at(i * module + place, kWall_m + 0.02), .kind = Door::Kind::kOpening});
    layout.doors.push_back({.at = {i * module + place, 0.0}});
  }
  return layout;
}

Layout symmetric_room(Random& random) {
  const double length = random.uniform(8.0, 10.0), width = random.uniform(5.0, 6.5);
  Layout layout;
  layout.rooms.push_back(rectangle({0, 0}, {length, width}, RoomUse::kHall));
  layout.rooms.back().outer = {0, 2};
  const double along = random.uniform(1.0, 0.4 * length);
  layout.doors.push_back({.at = {along, 0}});
  layout.doors.push_back({.at = {length - along, width}});
  return layout;
}

}  // namespace

Layout draw_layout(BuildingKind kind, Random& random) {
  switch (kind) {
    case BuildingKind::kCorridor: return corridor({}, random.uniform(10.0, 20.0), random.uniform(1.8, 2.5), random);
    case BuildingKind::kOffices:
      return corridor({2.6, 3.8, 0.6}, random.uniform(9.0, 16.0), random.uniform(1.6, 2.0), random);
    case BuildingKind::kHall: return hall(random);
    case BuildingKind::kTwoHalls: return two_halls(random);
    case BuildingKind::kLShape: return l_shape(random);
    case BuildingKind::kTShape: return t_shape(random);
    case BuildingKind::kModules: return modules(random);
    case BuildingKind::kSymmetricRoom: return symmetric_room(random);
  }
  return {};
}

}  // namespace credo::sim
