// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/bearing_agreement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace credo::localization {
namespace {

using Eigen::Vector2d;

constexpr int kHalf = 30;  ///< bins on either side of none
using Votes = std::array<int, 2 * kHalf + 1>;

/// Every radial line within reach of the bearing to a point votes for the turn between the two.
/// \param lines  by azimuth
void vote(const std::vector<perception::RadialLine>& lines, double bearing, double bin_rad, Votes& votes) {
  const double reach = (kHalf + 0.5) * bin_rad;
  // From -pi to pi the azimuths begin anew.
  for (const double shifted : {bearing - 2.0 * std::numbers::pi, bearing, bearing + 2.0 * std::numbers::pi}) {
    const auto first = std::lower_bound(lines.begin(), lines.end(), shifted - reach,
                                        [](const auto& line, double azimuth) { return line.azimuth < azimuth; });
    for (auto line = first; line != lines.end() && line->azimuth < shifted + reach; ++line) {
      const long turn = std::lround((line->azimuth - shifted) / bin_rad);
      if (std::abs(turn) <= kHalf) ++votes[static_cast<std::size_t>(kHalf + turn)];
    }
  }
}

/// Votes within `half` bins of one.
int around(const Votes& votes, int bin, int half) {
  int sum = 0;
  for (int i = std::max(0, bin - half); i <= std::min(2 * kHalf, bin + half); ++i)
    sum += votes[static_cast<std::size_t>(i)];
  return sum;
}

}  // namespace

std::optional<double> BearingAgreement::share(const BearingAgreementParams& params) const {
  if (at_pose + turned < params.least_votes) return {};
  return static_cast<double>(at_pose) / (at_pose + turned);
}

BearingAgreement compare_bearings(const perception::Scene& scene, const LandmarkMap& map,
                                  const geometry::Pose2& T_map_base, const BearingAgreementParams& params) {
  if (scene.radial_lines.empty()) return {};
  const double bin = params.turned_at_most_rad / kHalf;
  const int half = std::max(0, static_cast<int>(std::lround(params.agree_rad / bin)));
  const Vector2d viewpoint = T_map_base * scene.camera_origin;
  Votes votes{};
  for (const PointLandmark& point : map.points()) {
    const Vector2d way = point.position - viewpoint;
    const double range = way.norm();
    if (range < params.nearest_m || range > params.sight_m || !map.shows(viewpoint, point.position)) continue;
    vote(scene.radial_lines, geometry::wrap_angle(std::atan2(way.y(), way.x()) - T_map_base.theta), bin, votes);
  }
  BearingAgreement agreement{.at_pose = around(votes, kHalf, half), .turned = 0, .turn_rad = 0.0};
  for (int i = half; i <= 2 * kHalf - half; ++i) {
    const int here = around(votes, i, half);
    if (std::abs(i - kHalf) <= 2 * half || here <= agreement.turned) continue;
    agreement.turned = here;
    agreement.turn_rad = (i - kHalf) * bin;
  }
  return agreement;
}

}  // namespace credo::localization
