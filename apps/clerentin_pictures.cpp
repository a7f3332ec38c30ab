// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/clerentin_pictures.hpp"

#include <fmt/format.h>

#include <array>

#include "results/experiment_pictures.hpp"
#include "results/pictures.hpp"

namespace credo::apps {
namespace {

namespace colors = results::colors;
using results::NamedDrive;

constexpr std::array kPaperColors{colors::kOrange, colors::kRed, colors::kPurple};
constexpr std::array kDefaultColors{colors::kBlue, colors::kGreen, colors::kSky};

std::vector<NamedDrive> named(const ClerentinExperiment& experiment, bool paper) {
  const ClerentinRun& run = (paper ? experiment.paper : experiment.standard).front();
  std::vector<NamedDrive> drives;
  for (std::size_t w = 0; w < run.drives.size(); ++w) {
    drives.push_back({fmt::format("{}, {}", experiment.params.ways[w], paper ? "--method paper" : "default"),
                      (paper ? kPaperColors : kDefaultColors)[w % kPaperColors.size()], run.drives[w].history});
  }
  return drives;
}

void draw_life(const std::optional<LifeExample>& example, const char* what, const std::filesystem::path& file) {
  if (!example) return;
  const evaluation::TrackLife& life = example->life;
  const std::string title = fmt::format("{}: track {} of {}, seed {}", what, life.id, example->way, example->seed);
  results::write_png(file, results::track_life_picture(title, life.with_loss(), static_cast<int>(life.first) + 1,
                                                       life.lost_with.has_value()));
}

}  // namespace

void draw_pictures(const ClerentinExperiment& experiment, const std::filesystem::path& folder) {
  std::vector<NamedDrive> paper = named(experiment, true);
  const std::vector<NamedDrive> standard = named(experiment, false);
  results::write_png(folder / "positions_paper.png", results::positions_picture(experiment.plan, paper));
  results::write_png(folder / "positions_default.png", results::positions_picture(experiment.plan, standard));
  paper.insert(paper.end(), standard.begin(), standard.end());
  results::write_png(folder / "beliefs.png", results::beliefs_picture(paper));
  draw_life(life_of_an_edge(experiment.params, experiment.paper), "An edge", folder / "edge_life.png");
  draw_life(life_with_a_wall_between(experiment.params, experiment.paper), "A wall in between",
            folder / "wall_between.png");
}

}  // namespace credo::apps
