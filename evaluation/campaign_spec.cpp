// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/campaign_spec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "datasets/checked_yaml.hpp"
#include "datasets/nearest_word.hpp"
#include "sim/degradation.hpp"

namespace credo::evaluation {
namespace {

using datasets::CheckedMap;
using datasets::CheckedValue;

/// The texts of a list, none of them twice. `same` is what makes two of them the same.
template <typename Same>
std::vector<std::string> distinct_texts(const CheckedValue& list, const Same& same) {
  std::vector<std::string> texts;
  std::set<std::string> seen;
  for (const CheckedValue& item : list.items()) {
    texts.push_back(item.text());
    if (texts.back().empty()) item.fail("expected a name, found an empty text");
    if (!seen.insert(same(texts.back())).second)
      item.fail("'" + texts.back() + "' names the same runs as one above: expected each once");
  }
  if (texts.empty()) list.fail("expected at least one name, found an empty list");
  return texts;
}

std::string file_name(std::string text) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.';
  };
  std::replace_if(
      text.begin(), text.end(), [&](char c) { return !allowed(c); }, '_');
  return text;
}

/// What tells the files of one world's runs from those of another's.
std::string short_name(const std::string& world) {
  const std::filesystem::path path(world);
  return file_name(path.extension() == ".yaml" ? path.stem().string() : path.filename().string());
}

std::vector<std::string> read_worlds(const CheckedValue& list, const WorldComplaint& complaint_about) {
  std::vector<std::string> worlds = distinct_texts(list, short_name);
  if (!complaint_about) return worlds;
  for (const CheckedValue& item : list.items())
    if (const std::string complaint = complaint_about(item.text()); !complaint.empty()) item.fail(complaint);
  return worlds;
}

std::vector<std::string> read_degradations(const CheckedValue& list) {
  const std::vector<std::string>& known = sim::degradation_names();
  for (const CheckedValue& item : list.items()) {
    const std::string name = item.text();
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const auto nearest = datasets::nearest_word(name, known);
    item.fail("unknown degradation '" + name + "'" +
              (nearest ? "; did you mean '" + *nearest + "'?" : fmt::format("; known are {}", fmt::join(known, ", "))));
  }
  return distinct_texts(list, [](const std::string& name) { return name; });
}

void read_seeds(const CheckedValue& value, CampaignSpec& spec) {
  const CheckedMap seeds = value.map({"first", "count"});
  constexpr int kLargest = 1'000'000'000;
  if (const auto first = seeds.optional("first"))
    spec.first_seed = static_cast<std::uint64_t>(first->integer(0, kLargest));
  spec.seeds = seeds.required("count").integer(1, CampaignSpec::kMostRuns);
}

std::string quoted_list(const std::vector<std::string>& texts) {
  std::string list;
  for (const std::string& text : texts) {
    list += list.empty() ? "\"" : ", \"";
    for (const char c : text) {
      if (c == '"' || c == '\\') list += '\\';
      list += c;
    }
    list += '"';
  }
  return "[" + list + "]";
}

}  // namespace

CampaignSpec read_campaign(const std::filesystem::path& file, const WorldComplaint& complaint_about) {
  const CheckedMap keys = datasets::load_yaml(file).map({"format", "worlds", "seeds", "degradations", "method"});
  (void)keys.required("format").one_of({"credo-campaign/1"});
  CampaignSpec spec;
  spec.worlds = read_worlds(keys.required("worlds"), complaint_about);
  if (const auto seeds = keys.optional("seeds")) read_seeds(*seeds, spec);
  if (const auto degradations = keys.optional("degradations")) spec.degradations = read_degradations(*degradations);
  if (const auto method = keys.optional("method"))
    spec.method = method->one_of({"default", "paper"}) == 0 ? perception::Method::kDefault : perception::Method::kPaper;
  const std::size_t each = spec.worlds.size() * spec.degradations.size();
  if (each * static_cast<std::size_t>(spec.seeds) > CampaignSpec::kMostRuns)
    keys.fail(fmt::format("{} worlds x {} seeds x {} degradations are more than {} runs; expected fewer",
                          spec.worlds.size(), spec.seeds, spec.degradations.size(), CampaignSpec::kMostRuns));
  return spec;
}

std::string to_yaml(const CampaignSpec& spec) {
  return fmt::format(
      "format: credo-campaign/1\nworlds: {}\nseeds: {{first: {}, count: {}}}\ndegradations: [{}]\nmethod: {}\n",
      quoted_list(spec.worlds), spec.first_seed, spec.seeds, fmt::join(spec.degradations, ", "),
      spec.method == perception::Method::kPaper ? "paper" : "default");
}

std::vector<RunKey> runs_of(const CampaignSpec& spec) {
  std::vector<RunKey> runs;
  for (int i = 0; i < spec.seeds; ++i)
    for (const std::string& world : spec.worlds)
      for (const std::string& degradation : spec.degradations)
        runs.push_back({world, spec.first_seed + static_cast<std::uint64_t>(i), degradation});
  return runs;
}

std::string name_of(const RunKey& key) {
  return fmt::format("{}-{}-{}", short_name(key.world), key.seed, key.degradation);
}

}  // namespace credo::evaluation
