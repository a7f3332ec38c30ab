// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/clerentin_experiment.hpp"

#include <cstdlib>
#include <stdexcept>
#include <utility>

#include "apps/about.hpp"
#include "apps/pipeline.hpp"
#include "apps/shipped.hpp"
#include "evaluation/localization_score.hpp"
#include "evaluation/played_drive.hpp"

namespace credo::apps {
namespace {

using evaluation::ReproducedDrive;
using perception::Method;

ReproducedDrive localize(const evaluation::PlayedDrive& played, Method method) {
  const datasets::DatasetHeader& header = played.dataset.header;
  if (!header.initial_pose)
    throw std::invalid_argument("the initial matching is given by hand: expected a known initial pose, found none");
  const PipelineParams params = PipelineParams::of(method);
  perception::Observer observer(header.rig, params.observer);
  localization::Localizer localizer(header.floor_plan.value(), header.rig, header.initial_pose, params.localizer);
  ReproducedDrive drive;
  for (sensors::Acquisition acquisition : played.acquisitions) {
    localizer.with_path(acquisition);
    const perception::Scene& scene = observer.observe(acquisition);
    const localization::Localization fix = localizer.update(scene, acquisition.motion);
    const std::optional<geometry::Pose2> truth = evaluation::truth_at(played.dataset.truth, fix.time);
    drive.see(scene);
    drive.matches += evaluation::check_matches(scene, localizer.observations(), localizer.solution(),
                                               localizer.landmark_beliefs(), localizer.map(), truth.value())
                         .total();
    drive.history.push_back({.localization = fix,
                             .tracks = results::sample(localizer.tracks()),
                             .mean_conflict = scene.mean_conflict,
                             .truth = truth});
  }
  return drive;
}

/// Applies `look` to each drive of each run, seed by seed, and keeps the life for which `better(life, best)` holds.
template <class Look, class Better>
std::optional<LifeExample> best_life(const ClerentinParams& params, const std::vector<ClerentinRun>& runs,
                                     const Look& look, const Better& better) {
  std::optional<LifeExample> best;
  for (std::size_t s = 0; s < runs.size(); ++s) {
    for (std::size_t w = 0; w < runs[s].drives.size(); ++w) {
      std::optional<evaluation::TrackLife> life = look(runs[s].drives[w].history);
      if (life && (!best || better(*life, best->life)))
        best = LifeExample{params.seed + s, params.ways[w], std::move(*life)};
    }
  }
  return best;
}

}  // namespace

ClerentinExperiment reproduce_clerentin(const ClerentinParams& params, const std::function<void(double)>& progress) {
  ClerentinExperiment experiment{params, {}, {}, {}};
  std::vector<sim::World> worlds;
  for (const std::string& way : params.ways) worlds.push_back(sim::load_world(find_shipped(way, kWorlds)));
  const double drives = static_cast<double>(worlds.size()) * params.seeds;
  double done = 0.0;
  for (int s = 0; s < params.seeds; ++s) {
    ClerentinRun paper, standard;
    for (const sim::World& world : worlds) {
      const std::uint64_t seed = params.seed + static_cast<std::uint64_t>(s);
      about("world " + world.name, [&] {
        const evaluation::PlayedDrive played =
            evaluation::play(world, seed, [&](double share) { progress((done + share) / drives); });
        if (done == 0.0) experiment.plan = played.dataset.header.floor_plan.value();
        paper.drives.push_back(localize(played, Method::kPaper));
        standard.drives.push_back(localize(played, Method::kDefault));
      });
      done += 1.0;
    }
    paper.figures = evaluation::reproduced_figures(paper.drives);
    standard.figures = evaluation::reproduced_figures(standard.drives);
    experiment.paper.push_back(std::move(paper));
    experiment.standard.push_back(std::move(standard));
  }
  return experiment;
}

std::optional<LifeExample> life_of_an_edge(const ClerentinParams& params, const std::vector<ClerentinRun>& runs) {
  const auto off = [](const evaluation::TrackLife& life) {
    return std::abs(life.sightings() - evaluation::kSightingsOfFigure21);
  };
  return best_life(
      params, runs, [](std::span<const results::Moment> history) { return evaluation::life_like_figure_21(history); },
      [&](const auto& life, const auto& best) { return off(life) < off(best); });
}

std::optional<LifeExample> life_with_a_wall_between(const ClerentinParams& params,
                                                    const std::vector<ClerentinRun>& runs) {
  return best_life(
      params, runs, [](std::span<const results::Moment> history) { return evaluation::life_like_figure_22(history); },
      [](const auto& life, const auto& best) { return life.samples.size() > best.samples.size(); });
}

}  // namespace credo::apps
