// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "apps/evaluate.hpp"
#include "apps/gates.hpp"
#include "apps/option_checks.hpp"
#include "apps/output.hpp"
#include "apps/terminal.hpp"
#include "evaluation/pose_error.hpp"

namespace credo::apps {
namespace {

using evaluation::PoseRelation;
using nlohmann::ordered_json;

const std::map<std::string, PoseRelation> kRelations{{"trans_part", PoseRelation::kTranslationPart},
                                                     {"rot_part", PoseRelation::kRotationPart},
                                                     {"angle_deg", PoseRelation::kAngleDegrees},
                                                     {"angle_rad", PoseRelation::kAngleRadians},
                                                     {"full", PoseRelation::kFull},
                                                     {"point_distance", PoseRelation::kPointDistance}};
const std::map<std::string, evaluation::DeltaUnit> kUnits{{"f", evaluation::DeltaUnit::kFrames},
                                                          {"m", evaluation::DeltaUnit::kMetres},
                                                          {"d", evaluation::DeltaUnit::kDegrees},
                                                          {"r", evaluation::DeltaUnit::kRadians}};

constexpr double kLeastDelta = 1e-6;  // of whatever unit

struct PairOptions {
  std::string reference, result, relation = "trans_part";
  evaluation::AssociationParams association;
  evaluation::AlignmentParams alignment;
  Gates gates;
  OutputFormat format;
};

struct RpeOptions : PairOptions {
  std::string unit = "f";
  evaluation::RelativeErrorParams params;
};

std::vector<GatedValue> figures(const evaluation::Statistics& s) {
  return {{"max", s.max},   {"mean", s.mean}, {"median", s.median}, {"min", s.min},
          {"rmse", s.rmse}, {"sse", s.sse},   {"std", s.std}};
}

void add_pair_options(CLI::App& command, PairOptions& o) {
  command.add_option("REF", o.reference, "the truth: TUM, KITTI, EuRoC csv, or a dataset folder")
      ->check(a_path())
      ->required();
  command.add_option("RESULT", o.result, "the estimate: the same, or a results folder")->check(a_path())->required();
  command.add_option("-r,--pose_relation", o.relation, "what of the error pose counts")
      ->check(CLI::IsMember(kRelations))
      ->capture_default_str();
  command.add_flag("-a,--align", o.alignment.align, "Umeyama alignment (in the plane, where the data are planar)");
  command.add_flag("-s,--correct_scale", o.alignment.correct_scale, "correct the scale, too");
  command.add_flag("--align_origin", o.alignment.align_origin, "make the first poses agree");
  command.add_option("--n_to_align", o.alignment.n_to_align, "poses for the alignment; -1: all")
      ->check(number_in(-1, std::numeric_limits<int>::max()))
      ->capture_default_str();
  command.add_option("--t_max_diff", o.association.t_max_diff_s, "largest difference in time of a match [s]")
      ->check(number_in(0.0, evaluation::AssociationParams::kLargest_s))
      ->capture_default_str();
  command.add_option("--t_offset", o.association.t_offset_s, "added to the times of the result [s]")
      ->check(number_in(-evaluation::AssociationParams::kLargest_s, evaluation::AssociationParams::kLargest_s))
      ->capture_default_str();
  command.add_flag("--interpolate", o.association.interpolate, "interpolate the reference to the times of the result");
  add_fail_above(command, o.gates, {"max", "mean", "median", "min", "rmse", "sse", "std"}, "rmse=0.1");
  add_format_option(command, o.format);
}

/// A number of seconds as evo prints it: 0.0, 0.01.
std::string seconds(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.12g", value);
  const std::string shortest = text;
  return shortest.find_first_of(".e") == std::string::npos ? shortest + ".0" : shortest;
}

std::string matching_text(const evaluation::AssociatedPair& pair, const PairOptions& o) {
  return "Found " + std::to_string(pair.estimate.poses.size()) + " of max. " + std::to_string(pair.possible) +
         " possible matching timestamps between...\n\t" + o.reference + "\nand:\t" + o.result +
         "\n..with max. time diff.: " + seconds(o.association.t_max_diff_s) +
         " (s) and time offset: " + seconds(o.association.t_offset_s) + " (s).\n";
}

void report(const PairOptions& o, const evaluation::AssociatedPair& pair, const evaluation::PoseErrors& errors) {
  const std::size_t matched = pair.estimate.poses.size();
  if (2 * matched < static_cast<std::size_t>(pair.possible)) {
    say_warning("matched " + std::to_string(matched) + " of " + std::to_string(pair.possible) +
                " poses only: check --t_max_diff and --t_offset");
  }
  if (o.format.json()) {
    ordered_json statistics;
    for (const GatedValue& figure : figures(errors.statistics)) statistics[figure.name] = *figure.value;
    print(ordered_json{{"title", errors.title + "\n" + evaluation::describe(o.alignment)},
                       {"reference", o.reference},
                       {"result", o.result},
                       {"matched", matched},
                       {"possible", pair.possible},
                       {"statistics", statistics},
                       {"times_ns", errors.times},
                       {"errors", errors.errors}});
  } else {
    std::printf("%s\n%s", matching_text(pair, o).c_str(), evaluation::to_text(errors, o.alignment).c_str());
  }
  require_passed(o.gates, figures(errors.statistics));
}

evaluation::AssociatedPair associated(const PairOptions& o) {
  evaluation::AssociatedPair pair = evaluation::associate(evaluation::read_trajectory(o.reference),
                                                          evaluation::read_trajectory(o.result), o.association);
  evaluation::align(pair, o.alignment);
  return pair;
}

void add_ape(CLI::App& evaluate) {
  CLI::App* command = evaluate.add_subcommand("ape", "Absolute pose error.");
  command->footer(
      "  credo evaluate ape datasets/office results/office\n"
      "  credo evaluate ape truth.tum estimate.tum -r angle_deg\n"
      "  credo evaluate ape truth.tum slam.tum --align --fail_above rmse=0.1");
  auto o = std::make_shared<PairOptions>();
  add_pair_options(*command, *o);
  command->callback([o] {
    const auto pair = associated(*o);
    report(*o, pair, evaluation::absolute_pose_error(pair, kRelations.at(o->relation)));
  });
}

void add_rpe(CLI::App& evaluate) {
  CLI::App* command = evaluate.add_subcommand("rpe", "Relative pose error: the drift over a distance.");
  command->footer(
      "  credo evaluate rpe datasets/office results/office\n"
      "  credo evaluate rpe datasets/office results/office -d 5 -u m --all_pairs");
  auto o = std::make_shared<RpeOptions>();
  add_pair_options(*command, *o);
  command->add_option("-d,--delta", o->params.delta, "distance of the two poses of a pair")
      ->check(number_in(kLeastDelta, evaluation::RelativeErrorParams::kLargestDelta))
      ->capture_default_str();
  command->add_option("-u,--delta_unit", o->unit, "frames, metres, degrees or radians")
      ->check(CLI::IsMember(kUnits))
      ->capture_default_str();
  command->add_option("-t,--delta_tol", o->params.relative_tolerance, "of delta, with --all_pairs")
      ->check(number_in(0.0, 1.0))
      ->capture_default_str();
  command->add_flag("--all_pairs", o->params.all_pairs, "every start, not only pairs that follow each other");
  command->add_flag("--pairs_from_reference", o->params.pairs_from_reference, "choose the pairs on the reference");
  command->callback([o] {
    const auto pair = associated(*o);
    o->params.relation = kRelations.at(o->relation);
    o->params.unit = kUnits.at(o->unit);
    report(*o, pair, evaluation::relative_pose_error(pair, o->params));
  });
}

struct TrajOptions {
  std::vector<std::string> paths;
  std::string reference;
  evaluation::AssociationParams association;
  OutputFormat format;
};

ordered_json describe(const evaluation::Trajectory& trajectory) {
  const evaluation::TrajectoryFacts f = evaluation::facts(trajectory);
  return {{"name", trajectory.name},
          {"poses", f.poses},
          {"length_m", f.length_m},
          {"duration_s", f.duration_s},
          {"planar", evaluation::is_planar(trajectory)},
          {"times_going_back", f.times_going_back},
          {"equal_times", f.equal_times},
          {"longest_gap_s", f.longest_gap_s}};
}

void run_traj(const TrajOptions& o) {
  ordered_json all = ordered_json::array();
  for (const std::string& path : o.paths) {
    const evaluation::Trajectory trajectory = evaluation::read_trajectory(path);
    all.push_back(describe(trajectory));
    if (o.reference.empty()) continue;
    const auto pair = evaluation::associate(evaluation::read_trajectory(o.reference), trajectory, o.association);
    const auto errors = evaluation::absolute_pose_error(pair, PoseRelation::kTranslationPart);
    all.back()["matched_with_reference"] = pair.estimate.poses.size();
    all.back()["ape_rmse_m"] = errors.statistics.rmse;
  }
  if (o.format.json()) {
    print(all);
    return;
  }
  for (const ordered_json& t : all) {
    std::printf("%s: %d poses, %.3f m, %.3f s, %s", t["name"].get<std::string>().c_str(), t["poses"].get<int>(),
                t["length_m"].get<double>(), t["duration_s"].get<double>(),
                t["planar"].get<bool>() ? "planar" : "spatial");
    if (t.contains("ape_rmse_m")) {
      std::printf(", matched %d, APE rmse %.6f m", t["matched_with_reference"].get<int>(),
                  t["ape_rmse_m"].get<double>());
    }
    const int back = t["times_going_back"].get<int>(), equal = t["equal_times"].get<int>();
    std::printf("\n  longest gap %.3f s; %s\n", t["longest_gap_s"].get<double>(),
                back + equal == 0
                    ? "times grow"
                    : (std::to_string(back) + " times go back, " + std::to_string(equal) + " are equal").c_str());
  }
}

void add_traj(CLI::App& evaluate) {
  CLI::App* command = evaluate.add_subcommand("traj", "Length, duration and checks of trajectories.");
  command->footer("  credo evaluate traj results/a results/b --ref datasets/office");
  auto o = std::make_shared<TrajOptions>();
  command->add_option("PATHS", o->paths, "trajectories, dataset or results folders")->check(a_path())->required();
  command->add_option("--ref", o->reference, "a reference to compare each with")->check(a_path());
  command->add_option("--t_max_diff", o->association.t_max_diff_s, "largest difference in time of a match [s]")
      ->check(number_in(0.0, evaluation::AssociationParams::kLargest_s))
      ->capture_default_str();
  add_format_option(*command, o->format);
  command->callback([o] { run_traj(*o); });
}

}  // namespace

void add_evaluate_trajectories(CLI::App& evaluate) {
  add_ape(evaluate);
  add_rpe(evaluate);
  add_traj(evaluate);
}

}  // namespace credo::apps
