// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <stdexcept>
#include <string>

#include "localization/localizer.hpp"

namespace credo::localization {

LocalizerParams LocalizerParams::with_method(perception::Method chosen) const {
  LocalizerParams params = *this;
  params.method = params.tracker.method = params.belief.method = chosen;
  params.fit.method = params.fit.matching.method = params.fit.evidence.method = chosen;
  params.map.cut_walls_at_points = chosen == perception::Method::kPaper;
  return params;
}

void check(const LocalizerParams& params) {
  const auto require = [](bool good, const char* what) {
    if (!good) throw std::invalid_argument(std::string("localizer: ") + what);
  };
  const MapMatchingParams& m = params.fit.matching;
  evidence::check(m.wall_angle, "localizer: fit.matching.wall_angle");
  evidence::check(m.wall_across, "localizer: fit.matching.wall_across");
  evidence::check(m.wall_excess, "localizer: fit.matching.wall_excess");
  evidence::check(m.point_range, "localizer: fit.matching.point_range");
  evidence::check(m.point_azimuth, "localizer: fit.matching.point_azimuth");
  evidence::check(m.paper_wall_angle_deg, "localizer: fit.matching.paper_wall_angle_deg");
  evidence::check(m.paper_wall_length_m, "localizer: fit.matching.paper_wall_length_m");
  evidence::check(m.paper_wall_center_m, "localizer: fit.matching.paper_wall_center_m");
  evidence::check(m.paper_point_range_m, "localizer: fit.matching.paper_point_range_m");
  evidence::check(m.paper_point_azimuth_deg, "localizer: fit.matching.paper_point_azimuth_deg");
  evidence::check(params.belief.count, "localizer: belief.count");
  evidence::check(params.belief.ratio, "localizer: belief.ratio");
  evidence::check(params.belief.recognised, "localizer: belief.recognised");
  evidence::check(params.belief.scan_agreement, "localizer: belief.scan_agreement");
  evidence::check(params.belief.bearings, "localizer: belief.bearings");
  evidence::check(params.belief.separation, "localizer: belief.separation");
  require(params.fit.matching_rounds >= 1, "fit.matching_rounds has to be at least 1");
  require(params.fit.solver.robust_scale > 0.0, "fit.solver.robust_scale has to be positive");
  require(params.fit.solver.reweightings >= 1, "fit.solver.reweightings has to be at least 1");
  require(params.fit.solver.outlier_probability > 0.0 && params.fit.solver.outlier_probability < 1.0,
          "fit.solver.outlier_probability has to be in (0, 1)");
  const ScanAgreementParams& scan = params.fit.scan;
  require(scan.most_points >= 1 && scan.least_points >= 1,
          "fit.scan.most_points and fit.scan.least_points have to be positive");
  require(scan.on_plan_m > 0.0 && scan.on_plan_sigmas >= 0.0 && scan.before_weight >= 0.0,
          "fit.scan: the tolerance has to be positive, its other numbers may not be negative");
  require(scan.search_step_m >= 0.01 && scan.search_step_rad >= 0.002 && scan.search_at_most_m <= 10.0 &&
              scan.search_at_most_rad <= 3.2,
          "fit.scan: a search has steps of at least 0.01 m and 0.002 rad and reaches 10 m and half a turn at most");
  for (const double reliability :
       {params.trust.unchecked_reliability, params.belief.wall_reliability, params.belief.other_reliability,
        params.trust.contradiction_reliability, params.trust.blind_reliability})
    require(reliability >= 0.0 && reliability <= 1.0, "a reliability has to be in [0, 1]");
}

}  // namespace credo::localization
