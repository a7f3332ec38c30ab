// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/crowd.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/building.hpp"
#include "sim/free_space.hpp"

namespace credo::sim {
namespace {

constexpr double kStep_s = 0.1;
constexpr double kBody_m = 0.25;  // radius that keeps off the walls; bodies are a little slimmer
constexpr double kTallest_m = 1.85;
constexpr double kKeptClear_m = 0.5;     // between a person and the robot
constexpr double kForesight_s = 3.0;     // how far ahead the robot's way is foreseen
constexpr double kNearRobot_m = 4.0;     // most goals are this near to where the robot is
constexpr double kNearRobotShare = 0.7;  // and so many of them
constexpr double kStandingShare = 0.5;   // of the goals at which somebody stays
constexpr double kLongestStand_s = 6.0;  // and how long
constexpr double kRethinking_s = 2.0;    // between two looks for another way
constexpr int kWaysOut = 16;             // directions in which somebody gives way
constexpr int kSides = 10;               // of the prisms that bodies are

/// One person on the way, step by step.
class Walker {
 public:
  Walker(const FreeSpace& space, const std::vector<Eigen::Vector2d>& places, const World& world, const Trajectory& way,
         Random& random)
      : space_(&space), places_(&places), way_(&way), random_(&random), speed_mps_(random.uniform(0.6, 1.1)) {
    keep_m_ = world.robot_radius_m + kBody_m + kKeptClear_m;
    foresee(0.0);
    here_ = places[random.bits() % places.size()];
    for (int i = 0; i < 50 && nearest_robot(here_) < 2.0 * keep_m_; ++i) here_ = places[random.bits() % places.size()];
  }

  [[nodiscard]] const Eigen::Vector2d& here() const { return here_; }

  void step(double now_s) {
    foresee(now_s);
    const Eigen::Vector2d next = now_s < stands_until_s_ ? here_ : along_the_way(now_s);
    if (nearest_robot(next) >= keep_m_)
      here_ = next;
    else if (nearest_robot(here_) < keep_m_)
      give_way(now_s);
  }

 private:
  void foresee(double now_s) {
    robot_.clear();
    for (double ahead = 0.0; ahead <= kForesight_s; ahead += 0.5)
      robot_.push_back(way_->pose_at(now_s + ahead).translation());
  }

  [[nodiscard]] double nearest_robot(const Eigen::Vector2d& place) const {
    double least = (place - robot_.front()).norm();
    for (const Eigen::Vector2d& at : robot_) least = std::min(least, (place - at).norm());
    return least;
  }

  /// The place of the next step towards the goal; a new goal where it is reached.
  Eigen::Vector2d along_the_way(double now_s) {
    const double stride = speed_mps_ * kStep_s;
    while (!legs_.empty() && (legs_.front() - here_).norm() <= stride) legs_.erase(legs_.begin());
    if (legs_.empty() && now_s >= rethinks_s_) {
      rethinks_s_ = now_s + kRethinking_s;
      if (random_->chance(kStandingShare)) stands_until_s_ = now_s + random_->uniform(1.0, kLongestStand_s);
      legs_ = space_->route(here_, draw_goal());
    }
    if (legs_.empty()) return here_;
    const Eigen::Vector2d next = here_ + stride * (legs_.front() - here_).normalized();
    return space_->reaches(next) ? next : here_;
  }

  Eigen::Vector2d draw_goal() {
    Eigen::Vector2d goal = (*places_)[random_->bits() % places_->size()];
    if (!random_->chance(kNearRobotShare)) return goal;
    for (int i = 0; i < 20 && (goal - robot_.front()).norm() > kNearRobot_m; ++i)
      goal = (*places_)[random_->bits() % places_->size()];
    return goal;
  }

  /// To the side on which the robot comes least near; the way to the goal is looked for anew.
  void give_way(double now_s) {
    Eigen::Vector2d best = here_;
    double farthest = nearest_robot(here_);
    for (int i = 0; i < kWaysOut; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kWaysOut;
      const Eigen::Vector2d aside =
          here_ + 1.5 * speed_mps_ * kStep_s * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      if (!space_->reaches(aside) || nearest_robot(aside) <= farthest) continue;
      farthest = nearest_robot(aside);
      best = aside;
    }
    here_ = best;
    legs_.clear();
    rethinks_s_ = std::max(rethinks_s_, now_s + 1.0);
  }

