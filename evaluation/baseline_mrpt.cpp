// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/baseline_mrpt.hpp"

#include <utility>

#ifdef CREDO_MRPT
#include <mrpt/bayes/CParticleFilter.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CPointsMap.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <mrpt/random.h>
#include <mrpt/slam/CMonteCarloLocalization2D.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "localization/distance_field.hpp"
#endif

namespace credo::evaluation {

using geometry::PoseEstimate;

#ifdef CREDO_MRPT

namespace {

/// The walls of a plan as occupied cells in free space.
mrpt::maps::COccupancyGridMap2D::Ptr drawn(const geometry::FloorPlan& plan, const MrptParams& params) {
  constexpr float kMargin_m = 1.0F, kFree = 0.9F, kOccupied = 0.0F;
  Eigen::AlignedBox2d box;
  for (const geometry::Segment& wall : plan.walls) box.extend(wall.a).extend(wall.b);
  auto grid = mrpt::maps::COccupancyGridMap2D::Create();
  grid->setSize(static_cast<float>(box.min().x()) - kMargin_m, static_cast<float>(box.max().x()) + kMargin_m,
                static_cast<float>(box.min().y()) - kMargin_m, static_cast<float>(box.max().y()) + kMargin_m,
                static_cast<float>(params.cell_m), kFree);
  for (const geometry::Segment& wall : plan.walls) {
    const int steps = static_cast<int>(std::ceil(2.0 * wall.length() / params.cell_m));
    for (int k = 0; k <= steps; ++k) {
      const Eigen::Vector2d p = wall.a + (wall.b - wall.a) * k / std::max(1, steps);
      grid->setPos(static_cast<float>(p.x()), static_cast<float>(p.y()), kOccupied);
    }
  }
  return grid;
}

/// 1-sigma of where a point at the typical range should be: its own, the plan's, the mounting's and the cells'. [m]
double point_sigma(const geometry::FloorPlan& plan, const sensors::Rig& rig, const MrptParams& params) {
  double variance = plan.uncertainty_m * plan.uncertainty_m + params.cell_m * params.cell_m / 12.0;
  if (!rig.range_finders.empty()) {
    const sensors::RangeFinder& scanner = rig.range_finders.front();
    const double own = scanner.noise.sigma(params.typical_range_m);
    const double sideways = scanner.accuracy.theta_rad * params.typical_range_m;
    variance += own * own + sideways * sideways + scanner.accuracy.x_m * scanner.accuracy.x_m +
                scanner.accuracy.y_m * scanner.accuracy.y_m;
  }
  return std::sqrt(variance);
}

mrpt::poses::CPosePDFGaussian gaussian(const PoseEstimate& estimate) {
  mrpt::math::CMatrixDouble33 covariance;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) covariance(i, j) = estimate.covariance(i, j);
  return {mrpt::poses::CPose2D(estimate.pose.x, estimate.pose.y, estimate.pose.theta), covariance};
}

/// The points as a turn of rays from the base; fine enough that a ray is off by less than a point's noise.
mrpt::obs::CObservation2DRangeScan::Ptr scan_of(const perception::Scene& scene) {
  constexpr std::size_t kRays = 7201;
  auto scan = mrpt::obs::CObservation2DRangeScan::Create();
  scan->aperture = static_cast<float>(geometry::kTurn);
  scan->rightToLeft = true;
  scan->resizeScanAndAssign(kRays, 0.0F, false);
  for (const sensors::ScanPoint& point : scene.points) {
    const double turn = std::atan2(point.position.y(), point.position.x()) + std::numbers::pi;
    const auto ray = static_cast<std::size_t>(std::lround(turn / geometry::kTurn * (kRays - 1)));
    scan->setScanRange(ray, static_cast<float>(point.position.norm()));
    scan->setScanRangeValidity(ray, true);
  }
  // The points that the grid will compare, made now and kept: thinning them out, as the grid would, MRPT 2.5.8 loses
  // all but the first where rays between them are not valid.
  mrpt::maps::CPointsMap::TInsertionOptions all;
  all.minDistBetweenLaserPoints = 0.0F;
  all.isPlanarMap = true;
  scan->buildAuxPointsMap<mrpt::maps::CPointsMap>(&all);
  return scan;
}

}  // namespace

