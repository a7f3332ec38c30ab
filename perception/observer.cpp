// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/observer.hpp"

#include <algorithm>
#include <optional>

namespace credo::perception {

SceneParams SceneParams::paper() {
  SceneParams params;
  params.segmentation.split_m = 0.05;
  params.segmentation.merge_chi2 = 0.0;
  params.cooperation.agree_rad = 0.01745;
  params.criteria = CriteriaParams::paper();
  params.primitives = PrimitiveParams::paper();
  return params;
}

struct Observer::State {
  State(const sensors::Rig& rig, const ObserverParams& observer_params)
      : params(observer_params), scene_params(params.method == Method::kPaper ? params.paper : params.scene) {
    const CriteriaParams& shapes = scene_params.criteria;
    evidence::check(shapes.alignment, "criteria.alignment");
    evidence::check(shapes.support, "criteria.support");
    evidence::check(shapes.density, "criteria.density");
    evidence::check(shapes.gray, "criteria.gray");
    evidence::check(scene_params.primitives.line_support, "primitives.line_support");
    evidence::check(scene_params.primitives.line_contrast, "primitives.line_contrast");
    if (rig.camera) {
      extractor.emplace(*rig.camera, params.radial_lines);
      scene.camera_origin = rig.camera->T_base_camera.translation();
    }
    if (rig.odometry) odometry = *rig.odometry;
    if (!rig.range_finders.empty()) {
      range_finder = rig.range_finders.front();
      segmenter.emplace(*range_finder, scene_params.segmentation, params.line_fit);
      scene.points.reserve(static_cast<std::size_t>(std::max(0, range_finder->count)));
    }
    reserve();
  }

  void reserve();
  void look(const sensors::Acquisition& acquisition);
  void measure(const sensors::Acquisition& acquisition);

  ObserverParams params;
  SceneParams scene_params;
  std::optional<RadialLineExtractor> extractor;
  std::optional<sensors::RangeFinder> range_finder;
  const sensors::MotionPath rest;  // no motion at all
  sensors::OdometryNoise odometry{.translation_per_metre = 0.2, .rotation_per_metre = 0.2, .rotation_per_radian = 0.2};
  std::optional<Segmenter> segmenter;
  Scene scene;

  // Scratch.
  std::vector<RangeSegment> segments;
  Cooperation cooperation;
  FusedWholes wholes;
};

Observer::Observer(const sensors::Rig& rig, const ObserverParams& params)
    : state_(std::make_unique<State>(rig, params)) {}
Observer::~Observer() = default;
Observer::Observer(Observer&&) noexcept = default;
Observer& Observer::operator=(Observer&&) noexcept = default;

/// More than a scene has of anything, so that none but the first takes memory.
void Observer::State::reserve() {
  constexpr std::size_t kUsual = 512;
  segments.reserve(kUsual);
  cooperation.uses.reserve(kUsual);
  cooperation.ends.reserve(kUsual);
  cooperation.cuts.reserve(kUsual);
  wholes.existence.reserve(kUsual);
  wholes.cases.reserve(kUsual);
  wholes.first_part.reserve(kUsual);
  scene.segments.reserve(kUsual);
  scene.primitives.reserve(kUsual);
}

/// The camera's part.
void Observer::State::look(const sensors::Acquisition& acquisition) {
  scene.radial_lines.clear();
  scene.gray.values.clear();
  scene.camera_seen = false;
  scene.saturated_share = 0.0;
  if (extractor && acquisition.image) extractor->extract(*acquisition.image, scene);
}

/// The range finder's part. The paper's robot rests while it measures, and knows no motion that would carry a scan.
void Observer::State::measure(const sensors::Acquisition& acquisition) {
  scene.points.clear();
  scene.carry_covariance.setZero();
  segments.clear();
  if (segmenter && acquisition.scan) {
    const sensors::MotionPath& path = params.method == Method::kPaper ? rest : acquisition.path;
    sensors::carry_scan(*acquisition.scan, *range_finder, path, acquisition.time, scene.points);
    segmenter->segment(acquisition.scan->ranges_m, scene.points, segments);
    const auto [first, last] = std::minmax(acquisition.scan->time, acquisition.time);
    scene.carry_covariance = odometry.along(path, first, last).covariance;
  }
  scene.range_finder_seen = !scene.points.empty();
}

const Scene& Observer::observe(const sensors::Acquisition& acquisition) {
  State& s = *state_;
  const SceneParams& params = s.scene_params;
  s.scene.time = acquisition.time;
  s.look(acquisition);
  s.measure(acquisition);
  const double increment = s.segmenter ? s.segmenter->beam_increment() : 0.0;
  const PointNoise noise = s.segmenter ? s.segmenter->noise() : PointNoise{};
  cooperate(s.scene.radial_lines, s.scene.camera_origin, s.scene.points, increment, params.cooperation, s.segments,
            s.cooperation);
  fuse_segments(s.segments, s.cooperation, increment, noise, params.criteria, s.scene, s.wholes);
  name_primitives({s.segments, s.cooperation, s.wholes, increment}, params.primitives, s.scene);
  return s.scene;
}

}  // namespace credo::perception
