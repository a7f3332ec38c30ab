// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

// Belief functions, on one core, each beside the plain way to do the same. Goals: 5 ns per cell for a rule on two
// elements; 50 ns to match one prediction with 15 candidates; 100 us for PCR6 of 16 sources; the conjunctive rule on
// all subsets of 10 elements 50 times as fast as the double loop over them.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "evidence/binary_batch.hpp"
#include "evidence/binary_rules.hpp"
#include "evidence/conjunctive.hpp"
#include "evidence/moebius.hpp"
#include "evidence/open_world.hpp"
#include "evidence/proportional.hpp"

namespace {

using namespace credo::evidence;

class RandomMasses {
 public:
  BinaryMass next() {
    const double a = uniform(), b = uniform(), c = uniform(), sum = a + b + c;
    return {a / sum, b / sum, c / sum};
  }
  std::vector<BinaryMass> next(std::size_t count) {
    std::vector<BinaryMass> result;
    while (result.size() < count) result.push_back(next());
    return result;
  }
  // Masses on all subsets of `elements` but the empty one.
  std::vector<double> dense(std::size_t elements) {
    std::vector<double> result(std::size_t{1} << elements);
    double sum = 0.0;
    for (std::size_t bits = 1; bits < result.size(); ++bits) sum += result[bits] = uniform();
    for (double& mass : result) mass /= sum;
    return result;
  }

 private:
  double uniform() { return (static_cast<double>(random_()) + 1.0) / 0x1p32; }

  std::mt19937 random_{1};
};

// --- one map of cells, one reading ---------------------------------------------------------------------------------

constexpr std::size_t kCells = 4096;

template <typename Real>
struct Arrays {
  std::vector<Real> yes, no, unknown, conflict;

