// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/successive_shortest_path_nonnegative_weights.hpp>
#include <cmath>
#include <cstdint>
#include <vector>

#include "tracking/assignment.hpp"

// Min-cost flow, not maximum_weighted_matching: that one gives wrong answers, or none at all, on some graphs
// (boostorg/graph issues 199, 223 and 399).

namespace credo::tracking {
namespace {

using Traits = boost::adjacency_list_traits<boost::vecS, boost::vecS, boost::directedS>;
using EdgeProperties =
    boost::property<boost::edge_capacity_t, std::int64_t,
                    boost::property<boost::edge_residual_capacity_t, std::int64_t,
                                    boost::property<boost::edge_reverse_t, Traits::edge_descriptor,
                                                    boost::property<boost::edge_weight_t, std::int64_t>>>>;
using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS, boost::no_property, EdgeProperties>;

// Weights as integers: Dijkstra on reduced costs needs exact sums.
constexpr double kSteps = 1 << 30;

void add_unit_edge(Graph& graph, std::size_t from, std::size_t to, std::int64_t cost) {
  const auto forth = boost::add_edge(from, to, graph).first;
  const auto back = boost::add_edge(to, from, graph).first;
  boost::put(boost::edge_capacity, graph, forth, 1);
  boost::put(boost::edge_capacity, graph, back, 0);
  boost::put(boost::edge_weight, graph, forth, cost);
  boost::put(boost::edge_weight, graph, back, -cost);
  boost::put(boost::edge_reverse, graph, forth, back);
  boost::put(boost::edge_reverse, graph, back, forth);
}

std::vector<int> sorted_unique(std::span<const Candidate> candidates, int Candidate::*member) {
  std::vector<int> values;
  for (const Candidate& c : candidates) values.push_back(c.*member);
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

std::size_t position(const std::vector<int>& sorted, int value) {
  return static_cast<std::size_t>(std::ranges::lower_bound(sorted, value) - sorted.begin());
}

}  // namespace

void assign_by_min_cost_flow(std::span<const Candidate> candidates, std::span<int> column_of_row) {
  if (candidates.empty()) return;
  const std::vector<int> rows = sorted_unique(candidates, &Candidate::row);
  const std::vector<int> columns = sorted_unique(candidates, &Candidate::column);
  const double heaviest = std::ranges::max(candidates, {}, &Candidate::weight).weight;
  const auto cost = [&](double weight) { return std::llround((heaviest - std::max(0.0, weight)) * kSteps); };

  // Nodes: rows, columns, source, sink. Every row sends one unit, through a column or straight to the sink: no match.
  const std::size_t first_column = rows.size(), source = rows.size() + columns.size(), sink = source + 1;
  Graph graph(sink + 1);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    add_unit_edge(graph, source, row, 0);
    add_unit_edge(graph, row, sink, cost(0.0));
  }
  for (std::size_t column = first_column; column < source; ++column) add_unit_edge(graph, column, sink, 0);
  for (const Candidate& c : candidates) {
    add_unit_edge(graph, position(rows, c.row), first_column + position(columns, c.column), cost(c.weight));
  }
  boost::successive_shortest_path_nonnegative_weights(graph, source, sink);

  const auto capacity = boost::get(boost::edge_capacity, graph);
  const auto residual = boost::get(boost::edge_residual_capacity, graph);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    int& column = column_of_row[rows[row]];
    column = -1;
    const auto [first, last] = boost::out_edges(row, graph);
    for (auto edge = first; edge != last; ++edge) {
      const std::size_t to = boost::target(*edge, graph);
      if (capacity[*edge] == 1 && residual[*edge] == 0 && to < source) column = columns[to - first_column];
    }
  }
}

}  // namespace credo::tracking