  const FreeSpace* space_;
  const std::vector<Eigen::Vector2d>* places_;
  const Trajectory* way_;
  Random* random_;
  double speed_mps_;
  double keep_m_ = 0.0;
  double stands_until_s_ = 0.0;
  double rethinks_s_ = 0.0;
  Eigen::Vector2d here_ = Eigen::Vector2d::Zero();
  std::vector<Eigen::Vector2d> legs_;
  std::vector<Eigen::Vector2d> robot_;  ///< from now on, every half second
};

}  // namespace

Crowd::Crowd(const World& world, const Trajectory& way, std::uint64_t seed) {
  if (world.people == 0) return;
  const FreeSpace space(world, {kBody_m, kTallest_m}, way.pose_at(0.0).translation());
  const std::vector<Eigen::Vector2d> places = space.places();
  if (places.empty()) return;
  for (int i = 0; i < world.people; ++i) {
    Random random(seed, kPeopleStream, static_cast<std::uint64_t>(i));
    Person person = dressed(world, random);
    Walker walker(space, places, world, way, random);
    for (double now = 0.0; now <= way.duration_s() + kStep_s; now += kStep_s) {
      person.places.push_back(walker.here());
      walker.step(now);
    }
    people_.push_back(std::move(person));
  }
}

Crowd::Person Crowd::dressed(const World& world, Random& random) const {
  const char* const kCloths[] = {"dark_cloth", "grey_cloth", "bright_cloth"};
  const int trousers = index_of_material(world, kCloths[random.bits() % 2]);
  const int shirt = index_of_material(world, kCloths[random.bits() % 3]);
  const double radius = random.uniform(0.2, 0.24), height = random.uniform(1.6, 1.8);
  return {{{0.0, 0.55 * height, 0.9 * radius, trousers},
           {0.55 * height, 0.85 * height, radius, shirt},
           {0.85 * height, height, 0.1, index_of_material(world, "skin")}},
          {}};
}

Eigen::Vector2d Crowd::place_of(const Person& person, double seconds) {
  const double step = std::clamp(seconds / kStep_s, 0.0, static_cast<double>(person.places.size() - 1));
  const auto before = static_cast<std::size_t>(step), after = std::min(before + 1, person.places.size() - 1);
  const double share = step - static_cast<double>(before);
  return (1.0 - share) * person.places[before] + share * person.places[after];
}

std::vector<Disc> Crowd::cut(double height_m, double seconds) const {
  std::vector<Disc> discs;
  for (const Person& person : people_)
    for (const Part& part : person.parts)
      if (part.z0_m <= height_m && height_m < part.z1_m)
        discs.push_back({place_of(person, seconds), part.radius_m, part.material});
  return discs;
}

std::vector<Panel> Crowd::panels(double seconds) const {
  std::vector<Panel> panels;
  for (const Person& person : people_) {
    const Eigen::Vector2d at = place_of(person, seconds);
    for (const Part& part : person.parts) {
      const auto corner = [&](int i) -> Eigen::Vector2d {
        const double angle = 2.0 * std::numbers::pi * i / kSides;
        return at + part.radius_m * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      };
      for (int i = 0; i < kSides; ++i)
        panels.push_back({corner(i), corner((i + 1) % kSides), part.z0_m, part.z1_m, part.material, false});
    }
  }
  return panels;
}

std::optional<DiscHit> first_hit(std::span<const Disc> discs, const Eigen::Vector2d& origin,
                                 const Eigen::Vector2d& direction, double max_range_m) {
  std::optional<DiscHit> nearest;
  for (const Disc& disc : discs) {
    const Eigen::Vector2d there = disc.centre - origin;
    const double along = there.dot(direction);
    const double beside_squared = there.squaredNorm() - along * along;
    if (beside_squared >= disc.radius_m * disc.radius_m) continue;
    const double inside = std::sqrt(disc.radius_m * disc.radius_m - beside_squared);
    const double range = along - inside;
    if (range <= 0.0 || range >= (nearest ? nearest->range_m : max_range_m)) continue;
    nearest = {range, inside / disc.radius_m, disc.material};
  }
  return nearest;
}

}  // namespace credo::sim
