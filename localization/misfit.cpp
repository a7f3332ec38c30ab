// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/misfit.hpp"

#include <algorithm>
#include <cassert>

namespace credo::localization {

Misfit::Misfit(const MisfitParams& params)
    : params_(params), squares_(params.usual * params.usual_dofs), dofs_(params.usual_dofs) {}

void Misfit::add(std::span<const Observation> observations, const PoseSolution& solution) {
  assert(observations.size() == solution.mahalanobis_squared.size());
  if (observations.empty()) return;
  squares_ *= params_.memory;
  dofs_ *= params_.memory;
  for (std::size_t k = 0; k < observations.size(); ++k) {
    squares_ += std::min(solution.mahalanobis_squared[k], params_.outlier);
    dofs_ += observations[k].dimension();
  }
}

}  // namespace credo::localization
