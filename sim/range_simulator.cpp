// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/range_simulator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace credo::sim {
namespace {

constexpr double kDiskNoise_px = 0.2;  // of the image of the spot in good light: fixes the base line times focal length
constexpr double kDiskQuantum_px = 0.125;
constexpr double kOneImage_px = 3.0;  // nearer together, the images of two half spots are one
constexpr double kDimming = 0.004;    // light at which the noise doubles
constexpr double kPulse_m = 0.3;      // nearer together, two echoes of a pulse are one
constexpr double kBrokenShare = 0.004;
constexpr float kNoReturn_m = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

}  // namespace

RangeSimulator::RangeSimulator(const World& world, const RangeFinderSetup& setup, int sensor, std::uint64_t seed)
    : world_(&world), setup_(&setup), caster_(world, setup.finder.height_m), seed_(seed), sensor_(sensor) {
  Random random(seed, kCalibrationStream, 1U + static_cast<std::uint64_t>(sensor));
  const geometry::Pose2& calibrated = setup.finder.T_base_sensor;
  T_base_sensor_ = {calibrated.x + random.normal(world.nuisances.mounting_m),
                    calibrated.y + random.normal(world.nuisances.mounting_m),
                    geometry::wrap_angle(calibrated.theta + random.normal(world.nuisances.mounting_rad))};
  bias_per_m_ = random.normal(setup.bias_per_m);
}

sensors::RangeScan RangeSimulator::scan(sensors::Timestamp time,
                                        const std::function<geometry::Pose2(double)>& T_map_base, std::uint64_t index,
                                        const std::function<std::vector<Disc>(double)>& people,
                                        const Condition& condition) const {
  const sensors::RangeFinder& finder = setup_->finder;
  const std::uint64_t stream = kScanStream + static_cast<std::uint64_t>(sensor_);
  Random random(seed_, stream, index), extra(mix_bits(seed_), stream, index);
  sensors::RangeScan scan{.time = time, .sensor = sensor_, .ranges_m = {}};
  scan.ranges_m.reserve(static_cast<std::size_t>(finder.count));
  for (int beam = 0; beam < finder.count; ++beam) {
    const double later_s = finder.beam_time(beam);
    const geometry::Pose2 T_map_sensor = T_map_base(later_s) * T_base_sensor_;
    const std::vector<Disc> passing = people ? people(later_s) : std::vector<Disc>{};
    // A scan that is turned one way shows what the beams meet that point the other way.
    const double angle = T_map_sensor.theta + finder.beam_angle(beam) - condition.turn_rad;
    scan.ranges_m.push_back(worsened(reading(T_map_sensor.translation(), angle, random, passing), condition, extra));
  }
  return scan;
}

float RangeSimulator::worsened(float range, const Condition& condition, Random& random) const {
  const sensors::RangeFinder& finder = setup_->finder;
  if (!std::isfinite(range)) return range;
  const double more = condition.noise_beyond_usual() * finder.noise.sigma(range);
  const double said = condition.scale * range + condition.offset_m + (more > 0.0 ? random.normal(more) : 0.0);
  if (said < finder.range_min_m) return kNan;
  return said > finder.range_max_m ? kNoReturn_m : static_cast<float>(said);
}

/// Too little light comes back, softly around the threshold; or the surface swallows it.
bool RangeSimulator::is_lost(double light, const Material& material, Random& random) const {
  if (random.chance(material.miss_share)) return true;
  const double excess = (light - setup_->faintest) / (0.25 * setup_->faintest);
  return random.chance(1.0 / (1.0 + std::exp(std::min(excess, 50.0))));
}

