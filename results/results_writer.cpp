// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "results/results_writer.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <limits>

#include "datasets/map_server.hpp"
#include "datasets/trajectory.hpp"
#include "results/results_folder.hpp"

namespace credo::results {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::string tum_line(const localization::Localization& l) {
  const geometry::Pose2& pose = l.estimate.pose;
  return fmt::format("{} {:.6f} {:.6f} 0 0 0 {:.9f} {:.9f}\n", datasets::to_seconds(l.time), pose.x, pose.y,
                     std::sin(0.5 * pose.theta), std::cos(0.5 * pose.theta));
}

void append_hypotheses(std::string& table, const localization::Localization& l) {
  if (l.hypotheses.size() < 2) return;
  for (const localization::Hypothesis& h : l.hypotheses) {
    fmt::format_to(std::back_inserter(table), "{},{:.6f},{:.6f},{:.9f},{:.6f},{:.6f}\n", l.time, h.pose.x, h.pose.y,
                   h.pose.theta, h.belief, h.plausibility);
  }
}

void append_tracks(std::string& table, sensors::Timestamp time, std::span<const tracking::Track> tracks) {
  for (const tracking::Track& t : tracks) {
    fmt::format_to(std::back_inserter(table), "{},{},{},{:.9f},{:.6f},{:.6f},{:.6f},{},{},{:.9f}\n", time, t.id,
                   perception::to_string(t.type), t.azimuth, t.existence.yes, t.existence.no, t.existence.unknown,
                   tracking::to_string(t.state), t.landmark, t.sigma_azimuth);
  }
}

void append_primitives(std::string& table, const perception::Scene& scene) {
  for (std::size_t i = 0; i < scene.primitives.size(); ++i) {
    const perception::Primitive& p = scene.primitives[i];
    const bool placed = !p.bearing_only;
    fmt::format_to(std::back_inserter(table),
                   "{},{},{},{:.9f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.9f},{:.6f},{}\n", scene.time, i,
                   perception::to_string(p.type), p.azimuth, placed ? p.range_m : kNone,
                   placed ? p.position.x() : kNone, placed ? p.position.y() : kNone, p.existence.yes, p.existence.no,
                   p.existence.unknown, p.sigma_azimuth, p.conflict, p.endpoint_case);
  }
}

void append_radial_lines(std::string& table, const perception::Scene& scene) {
  for (const perception::RadialLine& line : scene.radial_lines) {
    fmt::format_to(std::back_inserter(table), "{},{:.9f},{:.9f},{:.3f},{}\n", scene.time, line.azimuth, line.sigma,
                   line.contrast, line.polarity);
  }
}

}  // namespace

struct ResultsWriter::State {
  State(const std::filesystem::path& target, bool replace) : folder(stage_results(target, replace)) {}

  datasets::StagedFolder folder;
  std::string trajectory;
  std::string localization{kLocalizationHeader};
  std::string hypotheses;
  std::string tracks = "#timestamp [ns],track,type,azimuth [rad],yes,no,unknown,state,landmark,sigma_azimuth [rad]\n";
  std::string primitives =
      "#timestamp [ns],index,type,azimuth [rad],range [m],x [m],y [m],yes,no,unknown,sigma_azimuth "
      "[rad],conflict,case\n";
  std::string radial_lines = "#timestamp [ns],azimuth [rad],sigma [rad],contrast,polarity\n";
};

ResultsWriter::ResultsWriter(const std::filesystem::path& target, bool replace)
    : state_(std::make_unique<State>(target, replace)) {}
ResultsWriter::~ResultsWriter() = default;
ResultsWriter::ResultsWriter(ResultsWriter&&) noexcept = default;
ResultsWriter& ResultsWriter::operator=(ResultsWriter&&) noexcept = default;

void ResultsWriter::add(const perception::Scene& scene, const localization::Localization& localization,
                        std::span<const tracking::Track> tracks) {
  state_->trajectory += tum_line(localization);
  state_->localization += to_line({.localization = localization});
  append_hypotheses(state_->hypotheses, localization);
  append_tracks(state_->tracks, localization.time, tracks);
  append_primitives(state_->primitives, scene);
  append_radial_lines(state_->radial_lines, scene);
}

bool ResultsWriter::add_map(const grids::EvidentialGrid& grid, const MapFolderParams& params) {
  return write_map_folder(grid, working_folder(), params);
}

void ResultsWriter::add_calibration(const std::string& yaml) {
  write_text(working_folder() / "calibration.yaml", yaml);
}

void ResultsWriter::add_config(const std::string& yaml) { write_text(working_folder() / "config.yaml", yaml); }

const std::filesystem::path& ResultsWriter::working_folder() const { return state_->folder.path(); }

void ResultsWriter::finish() {
  const std::filesystem::path& folder = working_folder();
  write_text(folder / "trajectory.tum", state_->trajectory);
  write_text(folder / "localization.csv", state_->localization);
  if (!state_->hypotheses.empty()) {
    write_text(folder / "hypotheses.csv", "#timestamp [ns],x,y,theta,bel,pl\n" + state_->hypotheses);
  }
  write_text(folder / "tracks.csv", state_->tracks);
  write_text(folder / "primitives.csv", state_->primitives);
  write_text(folder / "radial_lines.csv", state_->radial_lines);
  state_->folder.commit();
}

}  // namespace credo::results
