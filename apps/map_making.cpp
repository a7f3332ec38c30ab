// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/map_making.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>
#include <span>
#include <stdexcept>
#include <utility>

#include "apps/interrupt.hpp"
#include "apps/map_extent.hpp"
#include "apps/terminal.hpp"

namespace credo::apps {
namespace {

/// The ground that the two kinds of sensors see.
struct SeenGround {
  Eigen::AlignedBox2d by_scans, by_sweeps;
};

/// Of each part.
std::vector<SeenGround> seen_grounds(const MapOptions& o, const std::vector<MapPart>& parts) {
  std::vector<SeenGround> all;
  for (const MapPart& part : parts)
    all.push_back({seen_ground(part.path, part.rig, part.scans, {}, o.params),
                   seen_ground(part.path, part.rig, {}, part.sweeps, o.params)});
  return all;
}

void require_fits(const MapOptions& o, const std::vector<SeenGround>& seen) {
  Eigen::AlignedBox2d ground;
  for (const SeenGround& part : seen) ground.extend(part.by_scans).extend(part.by_sweeps);
  if (!o.large) require_map_fits(ground, o.params.mapper.georeference.resolution_m);
}

mapping::RuleMap build_by_rule(const MapOptions& o, const std::vector<MapPart>& parts) {
  if (parts.size() > 1)
    throw std::runtime_error(
        "--rule takes readings in one after the other, so they need poses of one frame: this log "
        "has some for each sensor; give them with --poses");
  Progress progress("mapping");
  const MapPart& part = parts.front();
  return mapping::map_along(part.path, part.rig, part.scans, part.sweeps, o.params, mapping::map_rule(o.rule).rule,
                            [&](double share) {
                              Interruptible::check();
                              progress.update(share);
                            });
}

/// Those that there are readings of, and what a map of each takes.
struct InstrumentsAtHand {
  std::size_t count = 0;
  double bytes = 0.0;  ///< if each sees all the ground that its kind does

