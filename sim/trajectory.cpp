// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

namespace credo::sim {
namespace {

constexpr double kSharpestCurve_rad = 2.0;  // sharper corners are turned on the spot
constexpr double kTurnAcceleration = 1.5;   // rad/s^2

/// Seconds for `amount` with a trapezoid of speed, and of its ramps.
struct Timing {
  double duration, ramp;
};
Timing timing(double amount, double speed, double acceleration) {
  const double ramp = std::min(speed / acceleration, std::sqrt(amount / acceleration));
  const double reached = ramp * acceleration;
  return {ramp + amount / reached, ramp};
}

/// The share of the way done at a share of the time, for ramps that take this share each.
double progress(double time, double ramp) {
  if (ramp <= 0.0) return time;
  const double speed = 1.0 / (1.0 - ramp);
  if (time < ramp) return 0.5 * speed * time * time / ramp;
  if (time > 1.0 - ramp) return 1.0 - 0.5 * speed * (1.0 - time) * (1.0 - time) / ramp;
  return speed * (time - 0.5 * ramp);
}

double heading_of(const Eigen::Vector2d& way) { return std::atan2(way.y(), way.x()); }

}  // namespace

Trajectory::Trajectory(const std::vector<Waypoint>& path, const Drive& drive) {
  if (path.size() < 2) throw std::invalid_argument("the path needs at least two waypoints");
  // Routes between being carried; each begins where the robot is set down.
  std::vector<std::vector<Eigen::Vector2d>> routes(1);
  std::vector<std::optional<double>> turns(1);
  for (const Waypoint& waypoint : path) {
    if (waypoint.carried_here) {
      routes.emplace_back();
      turns.push_back(waypoint.turn_rad);
    }
    if (routes.back().empty() || (waypoint.position - routes.back().back()).norm() > 1e-6)
      routes.back().push_back(waypoint.position);
  }
  if (routes.front().size() < 2) throw std::invalid_argument("the path must begin with two waypoints that are apart");
  for (std::size_t i = 0; i < routes.size(); ++i) {
    const std::vector<Eigen::Vector2d>& route = routes[i];
    here_.x = route.front().x();
    here_.y = route.front().y();
    if (turns[i])
      here_.theta = geometry::wrap_angle(here_.theta + *turns[i]);
    else if (route.size() > 1)
      here_.theta = heading_of(route[1] - route[0]);
    if (i > 0) carried_.push_back(duration_s_);
    drive_route(route, drive);
  }
  if (drive.duration_s) end_at(*drive.duration_s);
}

void Trajectory::end_at(double seconds) {
  if (seconds > duration_s_) rest(seconds - duration_s_);
  const auto comes_later = [seconds](double time) { return time >= seconds; };
  std::erase_if(pieces_, [&](const Piece& piece) { return comes_later(piece.begin_s); });
  std::erase_if(stops_, comes_later);
  std::erase_if(carried_, comes_later);
  duration_s_ = seconds;
}

/// Stop and go: turns on the spot at the waypoints, stops every step. Continuous: rounds the corners off.
void Trajectory::drive_route(const std::vector<Eigen::Vector2d>& route, const Drive& drive) {
  const bool stepping = drive.mode == Drive::Mode::kStopAndGo;
  since_stop_m_ = 0.0;
  if (stepping)
    stop(drive);
  else
    rest(drive.pause_s);
  double cut = 0.0;  // of the coming leg, taken by the curve before
  for (std::size_t i = 0; i + 1 < route.size(); ++i) {
    const Eigen::Vector2d leg = route[i + 1] - route[i];
    if (cut == 0.0) turn_to(heading_of(leg), drive);
    if (stepping) {
      drive_steps(leg.norm(), drive);
      continue;
    }
    const double done = cut;
    cut = 0.0;
    double turn = 0.0, radius = drive.turn_radius_m;
    if (i + 2 < route.size()) {
      const Eigen::Vector2d next = route[i + 2] - route[i + 1];
      turn = geometry::angle_difference(heading_of(next), heading_of(leg));
      const double half = std::tan(0.5 * std::abs(turn));
      if (std::abs(turn) > 1e-3 && std::abs(turn) < kSharpestCurve_rad) {
        cut = std::min({radius * half, 0.5 * leg.norm(), 0.5 * next.norm()});
        radius = cut / half;
      }
    }
    drive_straight(leg.norm() - done - cut, drive);
    if (cut > 0.0) {
      const double length = radius * std::abs(turn);
      const double speed = std::min(drive.speed_mps, drive.turn_speed_radps * radius);
      const Timing t = timing(length, speed, drive.acceleration_mps2);
      add(length, turn, t.duration, t.ramp);
    }
  }
  if (!stepping) rest(drive.pause_s);
}

void Trajectory::drive_steps(double length_m, const Drive& drive) {
  double left = length_m;
  while (since_stop_m_ + left >= drive.step_m - 1e-9) {
    const double piece = std::min(left, drive.step_m - since_stop_m_);
    drive_straight(piece, drive);
    left -= piece;
    stop(drive);
  }
  if (left > 1e-9) drive_straight(left, drive);
  since_stop_m_ += left;
}

void Trajectory::stop(const Drive& drive) {
  stops_.push_back(duration_s_ + 0.5 * drive.pause_s);
  rest(drive.pause_s);
  since_stop_m_ = 0.0;
}

void Trajectory::rest(double seconds) { add(0.0, 0.0, seconds, 0.0); }

void Trajectory::turn_to(double heading, const Drive& drive) {
  const double turn = geometry::angle_difference(heading, here_.theta);
  if (std::abs(turn) < 1e-6) return;
  const Timing t = timing(std::abs(turn), drive.turn_speed_radps, kTurnAcceleration);
  add(0.0, turn, t.duration, t.ramp);
}

void Trajectory::drive_straight(double length_m, const Drive& drive) {
  if (length_m <= 1e-9) return;
  const Timing t = timing(length_m, drive.speed_mps, drive.acceleration_mps2);
  add(length_m, 0.0, t.duration, t.ramp);
}

void Trajectory::add(double length_m, double turn_rad, double duration_s, double ramp_s) {
  pieces_.push_back({duration_s_, duration_s, here_, length_m, turn_rad, ramp_s});
  here_ = at_end(pieces_.back(), 1.0);
  duration_s_ += duration_s;
}

/// The share of the piece that is driven by then, 0 before and 1 after it.
double Trajectory::share_at(const Piece& piece, double seconds) {
  const double time = std::clamp((seconds - piece.begin_s) / piece.duration_s, 0.0, 1.0);
  return progress(time, piece.ramp_s / piece.duration_s);
}

/// Where the robot is after a share of the piece: on an arc, or on the spot.
geometry::Pose2 Trajectory::at_end(const Piece& piece, double share) {
  const double turn = piece.turn_rad * share, length = piece.length_m * share;
  const double half = 0.5 * turn;
  const double chord = std::abs(half) < 1e-9 ? length : length * std::sin(half) / half;
  return piece.start * geometry::Pose2{chord * std::cos(half), chord * std::sin(half), turn};
}

namespace {

/// Whether going on to `to` from the end of a stretch leads straight on.
bool continues(const geometry::Segment& stretch, const Eigen::Vector2d& to) {
  const Eigen::Vector2d a = stretch.b - stretch.a, b = to - stretch.b;
  return a.norm() > 1e-9 && a.dot(b) > 0.0 && std::abs(geometry::cross(a, b)) < 1e-9 * a.norm() * b.norm();
}

}  // namespace

std::vector<geometry::Segment> Trajectory::stretches(double from_s, double to_s) const {
  constexpr double kLongestChord_rad = 0.05;
  std::vector<geometry::Segment> stretches;
  for (const Piece& piece : pieces_) {
    if (piece.begin_s + piece.duration_s < from_s || piece.begin_s > to_s) continue;
    const double begin = share_at(piece, from_s), end = share_at(piece, to_s);
    Eigen::Vector2d from = at_end(piece, begin).translation();
    const bool set_down = stretches.empty() || (stretches.back().b - from).norm() > 1e-6;
    if (set_down) stretches.push_back({from, from});
    if (piece.length_m == 0.0) continue;
    const int chords = std::max(1, static_cast<int>(std::ceil(std::abs(piece.turn_rad) / kLongestChord_rad)));
    for (int i = 1; i <= chords; ++i) {
      const Eigen::Vector2d to = at_end(piece, begin + (end - begin) * (static_cast<double>(i) / chords)).translation();
      if (continues(stretches.back(), to))
        stretches.back().b = to;
      else
        stretches.push_back({from, to});
      from = to;
    }
  }
  return stretches;
}

geometry::Pose2 Trajectory::pose_at(double seconds) const {
  const auto after = std::upper_bound(pieces_.begin() + 1, pieces_.end(), seconds,
                                      [](double t, const Piece& piece) { return t < piece.begin_s; });
  const Piece& piece = *(after - 1);
  return at_end(piece, share_at(piece, seconds));
}

}  // namespace credo::sim
