// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/integrity_monitor.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "geometry/principal_axes.hpp"
#include "localization/positive_definite.hpp"

namespace credo::localization {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using StateMatrix = PoseState::Matrix;
using StateVector = PoseState::Vector;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kDetermined = 1e-9;  ///< of a determinant that is 1 where what is taken out said nothing

double largest_sigma(const Matrix3d& covariance) {
  return std::sqrt(std::max(0.0, geometry::largest_variance(covariance.topLeftCorner<2, 2>())));
}

/// How far a pose is from another in standard deviations of the difference: the root of chi-square with 3 degrees of
/// freedom over 3, so that about 1 is expected. By the models, whatever the misfit: what lies makes the misfit, too.
double normalised(const Vector3d& shift, const Matrix3d& without, const Matrix3d& with) {
  // Without what is taken out the pose is less sure; where the two are equal, what is out has said nothing.
  const Matrix3d difference = without - with + 1e-3 * with;
  const double squared = shift.dot(difference.inverse() * shift);
  return squared > 0.0 ? std::sqrt(squared / 3.0) : 0.0;
}

/// Takes what has rows by_state out of the information, and adds what it pulls to the gradient.
void leave_out(const auto& told, StateMatrix& information, StateVector& gradient) {
  information -= told.by_state.transpose() * told.information * told.by_state;
  gradient += told.by_state.transpose() * told.weighted_residual;
}

/// The reverse.
void take_in(const auto& told, StateMatrix& information, StateVector& gradient) {
  information += told.by_state.transpose() * told.information * told.by_state;
  gradient -= told.by_state.transpose() * told.weighted_residual;
}

ProbabilityInterval fault_of(bool wall, double belief, const IntegrityParams& params) {
  const std::size_t of = fault_class(wall, belief, params);
  return of == kWallFaultClass ? params.wall_fault : params.point_faults[of].fault;
}

/// Probability of at least so many faults that come independently of each other: Poisson's, and the first term of its
/// series, which is above it.
ProbabilityInterval at_least(int faults, const ProbabilityInterval& expected) {
  const double below = std::tgamma(faults + 1.0);
  return {std::pow(expected.low, faults) / below, std::min(1.0, std::pow(expected.high, faults) / below)};
}

/// One or the other, or both: at most their sum.
ProbabilityInterval either(const ProbabilityInterval& a, const ProbabilityInterval& b) {
  return {std::min(1.0, a.low + b.low), std::min(1.0, a.high + b.high)};
}

ProbabilityInterval both(const ProbabilityInterval& a, const ProbabilityInterval& b) {
  return {a.low * b.low, a.high * b.high};
}

}  // namespace

std::size_t fault_class(bool wall, double belief, const IntegrityParams& params) {
  if (wall) return kWallFaultClass;
  std::size_t of = 0;
  while (of + 1 < params.point_faults.size() && belief >= params.point_faults[of + 1].from_belief) ++of;
  return of;
}

IntegrityMonitor::IntegrityMonitor(std::vector<WallFootprint> walls, const IntegrityParams& params)
    : walls_(std::move(walls)), params_(params) {
  constexpr std::size_t kUsualLandmarks = 96;
  landmarks_.reserve(kUsualLandmarks);
  by_landmark_.reserve(kUsualLandmarks);
  hypotheses_.reserve(kUsualLandmarks * kUsualLandmarks / 2 + kUsualLandmarks);
}

void IntegrityMonitor::add(const ProbabilityInterval& probability, const Matrix3d& covariance, const Vector3d& shift) {
  hypotheses_.push_back({probability, shift.head<2>().norm(), std::abs(shift(2)),
                         sigma_scale_ * largest_sigma(covariance),
                         sigma_scale_ * std::sqrt(std::max(0.0, covariance(2, 2)))});
}

void IntegrityMonitor::add_undetermined(const ProbabilityInterval& probability) {
  hypotheses_.push_back({probability, 0.0, 0.0, kInfinity, kInfinity});
}

