// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/misfit.hpp"

#include <algorithm>
#include <cassert>

namespace credo::localization {

Misfit::Misfit(const MisfitParams& params)
    : params_(params), all_{params.usual * params.usual_dofs, params.usual_dofs}, walls_(all_) {}

void Misfit::add(std::span<const Observation> observations, const PoseSolution& solution) {
  assert(observations.size() == solution.mahalanobis_squared.size());
  Sum all, walls;
  for (std::size_t k = 0; k < observations.size(); ++k) {
    const double square = std::min(params_.outlier, solution.mahalanobis_squared[k]);
    const int dofs = observations[k].dimension();
    all.squares += square;
    all.dofs += dofs;
    if (observations[k].kind != ObservationKind::kWall) continue;
    walls.squares += square;
    walls.dofs += dofs;
  }
  remember(all, all_);
  remember(walls, walls_);
}

double Misfit::factor_of(const Sum& sum) const {
  return std::max(params_.least, sum.squares / (sum.dofs * params_.usual));
}

void Misfit::remember(const Sum& latest, Sum& sum) const {
  if (latest.dofs == 0.0) return;  // it says nothing
  sum.squares = params_.memory * sum.squares + latest.squares;
  sum.dofs = params_.memory * sum.dofs + latest.dofs;
}

}  // namespace credo::localization
