// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/wall_filter.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace credo::localization {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::RowVector2d;
using Eigen::RowVector3d;
using Eigen::Vector2d;
using geometry::Pose2;
using perception::ScanLine;

constexpr int kPoses = 6;          // unknowns of the pose now and the one before
constexpr int kHead = kPoses + 2;  // and the systematic errors of odometry

Pose2 pose_of(const WallFilter::State& state, int column = 0) {
  return {state[column], state[column + 1], state[column + 2]};
}

Vector2d perpendicular(const Vector2d& v) { return {-v.y(), v.x()}; }

/// A point of the scan beside the anchor of a wall, in the frame of the start, and how it moves with the heading.
struct Placed {
  Placed(const WallFilter::State& at, const Vector2d& in_base, const Vector2d& anchor)
      : from_anchor(pose_of(at) * in_base - anchor), by_theta(perpendicular(pose_of(at).rotation() * in_base)) {}

  Vector2d from_anchor, by_theta;
};

/// Of a direction (or normal) of the wall: what it has of the placed point, by the pose.
RowVector3d by_pose(const Vector2d& direction, const Placed& point) {
  return {direction.x(), direction.y(), direction.dot(point.by_theta)};
}

/// What the systematic errors of odometry grow with.
RowVector2d way_and_turn(const Pose2& motion) { return {std::hypot(motion.x, motion.y), motion.theta}; }

/// The error of the base that all points of a scan share, in the frame of the start.
Matrix3d turned(const Matrix3d& common, const Pose2& pose) {
  Matrix3d R = Matrix3d::Identity();
  R.topLeftCorner<2, 2>() = pose.rotation();
  return R * common * R.transpose();
}

MatrixXd stacked_by_pose(std::span<const WallRow> rows) {
  MatrixXd stacked(static_cast<Eigen::Index>(rows.size()), 3);
  for (std::size_t i = 0; i < rows.size(); ++i) stacked.row(static_cast<Eigen::Index>(i)) = rows[i].by_pose;
  return stacked;
}

}  // namespace

WallFilter::WallFilter(const geometry::PoseEstimate& start, const SystematicOdometry& systematic)
    : state_(State::Zero(kHead)), covariance_(MatrixXd::Zero(kHead, kHead)) {
  covariance_(kPoses, kPoses) = systematic.turn_per_metre_rad * systematic.turn_per_metre_rad;
  covariance_(kPoses + 1, kPoses + 1) = systematic.turn_per_radian_rad * systematic.turn_per_radian_rad;
  restart(start);
}

void WallFilter::restart(const geometry::PoseEstimate& pose) {
  remove(std::vector<bool>(walls_.size(), true));
  state_.head<kPoses>() << pose.pose.x, pose.pose.y, pose.pose.theta, pose.pose.x, pose.pose.y, pose.pose.theta;
  covariance_.topRows<kPoses>().setZero();
  covariance_.leftCols<kPoses>().setZero();
  covariance_.topLeftCorner<kPoses, kPoses>() = pose.covariance.replicate<2, 2>();
}

geometry::PoseEstimate WallFilter::pose() const { return {pose_of(state_), covariance_.topLeftCorner<3, 3>()}; }

geometry::PoseEstimate WallFilter::step() const {
  const Pose2 now = pose_of(state_), before = pose_of(state_, 3);
  const Pose2 step = before.inverse() * now;
  const Eigen::Matrix2d to_before = before.rotation().transpose();
  Eigen::Matrix<double, 3, kPoses> J = Eigen::Matrix<double, 3, kPoses>::Zero();
  J.block<2, 2>(0, 0) = to_before;
  J.block<2, 2>(0, 3) = -to_before;
  J.block<2, 1>(0, 5) = -perpendicular(step.translation());
  J(2, 2) = 1.0;
  J(2, 5) = -1.0;
  return {step, J * covariance_.topLeftCorner<kPoses, kPoses>() * J.transpose()};
}

void WallFilter::move(const geometry::PoseEstimate& motion, bool by_odometry) {
  const Pose2 before = pose_of(state_);
  // The turn comes about evenly over the way, so that half of it turns the way.
  const RowVector2d turn_by_systematic = by_odometry ? way_and_turn(motion.pose) : RowVector2d::Zero();
  const double turn = turn_by_systematic * state_.segment<2>(kPoses);
  const Vector2d way = Pose2{0.0, 0.0, before.theta + 0.5 * turn} * motion.pose.translation();
  const Pose2 now{before.x + way.x(), before.y + way.y(),
                  geometry::wrap_angle(before.theta + motion.pose.theta + turn)};
  // (now, before) by (the pose that was latest, the systematic errors).
  Eigen::Matrix<double, kPoses, kHead> F = Eigen::Matrix<double, kPoses, kHead>::Zero();
  F.block<3, 3>(0, 0).setIdentity();
  F.block<2, 1>(0, 2) = perpendicular(way);
  F.block<2, 2>(0, kPoses) = 0.5 * perpendicular(way) * turn_by_systematic;
  F.block<1, 2>(2, kPoses) = turn_by_systematic;
  F.block<3, 3>(3, 0).setIdentity();
  const Eigen::Index rest = state_.size() - kPoses;
  const MatrixXd with_rest = F * covariance_.block(0, kPoses, kHead, rest);
  const Eigen::Matrix<double, kPoses, kPoses> poses = F * covariance_.topLeftCorner<kHead, kHead>() * F.transpose();
  covariance_.topLeftCorner<kPoses, kPoses>() = poses;
  covariance_.topLeftCorner<3, 3>() += turned(motion.covariance, before);
  covariance_.block(0, kPoses, kPoses, rest) = with_rest;
  covariance_.block(kPoses, 0, rest, kPoses) = with_rest.transpose();
  state_.head<kPoses>() << now.x, now.y, now.theta, before.x, before.y, before.theta;
}