/// Pieces of one wall are taken together: their rows span the same two dimensions.
void IntegrityMonitor::list_landmarks(const PoseSolution& solution, std::span<const double> beliefs) {
  assert(beliefs.size() == solution.linearised.size());
  landmarks_.clear();
  for (std::size_t k = 0; k < solution.linearised.size(); ++k) {
    const LinearisedObservation& o = solution.linearised[k];
    const ProbabilityInterval fault = fault_of(o.kind == ObservationKind::kWall, beliefs[k], params_);
    const auto known =
        std::find_if(landmarks_.begin(), landmarks_.end(), [&o](const Landmark& l) { return l.id == o.landmark; });
    if (known == landmarks_.end()) {
      landmarks_.push_back(
          {o.landmark, o.by_state, o.information, o.information * o.residual, o.kind == ObservationKind::kWall, fault});
      continue;
    }
    const PoseState::Jacobian& H = known->by_state;
    const Matrix2d T = o.by_state * H.transpose() * (H * H.transpose()).inverse();  // o.by_state = T H
    known->information += T.transpose() * o.information * T;
    known->weighted_residual += T.transpose() * (o.information * o.residual);
    known->fault = {std::max(known->fault.low, fault.low), std::max(known->fault.high, fault.high)};
  }
}

/// Takes landmarks out of the covariance P of the state, one at a time and two at a time (Sherman, Morrison and
/// Woodbury): without H, (P^-1 - H^T W H)^-1 = P + P H^T M H P with M = (1 - W H P H^T)^-1 W. Of all this only the
/// pose's rows are needed: G = P H^T there, and C_ij = H_i P H_j^T. Walls are left to add_walls.
void IntegrityMonitor::add_landmarks(const StateMatrix& covariance, Integrity& integrity) {
  using Matrix32d = Eigen::Matrix<double, 3, 2>;
  const Matrix3d with_all = covariance.topLeftCorner<3, 3>();
  by_landmark_.clear();
  for (const Landmark& l : landmarks_) by_landmark_.push_back(covariance * l.by_state.transpose());
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    const Landmark& first = landmarks_[i];
    const Matrix32d G_i = by_landmark_[i].topRows<3>();
    const Matrix2d C_ii = first.by_state * by_landmark_[i];
    const Matrix2d rest = Matrix2d::Identity() - first.information * C_ii;
    if (!(rest.determinant() > kDetermined)) {
      if (!first.wall) add_undetermined(first.fault);
      continue;
    }
    const Matrix2d M_i = rest.inverse() * first.information;
    const Matrix3d P_i = with_all + G_i * M_i * G_i.transpose();
    const Vector3d shift = G_i * (first.weighted_residual + M_i * (C_ii * first.weighted_residual));
    if (const double separation = normalised(shift, P_i, with_all); separation > integrity.separation) {
      integrity.separation = separation;
      integrity.separated = first.id;
    }
    if (first.wall) continue;
    add(first.fault, P_i, shift);
    for (std::size_t j = i + 1; j < landmarks_.size(); ++j) {
      const Landmark& second = landmarks_[j];
      if (second.wall) continue;
      const Matrix2d C_ij = first.by_state * by_landmark_[j];
      const Matrix2d MC = M_i * C_ij;
      const Matrix32d G_j = by_landmark_[j].topRows<3>() + G_i * MC;
      const Matrix2d C_jj = second.by_state * by_landmark_[j] + C_ij.transpose() * MC;
      const Matrix2d left = Matrix2d::Identity() - second.information * C_jj;
      if (!(left.determinant() > kDetermined)) {
        add_undetermined(both(first.fault, second.fault));
        continue;
      }
      const Matrix2d M_j = left.inverse() * second.information;
      const Eigen::Vector2d at_second =
          C_ij.transpose() * (first.weighted_residual + M_i * (C_ii * first.weighted_residual)) +
          C_jj * second.weighted_residual;
      add(both(first.fault, second.fault), P_i + G_j * M_j * G_j.transpose(),
          shift + G_j * (second.weighted_residual + M_j * at_second));
    }
  }
}