  [[nodiscard]] bool several() const { return count > 1; }  ///< without them there is nobody to judge one by
  [[nodiscard]] bool fit() const { return bytes <= kMostInstrumentBytes; }
};

double tile_bytes(const Eigen::AlignedBox2d& ground, double resolution_m) {
  if (ground.isEmpty()) return 0.0;
  const Eigen::Array2d tiles = (ground.sizes().array() / (grids::Tile::kSide * resolution_m)).ceil() + 1.0;
  return tiles.prod() * sizeof(grids::Tile);
}

InstrumentsAtHand instruments_at_hand(const MapOptions& o, const std::vector<MapPart>& parts,
                                      const std::vector<SeenGround>& seen) {
  const double resolution_m = o.params.mapper.georeference.resolution_m;
  InstrumentsAtHand at_hand;
  const auto add = [&](std::size_t count, const Eigen::AlignedBox2d& ground) {
    at_hand.count += count;
    at_hand.bytes += static_cast<double>(count) * tile_bytes(ground, resolution_m);
  };
  for (std::size_t i = 0; i < parts.size(); ++i) {
    std::set<int> finders, rings;
    for (const sensors::RangeScan& scan : parts[i].scans) finders.insert(scan.sensor);
    for (const sensors::SonarSweep& sweep : parts[i].sweeps) rings.insert(sweep.sensor);
    add(finders.size(), seen[i].by_scans);
    for (const int ring : rings)
      add(parts[i].rig.sonar_rings.at(static_cast<std::size_t>(ring)).T_base_transducer.size(), seen[i].by_sweeps);
  }
  return at_hand;
}

std::string too_many_bytes(const InstrumentsAtHand& at_hand) {
  return fmt::format("the maps of the {} instruments, kept apart, may take {:.2f} GB, more than {:g} GB", at_hand.count,
                     1e-9 * at_hand.bytes, 1e-9 * kMostInstrumentBytes);
}

/// Calls work(part, report) for each part; report(share of it that is done).
template <typename Work>
void for_each_part(const std::vector<MapPart>& parts, const char* what, const Work& work) {
  Progress progress(what);
  for (std::size_t i = 0; i < parts.size(); ++i)
    work(parts[i], [&](double share) {
      Interruptible::check();
      progress.update((static_cast<double>(i) + share) / static_cast<double>(parts.size()));
    });
}

mapping::TrajectoryMap build_sum(const MapOptions& o, const std::vector<MapPart>& parts) {
  mapping::TrajectoryMap map{.grid = grids::EvidentialGrid(o.params.mapper.georeference), .counts = {}};
  for_each_part(parts, "mapping", [&](const MapPart& part, const auto& report) {
    mapping::TrajectoryMap one = mapping::map_along(part.path, part.rig, part.scans, part.sweeps, o.params, report);
    if (map.grid.tiles().empty())
      map.grid = std::move(one.grid);
    else
      map.grid.merge(one.grid);
    map.counts += one.counts;
    map.without_pose += one.without_pose;
  });
  return map;
}

/// The map, and what each instrument said of it, which is judged.
mapping::TrajectoryMap build_and_judge(const MapOptions& o, const std::vector<MapPart>& parts, const char* what,
                                       std::vector<mapping::InstrumentVerdict>& verdicts) {
  mapping::TrajectoryMap map{.grid = grids::EvidentialGrid(o.params.mapper.georeference), .counts = {}};
  std::vector<mapping::InstrumentMap> by_instrument;
  for_each_part(parts, what, [&](const MapPart& part, const auto& report) {
    mapping::InstrumentMaps one =
        mapping::map_by_instrument(part.path, part.rig, part.scans, part.sweeps, o.params, report);
    map.counts += one.counts;
    map.without_pose += one.without_pose;
    for (mapping::InstrumentMap& of : one.maps) {
      map.grid.merge(of.grid);
      by_instrument.push_back(std::move(of));
    }
  });
  verdicts = mapping::judge_instruments(by_instrument, map.grid);
  return map;
}

/// An instrument by its name: the numbers after it, in the order that they are in.
struct GivenReliability {
  std::string kind;
  std::vector<std::size_t> numbers;
  double share = 1.0;
};

[[noreturn]] void fail_given(const std::string& text, const std::string& why) {
  throw std::runtime_error("--reliability " + text + ": " + why +
                           "; expected judged, or NAME=SHARE with a share from 0 to 1 and a name as range, range/1, "
                           "sonar, sonar/0 (a ring), sonar/0/3 (its fourth transducer)");
}

GivenReliability parse_given(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) fail_given(text, "there is no '='");
  GivenReliability given;
  const std::string share = text.substr(equals + 1);
  const auto [end, error] = std::from_chars(share.data(), share.data() + share.size(), given.share);
  if (error != std::errc{} || end != share.data() + share.size() || !(given.share >= 0.0 && given.share <= 1.0))
    fail_given(text, "'" + share + "' is no share");
  std::string name = text.substr(0, equals);
  for (std::size_t slash = 0; (slash = name.rfind('/')) != std::string::npos; name.resize(slash)) {
    std::size_t number = 0;
    const char *from = name.data() + slash + 1, *to = name.data() + name.size();
    const auto [read, bad] = std::from_chars(from, to, number);
    if (bad != std::errc{} || read != to) fail_given(text, "'" + name.substr(slash + 1) + "' is no number");
    given.numbers.insert(given.numbers.begin(), number);
  }
  given.kind = name;
  if (name != "range" && name != "sonar") fail_given(text, "no instrument is called '" + name + "'");
  if (given.numbers.size() > (name == "range" ? 1U : 2U)) fail_given(text, "too many numbers");
  return given;
}

void set_range_finders(const GivenReliability& given, const std::string& text, std::vector<double>& shares) {
  if (shares.empty()) fail_given(text, "the data have no range finder");
  if (given.numbers.empty()) {
    std::ranges::fill(shares, given.share);
    return;
  }
  if (given.numbers[0] >= shares.size())
    fail_given(text, "the data have " + std::to_string(shares.size()) + " range finders, counted from 0");
  shares[given.numbers[0]] = given.share;
}

void set_transducers(const GivenReliability& given, const std::string& text, const sensors::Rig& rig,
                     std::vector<double>& shares) {
  if (shares.empty()) fail_given(text, "the data have no sonar");
  if (!given.numbers.empty() && given.numbers[0] >= rig.sonar_rings.size())
    fail_given(text, "the data have " + std::to_string(rig.sonar_rings.size()) + " sonar rings, counted from 0");
  std::size_t first = 0;
  for (std::size_t ring = 0; ring < rig.sonar_rings.size(); ++ring) {
    const std::size_t count = rig.sonar_rings[ring].T_base_transducer.size();
    const auto of_ring = std::span(shares).subspan(first, count);
    first += count;
    if (!given.numbers.empty() && given.numbers[0] != ring) continue;
    if (given.numbers.size() < 2) {
      std::ranges::fill(of_ring, given.share);
      continue;
    }
    if (given.numbers[1] >= count)
      fail_given(text, "this ring has " + std::to_string(count) + " transducers, counted from 0");
    of_ring[given.numbers[1]] = given.share;
  }
}

/// What comes later replaces what came before, so that one can be set apart from the rest of its kind.
mapping::SensorReliabilityParams given_reliabilities(const std::vector<std::string>& all, const sensors::Rig& rig) {
  mapping::SensorReliabilityParams params = mapping::reliabilities({}, rig);
  for (const std::string& text : all) {
    const GivenReliability given = parse_given(text);
    if (given.kind == "range")
      set_range_finders(given, text, params.range_finders);
    else
      set_transducers(given, text, rig, params.transducers);
  }
  return params;
}

void require_judgeable(const InstrumentsAtHand& at_hand) {
  if (!at_hand.several())
    throw std::runtime_error("--reliability judged: there is one instrument, and no other to judge it by");
  if (!at_hand.fit())
    throw std::runtime_error("--reliability judged: " + too_many_bytes(at_hand) +
                             ": choose a coarser --resolution, or give the reliabilities as NAME=SHARE");
}

bool wants_judged(const MapOptions& o) { return o.reliability == std::vector<std::string>{"judged"}; }

}  // namespace

