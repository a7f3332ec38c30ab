// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <memory>

#include "perception/radial_lines.hpp"
#include "perception/scene.hpp"
#include "sensors/acquisition.hpp"

namespace credo::perception {

/// The paper's method with its absolute breakpoints, or the default with breakpoints in expected standard deviations.
enum class Method { kDefault, kPaper };

struct ObserverParams {  // the owner of this file completes it
  Method method = Method::kDefault;
  RadialLineParams radial_lines;
};

/// Acquisition -> Scene: radial lines, range segments, their fusion, five criteria, typed primitives with belief
/// (Clerentin et al., sec. 3).
class Observer {
 public:
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