double WallFilter::systematic_turn(const Pose2& motion) const {
  return way_and_turn(motion) * state_.segment<2>(kPoses);
}

void WallFilter::widen(const Matrix3d& doubt) { covariance_.topLeftCorner<3, 3>() += turned(doubt, pose_of(state_)); }

std::array<WallRow, 2> WallFilter::rows(const State& at, const ScanLine& line, const FilteredWall& wall) {
  const double offset = at[wall.column], angle = at[wall.column + 1];
  const Vector2d along(std::cos(angle), std::sin(angle)), normal = perpendicular(along);
  const Placed centroid(at, line.line.centroid, wall.anchor);
  const double across = line.line.sigma_across, turn = line.line.sigma_angle;
  return {WallRow{.residual = normal.dot(centroid.from_anchor) - offset,
                  .variance = across * across,
                  .by_pose = by_pose(normal, centroid),
                  .wall_column = wall.column,
                  .by_wall = {-1.0, -along.dot(centroid.from_anchor)}},
          WallRow{.residual = geometry::wrap_angle(at[2] + line.line.angle - angle),
                  .variance = turn * turn,
                  .by_pose = {0.0, 0.0, 1.0},
                  .wall_column = wall.column,
                  .by_wall = {0.0, -1.0}}};
}

WallRow WallFilter::end_row(const State& at, const ScanLine& line, const FilteredWall& wall, int end) {
  const std::size_t e = static_cast<std::size_t>(end);
  const double angle = at[wall.column + 1], sigma = *line.end_sigma_m[e];
  const Vector2d along(std::cos(angle), std::sin(angle));
  const Placed point(at, end == 0 ? line.extent.a : line.extent.b, wall.anchor);
  return {.residual = along.dot(point.from_anchor) - at[wall.end_column[e]],
          .variance = sigma * sigma,
          .by_pose = by_pose(along, point),
          .wall_column = wall.column,
          .by_wall = {0.0, perpendicular(along).dot(point.from_anchor)},
          .end_column = wall.end_column[e]};
}

MatrixXd WallFilter::dense(std::span<const WallRow> rows) const {
  MatrixXd H = MatrixXd::Zero(static_cast<Eigen::Index>(rows.size()), state_.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    H.block<1, 3>(row, 0) = rows[i].by_pose;
    H.block<1, 2>(row, rows[i].wall_column) = rows[i].by_wall;
    if (rows[i].end_column >= 0) H(row, rows[i].end_column) = -1.0;
  }
  return H;
}

MatrixXd WallFilter::innovation_covariance(std::span<const WallRow> rows) const {
  std::vector<int> columns{0, 1, 2, rows.front().wall_column, rows.front().wall_column + 1};
  for (const WallRow& row : rows)
    if (row.end_column >= 0) columns.push_back(row.end_column);
  const MatrixXd known = covariance_(columns, columns);
  MatrixXd H = MatrixXd::Zero(static_cast<Eigen::Index>(rows.size()), known.rows());
  Eigen::Index end = 5;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    H.row(row).head<3>() = rows[i].by_pose;
    H.row(row).segment<2>(3) = rows[i].by_wall;
    if (rows[i].end_column >= 0) H(row, end++) = -1.0;
  }
  MatrixXd S = H * known * H.transpose();
  for (std::size_t i = 0; i < rows.size(); ++i) S.diagonal()[static_cast<Eigen::Index>(i)] += rows[i].variance;
  return S;
}

void WallFilter::update(std::span<const WallRow> rows, const State& at, const Matrix3d& common) {
  if (rows.empty()) return;
  const MatrixXd H = dense(rows), by_poses = stacked_by_pose(rows);
  State from_at = state_ - at;
  from_at[2] = geometry::wrap_angle(from_at[2]);
  Eigen::VectorXd innovation = -H * from_at;
  for (std::size_t i = 0; i < rows.size(); ++i) innovation[static_cast<Eigen::Index>(i)] -= rows[i].residual;
  const MatrixXd W = covariance_ * H.transpose();
  MatrixXd S = H * W + by_poses * turned(common, pose_of(at)) * by_poses.transpose();
  for (std::size_t i = 0; i < rows.size(); ++i) S.diagonal()[static_cast<Eigen::Index>(i)] += rows[i].variance;
  const Eigen::LLT<MatrixXd> solver(S);
  state_ += W * solver.solve(innovation);
  state_[2] = geometry::wrap_angle(state_[2]);
  covariance_ -= W * solver.solve(W.transpose());
  covariance_ = 0.5 * (covariance_ + covariance_.transpose()).eval();
}

