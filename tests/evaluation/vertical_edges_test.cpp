// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

// The radial lines of a simulated drive against the edges that are truly there: camera and simulator together.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "perception/radial_lines.hpp"
#include "sim/simulation.hpp"

namespace credo {
namespace {

/// Detections against true edges, by azimuth. [deg]
struct EdgeScore {
  std::vector<double> errors;  ///< of the hits
  int expected = 0;            ///< true edges that have to be found
  int found = 0;               ///< of them: a line is within kHit_deg
  int found_alone = 0;         ///< of them: a line that is no nearer edge's too
  int detected = 0;
  int unmatched = 0;  ///< detections without any true edge

  [[nodiscard]] double median_error() {
    std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2), errors.end());
    return errors[errors.size() / 2];
  }
  [[nodiscard]] double recall() const { return static_cast<double>(found) / expected; }
  [[nodiscard]] double recall_one_to_one() const { return static_cast<double>(found_alone) / expected; }
  [[nodiscard]] double unmatched_share() const { return static_cast<double>(unmatched) / detected; }
};

constexpr double kHit_deg = 1.0;
constexpr double kMinVisibleShare = 0.3;
constexpr double kMinContrast = 10.0;

/// Errors are those of a one-to-one match: each true edge takes the nearest line that no nearer edge has taken.
void score_image(const std::vector<perception::RadialLine>& lines, double camera_yaw,
                 std::span<const sim::TrueVertical> truth, EdgeScore& score) {
  struct Pair {
    double error;
    std::size_t edge, line;
  };
  std::vector<Pair> pairs;
  for (std::size_t e = 0; e < truth.size(); ++e)
    for (std::size_t l = 0; l < lines.size(); ++l) {
      const double error = geometry::to_degrees(
          std::abs(geometry::angle_difference(lines[l].azimuth - camera_yaw, truth[e].azimuth_rad)));
      if (error <= kHit_deg) pairs.push_back({error, e, l});
    }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.error < b.error; });
  std::vector<bool> edge_taken(truth.size(), false), line_taken(lines.size(), false);
  for (const Pair& pair : pairs) {
    if (edge_taken[pair.edge] || line_taken[pair.line]) continue;
    edge_taken[pair.edge] = line_taken[pair.line] = true;
    const sim::TrueVertical& edge = truth[pair.edge];
    if (edge.visible_share < kMinVisibleShare || edge.contrast < kMinContrast) continue;
    score.errors.push_back(pair.error);
    ++score.found_alone;
  }
  for (std::size_t e = 0; e < truth.size(); ++e) {
    if (truth[e].visible_share < kMinVisibleShare || truth[e].contrast < kMinContrast) continue;
    ++score.expected;
    score.found += std::any_of(pairs.begin(), pairs.end(), [e](const Pair& pair) { return pair.edge == e; }) ? 1 : 0;
  }
  score.detected += static_cast<int>(lines.size());
  score.unmatched += static_cast<int>(std::count(line_taken.begin(), line_taken.end(), false));
}

TEST(VerticalEdges, OfTheOfficeAreFoundAndNotInvented) {
  const sim::Simulation simulation(sim::load_world(CREDO_SOURCE_DIR "/sim/worlds/office.yaml"), 1);
  perception::RadialLineExtractor extractor(*simulation.rig().camera);
  const double camera_yaw = simulation.rig().camera->T_base_camera.theta;
  perception::Scene scene;
  EdgeScore score;
  sim::Sink sink;
  sink.image = [&](const sensors::OmniImage& image) { extractor.extract(image, scene); };
  sink.verticals = [&](sensors::Timestamp, std::span<const sim::TrueVertical> truth) {
    score_image(scene.radial_lines, camera_yaw, truth, score);
  };
  simulation.run(sink, 2);
  ASSERT_GT(score.expected, 500);
  std::printf(
      "vertical edges: median error %.3f deg, recall %.3f (one to one %.3f), unmatched %.3f (%d edges, %d lines)\n",
      score.median_error(), score.recall(), score.recall_one_to_one(), score.unmatched_share(), score.expected,
      score.detected);
  EXPECT_LE(score.median_error(), 0.15);
  EXPECT_GE(score.recall(), 0.8);
  EXPECT_GE(score.recall_one_to_one(), 0.7) << "the shelf's edges are less than two pixels apart";
  EXPECT_LE(score.unmatched_share(), 0.15);
}

}  // namespace
}  // namespace credo