/// A wall that stands elsewhere, with the points that it carries, and what it has told the prior; alone and with
/// another landmark.
void IntegrityMonitor::add_walls(const PoseSolution& solution) {
  StateMatrix prior_covariance, without;
  if (!invert(solution.prior_information, prior_covariance)) return;
  for (std::size_t w = 0; w < landmarks_.size(); ++w) {
    const Landmark& wall = landmarks_[w];
    if (!wall.wall) continue;
    const WallFootprint& footprint = walls_[static_cast<std::size_t>(wall.id)];
    StateMatrix information = solution.information;
    StateVector gradient = StateVector::Zero();
    for (const Landmark& l : landmarks_)
      if (l.id == wall.id || footprint.carries(l.id)) leave_out(l, information, gradient);
    leave_out(believed_wall(footprint, solution, prior_covariance), information, gradient);
    if (!invert(information, without)) {
      add_undetermined(wall.fault);
      continue;
    }
    const StateVector shift = without * gradient;
    add(wall.fault, without.topLeftCorner<3, 3>(), shift.head<3>());
    for (std::size_t j = 0; j < landmarks_.size(); ++j) {
      const Landmark& second = landmarks_[j];
      if (footprint.carries(second.id) || (second.wall && j <= w)) continue;
      const ProbabilityInterval both_wrong = both(wall.fault, second.fault);
      const Eigen::Matrix<double, PoseState::kSize, 2> G = without * second.by_state.transpose();
      const Matrix2d C = second.by_state * G;
      const Matrix2d left = Matrix2d::Identity() - second.information * C;
      if (!(left.determinant() > kDetermined)) {
        add_undetermined(both_wrong);
        continue;
      }
      const Matrix2d M = left.inverse() * second.information;
      const Eigen::Vector2d residual = second.weighted_residual + second.information * (second.by_state * shift);
      add(both_wrong, without.topLeftCorner<3, 3>() + G.topRows<3>() * M * G.topRows<3>().transpose(),
          shift.head<3>() + G.topRows<3>() * (residual + M * (C * residual)));
    }
  }
}

void IntegrityMonitor::add_instruments(const PoseSolution& solution, const StateMatrix& covariance,
                                       Integrity& integrity) {
  for (const bool camera : {true, false}) {
    StateMatrix information = solution.information;
    StateVector gradient = StateVector::Zero();
    bool any = false;
    for (const LinearisedObservation& o : solution.linearised) {
      if ((o.kind == ObservationKind::kBearing) != camera) continue;
      any = true;
      information -= o.by_state.transpose() * o.information * o.by_state;
      gradient += o.by_state.transpose() * (o.information * o.residual);
    }
    if (!any) continue;
    separate_instrument(information, gradient, params_.instrument_fault, covariance, integrity);
  }
}

/// Wheels that have slipped: the prediction is as unsure as that.
void IntegrityMonitor::add_prediction(const PoseSolution& solution, const StateMatrix& covariance,
                                      Integrity& integrity) {
  StateMatrix prior_covariance, slipped;
  if (!invert(solution.prior_information, prior_covariance)) return;
  for (int i = 0; i < 2; ++i) prior_covariance(i, i) += params_.slip_m * params_.slip_m;
  prior_covariance(2, 2) += params_.slip_rad * params_.slip_rad;
  if (!invert(prior_covariance, slipped)) return;
  const StateMatrix told = solution.prior_information - slipped;
  separate_instrument(solution.information - told, told * solution.step, params_.prediction_fault, covariance,
                      integrity);
}

/// A hypothesis without an instrument, and how far that is from the pose.
void IntegrityMonitor::separate_instrument(const StateMatrix& information, const StateVector& gradient,
                                           const ProbabilityInterval& probability, const StateMatrix& covariance,
                                           Integrity& integrity) {
  StateMatrix without;
  if (!invert(information, without)) {
    add_undetermined(probability);
    return;
  }
  const Vector3d shift = without.topRows<3>() * gradient;
  add(probability, without.topLeftCorner<3, 3>(), shift);
  integrity.instrument_separation =
      std::max(integrity.instrument_separation,
               normalised(shift, without.topLeftCorner<3, 3>(), covariance.topLeftCorner<3, 3>()));
}

/// A hypothesis under which the pose is what is left of the information. A gradient is that of what is left out.
void IntegrityMonitor::add_without(const StateMatrix& information, const StateVector& gradient,
                                   const ProbabilityInterval& probability) {
  StateMatrix without;
  if (!invert(information, without)) {
    add_undetermined(probability);
    return;
  }
  add(probability, without.topLeftCorner<3, 3>(), without.topRows<3>() * gradient);
}