/// \param by_state  of the new unknowns; their own errors have the covariance `own`
void WallFilter::append(const Eigen::VectorXd& value, const MatrixXd& by_state, const MatrixXd& own) {
  const Eigen::Index n = state_.size(), k = value.size();
  const MatrixXd with_known = by_state * covariance_;
  MatrixXd grown(n + k, n + k);
  grown << covariance_, with_known.transpose(), with_known, with_known * by_state.transpose() + own;
  covariance_ = std::move(grown);
  state_.conservativeResize(n + k);
  state_.tail(k) = value;
}

void WallFilter::add(const ScanLine& line, const Matrix3d& common) {
  FilteredWall wall{.anchor = pose_of(state_) * line.line.centroid, .column = static_cast<int>(state_.size())};
  const Eigen::Vector2d value(0.0, geometry::wrap_angle(state_[2] + line.line.angle));
  const Vector2d normal = perpendicular({std::cos(value[1]), std::sin(value[1])});
  Eigen::Matrix<double, 2, 3> by_poses;
  by_poses << by_pose(normal, Placed(state_, line.line.centroid, wall.anchor)), RowVector3d(0.0, 0.0, 1.0);
  MatrixXd by_state = MatrixXd::Zero(2, state_.size());
  by_state.leftCols<3>() = by_poses;
  const Eigen::Vector2d own(line.line.sigma_across * line.line.sigma_across,
                            line.line.sigma_angle * line.line.sigma_angle);
  append(value, by_state,
         MatrixXd(own.asDiagonal()) + by_poses * turned(common, pose_of(state_)) * by_poses.transpose());
  walls_.push_back(wall);
  extend(walls_.size() - 1, line);
}

void WallFilter::extend(std::size_t index, const ScanLine& line) {
  FilteredWall& wall = walls_[index];
  const double angle = state_[wall.column + 1];
  const Vector2d along(std::cos(angle), std::sin(angle));
  const std::array<Vector2d, 2> ends{line.extent.a, line.extent.b};
  for (std::size_t e = 0; e < 2; ++e) {
    const Placed point(state_, ends[e], wall.anchor);
    const double abscissa = along.dot(point.from_anchor);
    wall.low_m = std::min(wall.low_m, abscissa);
    wall.high_m = std::max(wall.high_m, abscissa);
    if (!line.end_sigma_m[e] || wall.end_column[e] >= 0) continue;
    wall.end_column[e] = static_cast<int>(state_.size());
    MatrixXd by_state = MatrixXd::Zero(1, state_.size());
    by_state.leftCols<3>() = by_pose(along, point);
    by_state(0, wall.column + 1) = perpendicular(along).dot(point.from_anchor);
    const double sigma = *line.end_sigma_m[e];
    append(Eigen::VectorXd::Constant(1, abscissa), by_state, MatrixXd::Constant(1, 1, sigma * sigma));
  }
  wall.unseen_m = 0.0;
}

void WallFilter::forget(double way_m, double most_unseen_m, std::size_t most_walls) {
  for (FilteredWall& wall : walls_) wall.unseen_m += way_m;
  std::vector<std::size_t> by_age(walls_.size());
  std::iota(by_age.begin(), by_age.end(), std::size_t{0});
  std::stable_sort(by_age.begin(), by_age.end(),
                   [this](std::size_t a, std::size_t b) { return walls_[a].unseen_m < walls_[b].unseen_m; });
  std::vector<bool> gone(walls_.size(), false);
  for (std::size_t rank = 0; rank < by_age.size(); ++rank)
    gone[by_age[rank]] = rank >= most_walls || walls_[by_age[rank]].unseen_m > most_unseen_m;
  if (std::find(gone.begin(), gone.end(), true) != gone.end()) remove(gone);
}

void WallFilter::remove(const std::vector<bool>& gone) {
  std::vector<int> kept(kHead);
  std::iota(kept.begin(), kept.end(), 0);
  std::vector<FilteredWall> walls;
  const auto keep = [&kept](int& column) {
    kept.push_back(column);
    column = static_cast<int>(kept.size()) - 1;
  };
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    if (gone[w]) continue;
    FilteredWall wall = walls_[w];
    kept.push_back(wall.column);
    kept.push_back(wall.column + 1);
    wall.column = static_cast<int>(kept.size()) - 2;
    for (int& end : wall.end_column)
      if (end >= 0) keep(end);
    walls.push_back(wall);
  }
  const State state = state_(kept);
  const MatrixXd covariance = covariance_(kept, kept);
  state_ = state;
  covariance_ = covariance;
  walls_ = std::move(walls);
}

}  // namespace credo::localization