struct MrptLocalizer::State {
  State(const geometry::FloorPlan& plan, const sensors::Rig& rig, const PoseEstimate& initial, const MrptParams& p)
      : params(p),
        sigma(point_sigma(plan, rig, p)),
        grid(drawn(plan, p)),
        field(plan.walls),
        motion(initial),
        filter(static_cast<std::size_t>(p.particles)) {
    mrpt::random::getRandomGenerator().randomize(p.seed);
    auto& likelihood = grid->likelihoodOptions;
    likelihood.likelihoodMethod = mrpt::maps::COccupancyGridMap2D::lmLikelihoodField_Thrun;
    likelihood.LF_stdHit = static_cast<float>(sigma);
    likelihood.LF_zHit = static_cast<float>(1.0 - p.random_share);
    likelihood.LF_zRandom = static_cast<float>(p.random_share);
    likelihood.LF_maxCorrsDistance = static_cast<float>(localization::DistanceField::kReach_m);
    likelihood.LF_maxRange = 1.0F;        // what LF_zRandom is divided by
    likelihood.LF_useSquareDist = false;  // else the distance enters with its fourth power
    filter.options.metricMap = grid;
    const auto prior = gaussian(initial);
    for (auto& particle : filter.m_particles) {
      mrpt::poses::CPose2D pose;
      prior.drawSingleSample(pose);
      particle.d = pose.asTPose();
    }
  }

  void execute(const PoseEstimate& step, const perception::Scene& scene) {
    mrpt::obs::CActionCollection actions;
    mrpt::obs::CActionRobotMovement2D movement;
    movement.poseChange = mrpt::poses::CPosePDF::Ptr(std::make_shared<mrpt::poses::CPosePDFGaussian>(gaussian(step)));
    actions.insert(movement);
    mrpt::obs::CSensoryFrame readings;
    if (!scene.points.empty()) readings.insert(scan_of(scene));
    grid->likelihoodOptions.LF_decimation =
        std::max<std::uint32_t>(1, static_cast<std::uint32_t>(scene.points.size()) / params.beams);
    mrpt::bayes::CParticleFilter executor;
    executor.m_options.PF_algorithm = mrpt::bayes::CParticleFilter::pfStandardProposal;
    executor.m_options.resamplingMethod = mrpt::bayes::CParticleFilter::prSystematic;
    executor.executeOn(filter, &actions, &readings);
    filter.normalizeWeights();  // the mean takes their exponentials, which else are all zero
  }

  [[nodiscard]] PoseEstimate mean() const {
    constexpr double kSmallest = 1e-8;  // so that it inverts where all particles are one: 0.1 mm, 0.1 mrad
    const auto [covariance, pose] = filter.getCovarianceAndMean();
    PoseEstimate estimate{{pose.x(), pose.y(), pose.phi()}, kSmallest * Eigen::Matrix3d::Identity()};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) estimate.covariance(i, j) += covariance(i, j);
    return estimate;
  }

  [[nodiscard]] double fit(const perception::Scene& scene, const geometry::Pose2& pose) const {
    double sum = 0.0;
    for (const sensors::ScanPoint& point : scene.points) {
      const double off = field(pose * point.position) / sigma;
      sum += std::exp(-0.5 * off * off);
    }
    return sum / static_cast<double>(scene.points.size());
  }

  MrptParams params;
  double sigma;
  mrpt::maps::COccupancyGridMap2D::Ptr grid;
  localization::DistanceField field;
  BaselineMotion motion;
  mrpt::slam::CMonteCarloLocalization2D filter;
  double confidence = 1.0;
};

std::optional<MrptLocalizer> MrptLocalizer::create(const geometry::FloorPlan& plan, const sensors::Rig& rig,
                                                   const PoseEstimate& initial, const MrptParams& params) {
  return MrptLocalizer(std::make_unique<State>(plan, rig, initial, params));
}

localization::Localization MrptLocalizer::update(const perception::Scene& scene,
                                                 const std::optional<PoseEstimate>& motion) {
  state_->execute(state_->motion.step(motion, scene.time), scene);
  const PoseEstimate estimate = state_->mean();
  state_->motion.correct(estimate, scene.time);
  if (!scene.points.empty()) state_->confidence = state_->fit(scene, estimate.pose);
  localization::Localization fix = baseline_fix(scene.time, estimate, state_->confidence);
  fix.detected = fix.matched = static_cast<int>(scene.points.size());
  return fix;
}

#else

struct MrptLocalizer::State {};

std::optional<MrptLocalizer> MrptLocalizer::create(const geometry::FloorPlan&, const sensors::Rig&, const PoseEstimate&,
                                                   const MrptParams&) {
  return {};
}

localization::Localization MrptLocalizer::update(const perception::Scene&, const std::optional<PoseEstimate>&) {
  return {};
}

#endif

MrptLocalizer::MrptLocalizer(std::unique_ptr<State> state) : state_(std::move(state)) {}
MrptLocalizer::~MrptLocalizer() = default;
MrptLocalizer::MrptLocalizer(MrptLocalizer&&) noexcept = default;
MrptLocalizer& MrptLocalizer::operator=(MrptLocalizer&&) noexcept = default;

}  // namespace credo::evaluation
