// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <tuple>
#include <vector>

#include "localization/localization.hpp"
#include "localization/misfit.hpp"
#include "localization/moved_wall.hpp"
#include "localization/pose_solver.hpp"
#include "localization/protection_level.hpp"

namespace credo::localization {

/// How often a match is wrong whose track is believed at least so much.
struct FaultPrior {
  double from_belief = 0.0;  ///< BetP(YES) of the track's existence, up to the next entry's
  ProbabilityInterval fault;
};

struct IntegrityParams {
  double risk = 1e-5;  ///< of position or heading beyond its protection level, per acquisition; half for each
  /// The measured frequency of wrong matches of points (corners, edges, others) among tracks of equal belief, with its
  /// Clopper-Pearson interval at 95 %, by growing belief: 109 of 34 181, 609 of 108 418 and 613 of 436 782 where
  /// nothing else speaks against the pose, over 360 simulated drives through 60 random buildings (`credo campaign
  /// faults`).
  std::array<FaultPrior, 3> point_faults{{{0.0, {2.6e-3, 3.8e-3}}, {0.55, {5.2e-3, 6.1e-3}}, {0.99, {1.3e-3, 1.5e-3}}}};
  /// The same of walls: 12 of 219 680.
  ProbabilityInterval wall_fault{2.8e-5, 9.5e-5};
  /// Three points and more are wrong at once, as where something that the plan does not have looks like what it has:
  /// 33 of 27 264 acquisitions.
  ProbabilityInterval points_together{8.3e-4, 1.7e-3};
  /// Of the errors' standard deviations, so that their tails lie below a normal one's. Measured is 1.3 for position and
  /// heading, where 1 in 10 000 is exceeded (15 146 acquisitions of 200 drives).
  double sigma_overbound = 1.7;
  ProbabilityInterval instrument_fault{1e-7, 1e-6};  ///< all that an instrument says is wrong in the same way
  ProbabilityInterval prediction_fault{1e-4, 1e-3};  ///< wheels have slipped since the acquisition before, as far as
  double slip_m = 0.5;                               ///< this, 1-sigma,
  double slip_rad = 0.1;                             ///< and this
};

/// Matches are classed by how often they are wrong: points as IntegrityParams::point_faults has them, then walls.
inline constexpr std::size_t kFaultClasses = std::tuple_size_v<decltype(IntegrityParams::point_faults)> + 1;
inline constexpr std::size_t kWallFaultClass = kFaultClasses - 1;
/// Where so many points are wrong at once, no point is believed.
inline constexpr int kPointsTogether = 3;

/// \param belief  BetP(YES) that the track of the match exists; of no matter for a wall
[[nodiscard]] std::size_t fault_class(bool wall, double belief, const IntegrityParams& params = {});

/// A pose elsewhere that would explain the readings: everything matched may be shifted by a module that repeats.
struct Alias {
  double distance_m = 0.0;
  double turn_rad = 0.0;
  ProbabilityInterval probability;  ///< that the robot is there
};

/// What the agreement of independent subsets says of a pose.
struct Integrity {
  ProtectionLevels protection;
  /// Largest separation of the pose from the pose without one landmark, in its expected standard deviations, and that
  /// landmark. 0 where there are less than two.
  double separation = 0.0;
  tracking::LandmarkId separated = tracking::kNoLandmark;
  /// The same without an instrument (camera, range finder) or without the prediction.
  double instrument_separation = 0.0;
  int landmarks = 0;  ///< different ones that the pose rests on
};

/// Solution separation (Brown and McBurney 1988; multiple hypotheses: Blanch et al., ION GNSS 2012; for landmarks:
/// Joerger et al., Sensors 2018): under the hypothesis that some of what the pose rests on is wrong, the pose without
/// it is right, so that the error is at most what separates the two and the error of the latter. Hypotheses: one point,
/// two, a wall with its corners and with what it has told the prior, a wall and another landmark, all points (for three
/// and more), these and a wall, one instrument, the prediction, and an alias. The protection level is the length that
/// all of these together exceed with a probability of IntegrityParams::risk. Keeps its memory.
class IntegrityMonitor {
 public:
  /// \param walls  by the id of a wall that is observed, which is its landmark's
  explicit IntegrityMonitor(std::vector<WallFootprint> walls, const IntegrityParams& params = {});

  /// \param beliefs  of each observation of the solution: BetP(YES) that its track exists
  /// \param misfit  what is below 1 makes nothing more certain
  /// \param aliases  other places where the robot may be
  [[nodiscard]] Integrity assess(const PoseSolution& solution, std::span<const double> beliefs,
                                 const VarianceFactors& misfit = {}, std::span<const Alias> aliases = {});

 private:
  /// All that one landmark says, as one observation.
  struct Landmark {
    tracking::LandmarkId id = tracking::kNoLandmark;
    PoseState::Jacobian by_state = PoseState::Jacobian::Zero();   ///< H
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();        ///< W
    Eigen::Vector2d weighted_residual = Eigen::Vector2d::Zero();  ///< W r
    bool wall = false;
    ProbabilityInterval fault;
  };

  void list_landmarks(const PoseSolution& solution, std::span<const double> beliefs);
  void add_landmarks(const PoseState::Matrix& covariance, Integrity& integrity);
  void add_walls(const PoseSolution& solution);
  void add_instruments(const PoseSolution& solution, const PoseState::Matrix& covariance, Integrity& integrity);
  void add_prediction(const PoseSolution& solution, const PoseState::Matrix& covariance, Integrity& integrity);
  void separate_instrument(const PoseState::Matrix& information, const PoseState::Vector& gradient,
                           const ProbabilityInterval& probability, const PoseState::Matrix& covariance,
                           Integrity& integrity);
  void add_points(const PoseSolution& solution, double walls_misfit);
  void add_all(const PoseSolution& solution);
  void add_without(const PoseState::Matrix& information, const PoseState::Vector& gradient,
                   const ProbabilityInterval& probability);
  void add(const ProbabilityInterval& probability, const Eigen::Matrix3d& covariance, const Eigen::Vector3d& shift);
  void add_undetermined(const ProbabilityInterval& probability);
  [[nodiscard]] ProbabilityInterval expected_faults(bool walls) const;

  std::vector<WallFootprint> walls_;
  IntegrityParams params_;
  std::vector<Landmark> landmarks_;
  std::vector<Eigen::Matrix<double, PoseState::kSize, 2>> by_landmark_;  ///< P H^T of each
  std::vector<FaultHypothesis> hypotheses_;
  double sigma_scale_ = 1.0;  ///< of the hypotheses that are added
  ProtectionLevel protection_level_;
};

}  // namespace credo::localization