  Arrays() : conflict(kCells) {
    for (const BinaryMass& mass : RandomMasses().next(kCells)) {
      yes.push_back(static_cast<Real>(mass.yes));
      no.push_back(static_cast<Real>(mass.no));
      unknown.push_back(static_cast<Real>(mass.unknown));
    }
  }
  BinaryCells<Real> cells() { return {yes, no, unknown}; }
};

void in_nanoseconds_each(benchmark::State& state, std::size_t items) {
  const auto count = static_cast<double>(state.iterations()) * static_cast<double>(items);
  state.counters["each"] = benchmark::Counter(count, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

// The map is set back each time, so that masses do not run into denormal numbers; the copies are counted in.
template <typename Real, typename Update>
void cells(benchmark::State& state, Update update) {
  const Arrays<Real> before;
  Arrays<Real> map, reading;
  std::rotate(reading.yes.begin(), reading.yes.begin() + 7, reading.yes.end());
  std::rotate(reading.no.begin(), reading.no.begin() + 7, reading.no.end());
  std::rotate(reading.unknown.begin(), reading.unknown.begin() + 7, reading.unknown.end());
  for (auto _ : state) {
    map = before;
    update(map, reading);
    benchmark::DoNotOptimize(map.yes.data());
    benchmark::ClobberMemory();
  }
  in_nanoseconds_each(state, kCells);
}

template <typename Real>
void register_cells(const std::string& type) {
  using A = Arrays<Real>;
  const auto add = [&type](const std::string& rule, auto update) {
    benchmark::RegisterBenchmark(("cells_" + rule + "/" + type).c_str(), cells<Real, decltype(update)>, update);
  };
  add("copy_only", [](A&, A&) {});
  add("conjunctive", [](A& map, A& reading) { conjunctive(map.cells(), reading.cells(), map.conflict); });
  add("dempster", [](A& map, A& reading) { dempster(map.cells(), reading.cells()); });
  add("yager", [](A& map, A& reading) { conflict_to_ignorance(map.cells(), reading.cells()); });
  add("disjunctive", [](A& map, A& reading) { disjunctive(map.cells(), reading.cells()); });
  add("pcr2", [](A& map, A& reading) { pcr2(map.cells(), reading.cells()); });
  add("pcr5", [](A& map, A& reading) { pcr5(map.cells(), reading.cells()); });
  add("cautious", [](A& map, A& reading) { cautious(map.cells(), reading.cells(), map.conflict); });
  add("average", [](A& map, A& reading) { average(map.cells(), reading.cells()); });
  add("discount", [](A& map, A&) { discount(map.cells(), Real(0.9)); });
}

const bool cells_registered = (register_cells<float>("float"), register_cells<double>("double"), true);

// --- the same, a cell at a time, by a map from sets to masses ----------------------------------------------------

using SetMasses = std::map<std::set<std::string>, double>;

SetMasses by_sets(const BinaryMass& mass) {
  return {{{"YES"}, mass.yes}, {{"NO"}, mass.no}, {{"NO", "YES"}, mass.unknown}};
}

template <typename Key, typename Intersect>
std::map<Key, double> conjunction_of_maps(const std::map<Key, double>& a, const std::map<Key, double>& b,
                                          Intersect intersect) {
  std::map<Key, double> result;
  for (const auto& [set_a, mass_a] : a) {
    for (const auto& [set_b, mass_b] : b) result[intersect(set_a, set_b)] += mass_a * mass_b;
  }
  return result;
}

SetMasses dempster_of_maps(const SetMasses& a, const SetMasses& b) {
  SetMasses result = conjunction_of_maps(a, b, [](const auto& x, const auto& y) {
    std::set<std::string> both;
    std::ranges::set_intersection(x, y, std::inserter(both, both.end()));
    return both;
  });
  const double kept = 1.0 - result[{}];
  result.erase(std::set<std::string>{});
  for (auto& [set, mass] : result) mass /= kept;
  return result;
}

void one_cell_dempster_std_map(benchmark::State& state) {
  const SetMasses a = by_sets({.6, .3, .1}), b = by_sets({.2, .7, .1});
  for (auto _ : state) benchmark::DoNotOptimize(dempster_of_maps(a, b));
  in_nanoseconds_each(state, 1);
}
BENCHMARK(one_cell_dempster_std_map);

void one_cell_dempster_general(benchmark::State& state) {
  const Frame frame = Frame::shafer({"YES", "NO"});
  const std::vector<MassFunction> sources{from_binary(frame, {.6, .3, .1}), from_binary(frame, {.2, .7, .1})};
  for (auto _ : state) benchmark::DoNotOptimize(dempster(sources));
  in_nanoseconds_each(state, 1);
}
BENCHMARK(one_cell_dempster_general);

void one_cell_dempster_closed(benchmark::State& state) {
  std::vector<BinaryMass> sources{{.6, .3, .1}, {.2, .7, .1}};
  for (auto _ : state) {
    benchmark::DoNotOptimize(sources.data());
    benchmark::DoNotOptimize(dempster(sources));
  }
  in_nanoseconds_each(state, 1);
}
BENCHMARK(one_cell_dempster_closed);

// --- PCR6 of many sources ------------------------------------------------------------------------------------------

void pcr6_quadrature(benchmark::State& state) {
  const std::vector<BinaryMass> sources = RandomMasses().next(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(pcr6(sources));
}
BENCHMARK(pcr6_quadrature)->Arg(2)->Arg(3)->Arg(8)->Arg(16)->Arg(64)->Unit(benchmark::kMicrosecond);

void pcr6_plus_quadrature(benchmark::State& state) {
  const std::vector<BinaryMass> sources = RandomMasses().next(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(pcr6_plus(sources));
}
BENCHMARK(pcr6_plus_quadrature)->Arg(16)->Unit(benchmark::kMicrosecond);

void pcr5_by_products(benchmark::State& state) {
  const std::vector<BinaryMass> sources = RandomMasses().next(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(pcr5(sources));
}
BENCHMARK(pcr5_by_products)->Arg(3)->Arg(8)->Arg(12)->Unit(benchmark::kMicrosecond);

void pcr6_general(benchmark::State& state) {
  const Frame frame = Frame::shafer({"YES", "NO"});
  std::vector<MassFunction> sources;
  for (const BinaryMass& mass : RandomMasses().next(static_cast<std::size_t>(state.range(0)))) {
    sources.push_back(from_binary(frame, mass));
  }
  for (auto _ : state) benchmark::DoNotOptimize(pcr6(sources));
}
BENCHMARK(pcr6_general)->Arg(2)->Arg(3)->Arg(8)->Arg(12)->Unit(benchmark::kMicrosecond);

// --- one prediction against candidates in the open world ------------------------------------------------------------

void association_closed(benchmark::State& state) {
  const std::vector<BinaryMass> evidence = RandomMasses().next(static_cast<std::size_t>(state.range(0)));
  OpenWorldMatcher matcher;
  matcher.reserve(evidence.size());
  for (auto _ : state) {
    matcher.combine(evidence);
    benchmark::DoNotOptimize(matcher.normalised().none);
    benchmark::ClobberMemory();
  }
}
BENCHMARK(association_closed)->Arg(5)->Arg(10)->Arg(15);

void association_pignistic(benchmark::State& state) {
  const std::vector<BinaryMass> evidence = RandomMasses().next(static_cast<std::size_t>(state.range(0)));
  OpenWorldMatcher matcher;
  matcher.reserve(evidence.size());
  for (auto _ : state) {
    matcher.combine(evidence);
    benchmark::DoNotOptimize(matcher.decide_by_pignistic());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(association_pignistic)->Arg(5)->Arg(10)->Arg(15);

// Candidate i against all others and *: the frame has one element more than there are candidates.
void association_general(benchmark::State& state) {
  const auto count = static_cast<std::size_t>(state.range(0));
  std::vector<std::string> names{"none"};
  for (std::size_t i = 0; i < count; ++i) names.push_back("P" + std::to_string(i));
  const Frame frame = Frame::shafer(names);
  std::vector<MassFunction> sources;
  for (const BinaryMass& mass : RandomMasses().next(count)) {
    const Proposition match = frame.element(sources.size() + 1);
    const Focal focals[] = {{match, mass.yes}, {frame.all() - match, mass.no}, {frame.all(), mass.unknown}};
    sources.emplace_back(frame, focals);
  }
  for (auto _ : state) benchmark::DoNotOptimize(dempster(sources));
}
BENCHMARK(association_general)->Arg(5)->Arg(10)->Arg(15);

// --- the conjunctive rule with mass on all subsets of n elements -----------------------------------------------------

Frame letters(std::size_t count) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i) names.emplace_back(1, static_cast<char>('A' + i));
  return Frame::shafer(names);
}

void dense_conjunctive(benchmark::State& state) {
  const auto elements = static_cast<std::size_t>(state.range(0));
  const Frame frame = letters(elements);
  RandomMasses random;
  const std::vector<MassFunction> sources{from_dense(frame, random.dense(elements)),
                                          from_dense(frame, random.dense(elements))};
  for (auto _ : state) benchmark::DoNotOptimize(conjunctive(sources));
}
BENCHMARK(dense_conjunctive)->Arg(10)->Unit(benchmark::kMicrosecond);

void dense_conjunctive_transforms_alone(benchmark::State& state) {
  const auto elements = static_cast<std::size_t>(state.range(0));
  RandomMasses random;
  const std::vector<double> a = random.dense(elements), b = random.dense(elements);
  for (auto _ : state) {
    std::vector<double> product = a, other = b;
    mass_to_commonality(product);
    mass_to_commonality(other);
    for (std::size_t i = 0; i < product.size(); ++i) product[i] *= other[i];
    commonality_to_mass(product);
    benchmark::DoNotOptimize(product.data());
  }
}
BENCHMARK(dense_conjunctive_transforms_alone)->Arg(10)->Unit(benchmark::kMicrosecond);

void dense_conjunctive_double_loop(benchmark::State& state) {
  const auto elements = static_cast<std::size_t>(state.range(0));
  RandomMasses random;
  const std::vector<double> a = random.dense(elements), b = random.dense(elements);
  for (auto _ : state) {
    std::vector<double> result(a.size());
    for (std::size_t x = 0; x < a.size(); ++x) {
      for (std::size_t y = 0; y < b.size(); ++y) result[x & y] += a[x] * b[y];
    }
    benchmark::DoNotOptimize(result.data());
  }
}
BENCHMARK(dense_conjunctive_double_loop)->Arg(10)->Unit(benchmark::kMicrosecond);

void dense_conjunctive_std_map(benchmark::State& state) {
  const auto elements = static_cast<std::size_t>(state.range(0));
  RandomMasses random;
  std::map<unsigned, double> a, b;
  for (std::map<unsigned, double>* each : {&a, &b}) {
    const std::vector<double> dense = random.dense(elements);
    for (unsigned bits = 1; bits < dense.size(); ++bits) (*each)[bits] = dense[bits];
  }
  for (auto _ : state) {
    benchmark::DoNotOptimize(conjunction_of_maps(a, b, [](unsigned x, unsigned y) { return x & y; }));
  }
}
BENCHMARK(dense_conjunctive_std_map)->Arg(10)->Unit(benchmark::kMicrosecond);

}  // namespace
