// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "geometry/pose.hpp"
#include "perception/scan_lines.hpp"

namespace credo::localization {

/// A wall that the filter follows. In its unknowns, the wall is the line through anchor + offset * normal(angle) with
/// the direction `angle`, and its ends lie at abscissas along it: the anchor is amid the points that were seen first,
/// so that the errors of offset and angle hardly depend on each other.
struct FilteredWall {
  Eigen::Vector2d anchor = Eigen::Vector2d::Zero();  ///< exact
  int column = 0;                                    ///< of (offset, angle) in the filter's state [m, rad]
  std::array<int, 2> end_column{-1, -1};  ///< of the abscissa of each end [m]; -1: an end that was never seen
  double low_m = 0.0;                     ///< abscissas between which it has been seen
  double high_m = 0.0;
  double unseen_m = 0.0;  ///< way since it was seen last
};

/// One scalar equation that ties the pose to a wall: what was observed less what the state makes of it, linearised.
struct WallRow {
  double residual = 0.0;
  double variance = 0.0;  ///< of the observation alone
  Eigen::RowVector3d by_pose = Eigen::RowVector3d::Zero();
  int wall_column = 0;
  Eigen::RowVector2d by_wall = Eigen::RowVector2d::Zero();
  int end_column = -1;  ///< by it the derivative is -1; -1: none
};

/// What odometry may make wrong always alike, 1-sigma: wheels of different size turn the robot unnoticed on a straight
/// way, and a wheel base that is not as measured turns it too far or too little.
struct SystematicOdometry {
  double turn_per_metre_rad = 0.05;
  double turn_per_radian_rad = 0.05;

  friend bool operator==(const SystematicOdometry&, const SystematicOdometry&) = default;
};

/// Where the robot is and where the walls in sight are, estimated together: an extended Kalman filter whose state is
/// the pose (x, y, theta), the pose before, the two systematic errors of odometry, and two unknowns for each wall, one
/// for each of its ends. As the walls'
/// errors are unknowns, a wall that is seen a hundred times does not pass for a hundred walls, and the pose is never
/// known better than the first walls were seen. All in the frame of the start.
class WallFilter {
 public:
  using State = Eigen::VectorXd;

  explicit WallFilter(const geometry::PoseEstimate& start, const SystematicOdometry& systematic = {});

  /// Another pose, of which nothing was known; the walls are forgotten.
  void restart(const geometry::PoseEstimate& pose);
  /// The robot has moved. \param motion  T_previous_current, independent of what was known
  /// \param by_odometry  it has the systematic errors
  void move(const geometry::PoseEstimate& motion, bool by_odometry);
  /// Adds to the covariance of the pose. \param doubt  in the base frame
  void widen(const Eigen::Matrix3d& doubt);
  /// Supposes another heading; what is known stays as certain.
  void turn(double by_rad) { state_[2] = geometry::wrap_angle(state_[2] + by_rad); }

  /// What odometry does not notice of the turn on a way, as far as has been learned. [rad]
  [[nodiscard]] double systematic_turn(const geometry::Pose2& motion) const;

  [[nodiscard]] const State& state() const { return state_; }
  [[nodiscard]] const std::vector<FilteredWall>& walls() const { return walls_; }
  [[nodiscard]] geometry::PoseEstimate pose() const;
  /// T_previous_current, of the pose before the latest move() and the one now, with what is known of it by both.
  [[nodiscard]] geometry::PoseEstimate step() const;

  /// A line of a scan held against a wall: across it and in angle.
  [[nodiscard]] static std::array<WallRow, 2> rows(const State& at, const perception::ScanLine& line,
                                                   const FilteredWall& wall);
  /// Likewise an end of it. Precondition: the wall has that end, and line.end_sigma_m.
  [[nodiscard]] static WallRow end_row(const State& at, const perception::ScanLine& line, const FilteredWall& wall,
                                       int end);
  /// Of the residuals of rows of one wall: the state's errors and the observations' together.
  [[nodiscard]] Eigen::MatrixXd innovation_covariance(std::span<const WallRow> rows) const;

  /// Brings in rows that were linearised at `at`. \param common  covariance of an error (x, y, theta in the base
  /// frame) that all of them share
  void update(std::span<const WallRow> rows, const State& at, const Eigen::Matrix3d& common);

  /// A wall that was not known, as a line of the scan shows it from the pose now.
  void add(const perception::ScanLine& line, const Eigen::Matrix3d& common);
  /// What a scan says of a known wall's extent, and of ends that were not known.
  void extend(std::size_t wall, const perception::ScanLine& line);
  /// Ages the walls by a way, and lets go of those unseen for longer than `most_unseen_m`, and, the longest unseen
  /// first, of more than `most_walls`.
  void forget(double way_m, double most_unseen_m, std::size_t most_walls);

 private:
  void append(const Eigen::VectorXd& value, const Eigen::MatrixXd& by_state, const Eigen::MatrixXd& own);
  void remove(const std::vector<bool>& walls);
  [[nodiscard]] Eigen::MatrixXd dense(std::span<const WallRow> rows) const;

  State state_;
  Eigen::MatrixXd covariance_;
  std::vector<FilteredWall> walls_;
};

}  // namespace credo::localization
