// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <memory>

#include "perception/cooperation.hpp"
#include "perception/criteria.hpp"
#include "perception/line_fit.hpp"
#include "perception/primitives.hpp"
#include "perception/radial_lines.hpp"
#include "perception/scene.hpp"
#include "perception/segmentation.hpp"
#include "sensors/acquisition.hpp"

namespace credo::perception {

/// The paper's method with its absolute breakpoints, or the default with breakpoints in expected standard deviations.
enum class Method { kDefault, kPaper };

/// What the two methods differ in.
struct SceneParams {
  SegmentationParams segmentation;
  CooperationParams cooperation;
  CriteriaParams criteria;
  PrimitiveParams primitives;

  [[nodiscard]] static SceneParams paper();
};

struct ObserverParams {
  Method method = Method::kDefault;
  RadialLineParams radial_lines;
  LineFitParams line_fit;
  SceneParams scene;                         ///< used by Method::kDefault
  SceneParams paper = SceneParams::paper();  ///< used by Method::kPaper
};

/// Acquisition -> Scene: radial lines, range segments, their fusion, five criteria, typed primitives with belief
/// (Clerentin et al., sec. 3). A missing sensor leaves its part of the scene empty and its criteria vacuous.
class Observer {
 public:
  /// \throws std::invalid_argument for belief shapes that are none.
  explicit Observer(const sensors::Rig& rig, const ObserverParams& params = {});
  ~Observer();
  Observer(Observer&&) noexcept;
  Observer& operator=(Observer&&) noexcept;

  /// \returns a reference that stays valid until the next call; its vectors keep their memory.
  [[nodiscard]] const Scene& observe(const sensors::Acquisition& acquisition);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace credo::perception
