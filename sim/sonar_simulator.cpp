// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/sonar_simulator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "geometry/segment.hpp"

namespace credo::sim {
namespace {

constexpr int kRays = 21;
constexpr int kReflections = 2;
constexpr double kReturn_rad = 0.12;     // a detour comes back if its last wall is met this nearly head-on
constexpr double kCornerStrength = 0.7;  // echo relative to a wall's
constexpr double kEdgeStrength = 0.2;
constexpr double kBodyStrength = 0.3;  // clothes swallow much of it
constexpr double kAbsorption_per_m = 0.15;
constexpr double kMargin = 4.0;  // a wall at the largest range is this much louder than the threshold
constexpr double kJoined_m = 1e-3;
constexpr double kNoEcho_m = std::numeric_limits<double>::infinity();

/// Echo amplitude of a wall on the axis: spreading and absorption, there and back.
double amplitude(double range_m) { return std::exp(-2.0 * kAbsorption_per_m * range_m) / std::max(range_m, 0.1); }

/// Both ways through the main lobe, which falls to a tenth at half of the beam width.
double lobe(double off_axis_rad, double beam_width_rad) {
  const double share = off_axis_rad / (0.5 * beam_width_rad);
  return std::exp(-2.3 * share * share);
}

}  // namespace

SonarSimulator::SonarSimulator(const World& world, const SonarSetup& setup, int sensor, std::uint64_t seed)
    : world_(&world), setup_(&setup), caster_(world, setup.ring.height_m), seed_(seed), sensor_(sensor) {
  for (int i = 0; i < kRays; ++i) ray_angles_.push_back(setup.ring.beam_width_rad * ((i + 0.5) / kRays - 0.5));
  find_junctions();
}

void SonarSimulator::find_junctions() {
  const auto& panels = world_->panels;
  const std::vector<int>& here = caster_.panels();
  for (std::size_t i = 0; i < here.size(); ++i)
    for (std::size_t j = i + 1; j < here.size(); ++j) {
      const Panel& p = panels[static_cast<std::size_t>(here[i])];
      const Panel& q = panels[static_cast<std::size_t>(here[j])];
      const Eigen::Vector2d ends_p[2] = {p.a, p.b}, ends_q[2] = {q.a, q.b};
      for (int a = 0; a < 2; ++a)
        for (int b = 0; b < 2; ++b) {
          if ((ends_p[a] - ends_q[b]).norm() > kJoined_m) continue;
          const Eigen::Vector2d along_p = (ends_p[1 - a] - ends_p[a]).normalized();
          const Eigen::Vector2d along_q = (ends_q[1 - b] - ends_q[b]).normalized();
          if (std::abs(geometry::cross(along_p, along_q)) > 0.7) junctions_.push_back({ends_p[a], along_p, along_q});
        }
    }
}

bool SonarSimulator::is_loud(double range_m, double off_axis_rad, double strength) const {
  const sensors::SonarRing& ring = setup_->ring;
  const double threshold = amplitude(ring.range_max_m) / kMargin;
  return strength * lobe(off_axis_rad, ring.beam_width_rad) * amplitude(range_m) > threshold;
}

/// Follows each ray over up to two mirrors. It comes back where the first wall is met within its critical angle, or a
/// later one head-on.
void SonarSimulator::listen_to_walls(const geometry::Pose2& T_map_transducer, double& nearest) const {
  for (const double off_axis : ray_angles_) {
    const double angle = T_map_transducer.theta + off_axis;
    Eigen::Vector2d from = T_map_transducer.translation(), direction(std::cos(angle), std::sin(angle));
    double way = 0.0;
    int left = -1;
    for (int mirror = 0; mirror <= kReflections; ++mirror) {
      const std::optional<RayHit> hit = caster_.cast(from, direction, 1.1 * setup_->ring.range_max_m - way, left);
      if (!hit) break;
      way += hit->range_m;
      if (way >= nearest) break;
      const Panel& panel = world_->panels[static_cast<std::size_t>(hit->panel)];
      const Material& material = world_->materials[static_cast<std::size_t>(panel.material)];
      const double critical = mirror == 0 ? material.sonar_critical_rad : kReturn_rad;
      if (hit->cos_incidence >= std::cos(critical)) {
        if (is_loud(way, off_axis, 1.0)) nearest = way;
        break;
      }
      const Eigen::Vector2d along = (panel.b - panel.a).normalized();
      from += hit->range_m * direction;
      direction = 2.0 * along.dot(direction) * along - direction;
      left = hit->panel;
    }
  }
}

void SonarSimulator::listen_to_junctions(const geometry::Pose2& T_map_transducer, double& nearest) const {
  const geometry::Pose2 T_transducer_map = T_map_transducer.inverse();
  for (const Junction& junction : junctions_) {
    const Eigen::Vector2d there = T_transducer_map * junction.at;
    const double range = there.norm();
    if (range >= nearest || range > setup_->ring.range_max_m || range < 1e-3) continue;
    const double off_axis = std::atan2(there.y(), there.x());
    if (std::abs(off_axis) > 0.5 * setup_->ring.beam_width_rad) continue;
    // Inside of the angle if the transducer is a positive combination of the two walls' directions.
    const Eigen::Vector2d back = T_map_transducer.translation() - junction.at;
    const double twist = geometry::cross(junction.along_a, junction.along_b);
    const bool inside =
        geometry::cross(back, junction.along_b) / twist > 0.0 && geometry::cross(junction.along_a, back) / twist > 0.0;
    if (!is_loud(range, off_axis, inside ? kCornerStrength : kEdgeStrength)) continue;
    const auto hit = caster_.cast(T_map_transducer.translation(), -back / range, range);
    if (hit && hit->range_m < range - 0.01) continue;
    nearest = range;
  }
}

/// A body is round: it always has a place that is met head-on.
void SonarSimulator::listen_to_people(const geometry::Pose2& T_map_transducer, std::span<const Disc> people,
                                      double& nearest) const {
  for (const Disc& person : people) {
    const Eigen::Vector2d there = T_map_transducer.inverse() * person.centre;
    const double range = there.norm() - person.radius_m;
    if (range <= 0.0 || range >= nearest) continue;
    const Eigen::Vector2d direction = (person.centre - T_map_transducer.translation()).normalized();
    if (caster_.cast(T_map_transducer.translation(), direction, range)) continue;
    if (is_loud(range, std::atan2(there.y(), there.x()), kBodyStrength)) nearest = range;
  }
}

double SonarSimulator::first_echo(const geometry::Pose2& T_map_transducer, std::span<const Disc> people) const {
  double nearest = kNoEcho_m;
  listen_to_walls(T_map_transducer, nearest);
  listen_to_junctions(T_map_transducer, nearest);
  listen_to_people(T_map_transducer, people, nearest);
  return nearest;
}

sensors::SonarSweep SonarSimulator::sweep(sensors::Timestamp time,
                                          const std::function<geometry::Pose2(double)>& T_map_base, std::uint64_t index,
                                          const std::function<std::vector<Disc>(double)>& people) const {
  const sensors::SonarRing& ring = setup_->ring;
  Random random(seed_, kSonarStream + static_cast<std::uint64_t>(sensor_), index);
  sensors::SonarSweep sweep{.time = time, .sensor = sensor_, .ranges_m = {}};
  for (std::size_t i = 0; i < ring.T_base_transducer.size(); ++i) {
    const double fired = ring.firing_times_s.empty() ? 0.0 : ring.firing_times_s[i];
    const std::vector<Disc> passing = people ? people(fired) : std::vector<Disc>{};
    const double echo = first_echo(T_map_base(fired) * ring.T_base_transducer[i], passing);
    const double noise = random.normal(), phantom = random.uniform();
    const bool crossed = random.chance(setup_->cross_talk_share);
    double range = echo + noise * std::max(ring.sigma_m, setup_->relative_sigma * std::min(echo, ring.range_max_m));
    // Cross-talk: the pulse of a neighbour comes first.
    if (crossed) range = ring.range_min_m + phantom * (std::min(echo, ring.range_max_m) - ring.range_min_m);
    // Nearer than the transducer can listen after its pulse: it still rings.
    if (range < ring.range_min_m) range = ring.range_min_m;
    sweep.ranges_m.push_back(static_cast<float>(range > ring.range_max_m ? kNoEcho_m : range));
  }
  return sweep;
}

}  // namespace credo::sim
