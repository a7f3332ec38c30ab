// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/baseline_mcl.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/random.hpp"

namespace credo::evaluation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::Pose2;
using geometry::PoseEstimate;

enum Stream : std::uint64_t { kMotionStream = 1, kResamplingStream };

/// A square root of a covariance that may be singular.
Eigen::Matrix3d root_of(const Eigen::Matrix3d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

Pose2 drawn_from(const Pose2& mean, const Eigen::Matrix3d& root, sim::Random& random) {
  // Drawn one after the other: the order in which arguments are evaluated is the compiler's.
  Vector3d z;
  for (double& component : z) component = random.normal();
  const Vector3d error = root * z;
  return {mean.x + error.x(), mean.y + error.y(), geometry::wrap_angle(mean.theta + error.z())};
}

}  // namespace

MclLocalizer::MclLocalizer(const geometry::FloorPlan& plan, const sensors::Rig& rig, const PoseEstimate& initial,
                           const MclParams& params)
    : params_(params), field_(plan.walls), motion_(initial) {
  const double cell = field_.resolution_m();
  fixed_variance_ = plan.uncertainty_m * plan.uncertainty_m + cell * cell / 12.0;
  if (!rig.range_finders.empty()) {
    const sensors::CalibrationAccuracy& accuracy = rig.range_finders.front().accuracy;
    fixed_variance_ += accuracy.x_m * accuracy.x_m + accuracy.y_m * accuracy.y_m;
    mounting_sigma_rad_ = accuracy.theta_rad;
  }
  sim::Random random(params.seed, kMotionStream, 0);
  const Eigen::Matrix3d root = root_of(initial.covariance);
  for (int i = 0; i < params.particles; ++i)
    particles_.push_back({drawn_from(initial.pose, root, random), 1.0 / params.particles});
}

localization::Localization MclLocalizer::update(const perception::Scene& scene,
                                                const std::optional<PoseEstimate>& motion) {
  ++step_;
  move(motion_.step(motion, scene.time));
  choose_beams(scene);
  if (!beams_.empty()) weigh();
  const PoseEstimate estimate = mean();
  if (!beams_.empty()) resample();
  motion_.correct(estimate, scene.time);
  localization::Localization fix = baseline_fix(scene.time, estimate, confidence_);
  fix.detected = fix.matched = static_cast<int>(beams_.size());
  return fix;
}

void MclLocalizer::move(const PoseEstimate& step) {
  sim::Random random(params_.seed, kMotionStream, step_);
  const Eigen::Matrix3d root = root_of(step.covariance);
  for (Particle& particle : particles_) particle.pose = particle.pose * drawn_from(step.pose, root, random);
}

void MclLocalizer::choose_beams(const perception::Scene& scene) {
  beams_.clear();
  const std::size_t points = scene.points.size(), wanted = static_cast<std::size_t>(params_.beams);
  for (std::size_t k = 0; k < std::min(points, wanted); ++k) {
    const sensors::ScanPoint& point = scene.points[points > wanted ? k * points / wanted : k];
    const double sideways = mounting_sigma_rad_ * point.range_m;
    const double variance = point.sigma_m * point.sigma_m + sideways * sideways + fixed_variance_;
    beams_.push_back({point.position, 0.5 / variance});
  }
}

/// The likelihood of each beam is a mixture of a normal, 1 at its peak, and of what is not in the plan.
void MclLocalizer::weigh() {
  std::vector<double> logs;
  std::vector<double> fits;
  for (const Particle& particle : particles_) {
    const Eigen::Matrix2d R = particle.pose.rotation();
    double log_likelihood = std::log(particle.weight), fit = 0.0;
    for (const Beam& beam : beams_) {
      const double off = field_(particle.pose.translation() + R * beam.position);
      const double hit = std::exp(-off * off * beam.half_precision);
      fit += hit;
      log_likelihood += std::log((1.0 - params_.random_share) * hit + params_.random_share);
    }
    logs.push_back(log_likelihood);
    fits.push_back(fit / static_cast<double>(beams_.size()));
  }
  const double largest = *std::ranges::max_element(logs);
  double sum = 0.0;
  for (std::size_t i = 0; i < particles_.size(); ++i) sum += particles_[i].weight = std::exp(logs[i] - largest);
  confidence_ = 0.0;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    particles_[i].weight = std::max(particles_[i].weight / sum, std::numeric_limits<double>::min());
    confidence_ += particles_[i].weight * fits[i];
  }
}

/// Low-variance resampling, where few particles carry the weight.
void MclLocalizer::resample() {
  double squares = 0.0;
  for (const Particle& particle : particles_) squares += particle.weight * particle.weight;
  const double count = static_cast<double>(particles_.size());
  if (1.0 / squares >= params_.resample_below * count) return;
  sim::Random random(params_.seed, kResamplingStream, step_);
  const double first = random.uniform() / count;
  drawn_.clear();
  std::size_t i = 0;
  double passed = particles_.front().weight;
  for (std::size_t k = 0; k < particles_.size(); ++k) {
    const double wanted = first + static_cast<double>(k) / count;
    while (wanted > passed && i + 1 < particles_.size()) passed += particles_[++i].weight;
    drawn_.push_back({particles_[i].pose, 1.0 / count});
  }
  particles_.swap(drawn_);
}

/// Mean and covariance of the weighted particles.
PoseEstimate MclLocalizer::mean() const {
  constexpr double kSmallest = 1e-8;  // so that it inverts where all particles are one: 0.1 mm, 0.1 mrad
  Vector2d position = Vector2d::Zero(), direction = Vector2d::Zero();
  for (const Particle& particle : particles_) {
    position += particle.weight * particle.pose.translation();
    direction += particle.weight * particle.pose.rotation().col(0);
  }
  PoseEstimate estimate{{position.x(), position.y(), std::atan2(direction.y(), direction.x())},
                        kSmallest * Eigen::Matrix3d::Identity()};
  for (const Particle& particle : particles_) {
    const Vector3d apart(particle.pose.x - position.x(), particle.pose.y - position.y(),
                         geometry::angle_difference(particle.pose.theta, estimate.pose.theta));
    estimate.covariance += particle.weight * apart * apart.transpose();
  }
  return estimate;
}

}  // namespace credo::evaluation