/// Triangulation: the range errs with the square of the range, more so in bad light, and is read in steps of the
/// disparity.
double RangeSimulator::measured(const Spot& spot, Random& random) const {
  const sensors::RangeNoise& noise = setup_->finder.noise;
  const double dimming = 1.0 + kDimming / std::max(spot.light, 1e-6);
  if (noise.k_per_m <= 0.0) {
    const double range = spot.range_m + random.normal(noise.sigma_0_m * std::min(dimming, 3.0));
    return setup_->quantum_m > 0.0 ? setup_->quantum_m * std::round(range / setup_->quantum_m) : range;
  }
  const double focal_base = kDiskNoise_px / noise.k_per_m;
  double disparity = focal_base / spot.range_m + random.normal(kDiskNoise_px * std::min(dimming, 3.0));
  disparity = kDiskQuantum_px * std::round(disparity / kDiskQuantum_px);
  const double range = focal_base / std::max(disparity, 1e-6);
  return range + bias_per_m_ * spot.range_m * spot.range_m + random.normal(noise.sigma_0_m);
}

/// Of the building or of somebody in it.
std::optional<RangeSimulator::Echo> RangeSimulator::first_surface(const Eigen::Vector2d& from,
                                                                  const Eigen::Vector2d& direction,
                                                                  std::span<const Disc> people) const {
  const double reach = 1.2 * setup_->finder.range_max_m;
  const std::optional<RayHit> wall = caster_.cast(from, direction, reach);
  if (const auto person = first_hit(people, from, direction, wall ? wall->range_m : reach))
    return Echo{person->range_m, person->cos_incidence, &world_->materials[static_cast<std::size_t>(person->material)]};
  if (!wall) return std::nullopt;
  const Panel& panel = world_->panels[static_cast<std::size_t>(wall->panel)];
  return Echo{wall->range_m, wall->cos_incidence, &world_->materials[static_cast<std::size_t>(panel.material)]};
}

float RangeSimulator::reading(const Eigen::Vector2d& origin, double angle, Random& random,
                              std::span<const Disc> people) const {
  const sensors::RangeFinder& finder = setup_->finder;
  if (random.chance(kBrokenShare)) return kNan;
  if (random.chance(setup_->outlier_share))
    return static_cast<float>(random.uniform(finder.range_min_m, finder.range_max_m));
  // The two halves of the light spot: on an edge they lie on different surfaces.
  Spot halves[2];
  const Material* material = nullptr;
  for (int i = 0; i < 2; ++i) {
    const double side = i == 0 ? -0.25 : 0.25;
    const double spread = angle + side * setup_->spot_rad;
    const Eigen::Vector2d direction(std::cos(spread), std::sin(spread));
    const Eigen::Vector2d from = origin + side * setup_->spot_m * Eigen::Vector2d(-direction.y(), direction.x());
    const std::optional<Echo> hit = first_surface(from, direction, people);
    if (!hit) {
      halves[i] = {1.2 * finder.range_max_m, 0.0};
      continue;
    }
    material = hit->material;
    halves[i] = {hit->range_m,
                 0.5 * material->infrared * hit->cos_incidence / std::max(hit->range_m * hit->range_m, 1e-4)};
  }
  if (material == nullptr) return kNoReturn_m;
  const double light = halves[0].light + halves[1].light;
  if (is_lost(light, *material, random)) return kNoReturn_m;
  Spot spot = halves[0].light >= halves[1].light ? halves[0] : halves[1];
  if (const double k = finder.noise.k_per_m; k > 0.0) {
    // The centre of gravity of the spot's image, where its two halves overlap.
    const double x0 = kDiskNoise_px / k / halves[0].range_m, x1 = kDiskNoise_px / k / halves[1].range_m;
    if (std::abs(x0 - x1) < kOneImage_px)
      spot.range_m = kDiskNoise_px / k * light / (x0 * halves[0].light + x1 * halves[1].light);
  } else if (std::abs(halves[0].range_m - halves[1].range_m) < kPulse_m) {
    spot.range_m = (halves[0].range_m * halves[0].light + halves[1].range_m * halves[1].light) / light;
  }
  spot.light = light;
  const double range = measured(spot, random);
  if (range < finder.range_min_m) return kNan;
  return range > finder.range_max_m ? kNoReturn_m : static_cast<float>(range);
}

}  // namespace credo::sim