void add_reliability_option(CLI::App& command, std::vector<std::string>& reliability) {
  command
      .add_option("--reliability", reliability,
                  "judged: each instrument counts as the others find it right; or as given, of all of a kind or of "
                  "one: range=0.9,sonar=0.6,sonar/0/3=0.1")
      ->delimiter(',');
}

const mapping::MappingCounts& MadeMap::counts() const {
  return std::visit([](const auto& made) -> const mapping::MappingCounts& { return made.counts; }, map);
}

std::int64_t MadeMap::without_pose() const {
  return std::visit([](const auto& made) { return made.without_pose; }, map);
}

grids::CellBox MadeMap::box() const {
  if (const auto* sum = std::get_if<mapping::TrajectoryMap>(&map)) return sum->grid.bounding_box();
  return std::get<mapping::RuleMap>(map).map.box;
}

MadeMap make_map(MapOptions& o, const std::vector<MapPart>& parts) {
  const std::vector<SeenGround> seen = seen_grounds(o, parts);
  require_fits(o, seen);
  const InstrumentsAtHand at_hand = instruments_at_hand(o, parts, seen);
  const sensors::Rig& rig = parts.front().rig;
  std::vector<mapping::InstrumentVerdict> verdicts;
  if (wants_judged(o)) {
    require_judgeable(at_hand);
    static_cast<void>(build_and_judge(o, parts, "judging", verdicts));
    o.params.mapper.sensors = mapping::reliabilities(verdicts, rig);
  } else if (!o.reliability.empty()) {
    o.params.mapper.sensors = given_reliabilities(o.reliability, rig);
  }
  if (!o.rule.empty()) return {build_by_rule(o, parts), verdicts};
  const bool judging = !wants_judged(o) && !o.large && at_hand.several();
  if (judging && !at_hand.fit())
    say_warning("the instruments are not judged by each other: " + too_many_bytes(at_hand) +
                "; a coarser --resolution needs less");
  if (!judging || !at_hand.fit()) return {build_sum(o, parts), verdicts};
  mapping::TrajectoryMap map = build_and_judge(o, parts, "mapping", verdicts);
  return {std::move(map), verdicts};
}

}  // namespace credo::apps