ProbabilityInterval IntegrityMonitor::expected_faults(bool walls) const {
  ProbabilityInterval expected;
  for (const Landmark& landmark : landmarks_) {
    if (landmark.wall != walls) continue;
    expected.low += landmark.fault.low;
    expected.high += landmark.fault.high;
  }
  return expected;
}

/// Three wrong points and more: whichever they are, the walls and the prediction are right. Two and a wall likewise.
/// What the points make of the misfit is wrong, too, and what walls make of it is the walls' alone.
void IntegrityMonitor::add_points(const PoseSolution& solution, double walls_misfit) {
  StateMatrix information = solution.prior_information;
  StateVector gradient = -(solution.prior_information * solution.step);
  const double weight = 1.0 / std::max(1.0, walls_misfit);
  const auto weighted = [weight](Landmark wall) {
    wall.information *= weight;
    wall.weighted_residual *= weight;
    return wall;
  };
  for (const Landmark& landmark : landmarks_)
    if (landmark.wall) take_in(weighted(landmark), information, gradient);
  const ProbabilityInterval points = expected_faults(false);
  const ProbabilityInterval two_and_more = either(at_least(kPointsTogether - 1, points), params_.points_together);
  add_without(information, gradient, either(at_least(kPointsTogether, points), params_.points_together));
  for (const Landmark& landmark : landmarks_) {
    if (!landmark.wall) continue;
    StateMatrix without_wall = information;
    StateVector with_wall = gradient;
    leave_out(weighted(landmark), without_wall, with_wall);
    add_without(without_wall, with_wall, both(landmark.fault, two_and_more));
  }
}

/// Two walls and another landmark, and more: then nothing but the prediction is right.
void IntegrityMonitor::add_all(const PoseSolution& solution) {
  StateMatrix prior_covariance;
  if (!invert(solution.prior_information, prior_covariance)) return;
  const ProbabilityInterval walls = expected_faults(true), points = expected_faults(false);
  const ProbabilityInterval pairs = at_least(2, walls), triples = at_least(3, walls);
  add({pairs.low * points.low + triples.low, pairs.high * points.high + triples.high},
      prior_covariance.topLeftCorner<3, 3>(), -solution.step.head<3>());
}

Integrity IntegrityMonitor::assess(const PoseSolution& solution, std::span<const double> beliefs,
                                   const VarianceFactors& misfit, std::span<const Alias> aliases) {
  constexpr double kFarthest_m = 100.0;
  Integrity integrity;
  hypotheses_.clear();
  list_landmarks(solution, beliefs);
  integrity.landmarks = static_cast<int>(landmarks_.size());
  sigma_scale_ = params_.sigma_overbound * std::sqrt(std::max(1.0, misfit.all));
  add({1.0, 1.0}, solution.pose.covariance(), Vector3d::Zero());  // all is right
  if (StateMatrix covariance; !landmarks_.empty() && invert(solution.information, covariance)) {
    add_landmarks(covariance, integrity);
    add_walls(solution);
    add_instruments(solution, covariance, integrity);
    add_prediction(solution, covariance, integrity);
    sigma_scale_ = params_.sigma_overbound;
    add_all(solution);
    add_points(solution, misfit.walls);
  }
  constexpr double kExactly = 1e-3;
  for (const Alias& alias : aliases)
    hypotheses_.push_back({alias.probability, alias.distance_m, alias.turn_rad, kExactly, kExactly});

  const auto levels = [&](double ProbabilityInterval::*end, double& position_m, double& heading_rad) {
    const double risk = 0.5 * params_.risk;  // for the position; as much for the heading
    using H = FaultHypothesis;
    position_m = protection_level_(hypotheses_, {end, &H::separation_m, &H::sigma_m}, risk, kFarthest_m);
    heading_rad = protection_level_(hypotheses_, {end, &H::separation_rad, &H::sigma_rad}, risk, std::numbers::pi);
  };
  ProtectionLevels& protection = integrity.protection;
  levels(&ProbabilityInterval::low, protection.position_low_m, protection.heading_low_rad);
  levels(&ProbabilityInterval::high, protection.position_high_m, protection.heading_high_rad);
  return integrity;
}

}  // namespace credo::localization
