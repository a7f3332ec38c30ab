// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/binary_batch.hpp"

#include <sstream>
#include <stdexcept>

#include "evidence/binary_cell.hpp"
#include "evidence/reliability.hpp"

namespace credo::evidence {
namespace {

template <typename Real>
void check_sizes(const BinaryCells<Real>& cells, std::size_t size) {
  for (const std::span<Real>& array : {cells.yes, cells.no, cells.unknown}) {
    if (array.size() == size) continue;
    std::ostringstream message;
    message << "the arrays of a batch must be of one size; got " << size << " and " << array.size();
    throw std::invalid_argument(message.str());
  }
}

// `__restrict`: the arrays do not overlap, which compilers need to know to vectorise.
template <typename Real, typename Rule>
void loop(Real* __restrict yes, Real* __restrict no, Real* __restrict unknown, const Real* __restrict other_yes,
          const Real* __restrict other_no, const Real* __restrict other_unknown, std::size_t size, Rule rule) {
  for (std::size_t i = 0; i < size; ++i) {
    const cell::Open<Real> fused = rule(cell::Open<Real>{yes[i], no[i], unknown[i], 0},
                                        cell::Open<Real>{other_yes[i], other_no[i], other_unknown[i], 0});
    yes[i] = fused.yes;
    no[i] = fused.no;
    unknown[i] = fused.unknown;
  }
}

template <typename Real, typename Rule>
void loop_with_conflict(Real* __restrict yes, Real* __restrict no, Real* __restrict unknown, Real* __restrict conflict,
                        const Real* __restrict other_yes, const Real* __restrict other_no,
                        const Real* __restrict other_unknown, std::size_t size, Rule rule) {
  for (std::size_t i = 0; i < size; ++i) {
    const cell::Open<Real> fused = rule(cell::Open<Real>{yes[i], no[i], unknown[i], conflict[i]},
                                        cell::Open<Real>{other_yes[i], other_no[i], other_unknown[i], 0});
    yes[i] = fused.yes;
    no[i] = fused.no;
    unknown[i] = fused.unknown;
    conflict[i] = fused.conflict;
  }
}

// rule(cell of the map, cell of the reading) for every cell.
template <typename Real, typename Rule>
void update(const BinaryCells<Real>& map, const BinaryCells<const Real>& reading, Rule rule) {
  check_sizes(map, map.size());
  check_sizes(reading, map.size());
  loop(map.yes.data(), map.no.data(), map.unknown.data(), reading.yes.data(), reading.no.data(), reading.unknown.data(),
       map.size(), rule);
}

template <typename Real, typename Rule>
void update(const BinaryCells<Real>& map, std::span<Real> conflict, const BinaryCells<const Real>& reading, Rule rule) {
  check_sizes(map, conflict.size());
  check_sizes(reading, conflict.size());
  loop_with_conflict(map.yes.data(), map.no.data(), map.unknown.data(), conflict.data(), reading.yes.data(),
                     reading.no.data(), reading.unknown.data(), map.size(), rule);
}

template <typename Real>
cell::Open<Real> chosen(bool first, const cell::Open<Real>& a, const cell::Open<Real>& b) {
  return {first ? a.yes : b.yes, first ? a.no : b.no, first ? a.unknown : b.unknown, first ? a.conflict : b.conflict};
}

}  // namespace

template <std::floating_point Real>
void conjunctive(BinaryCells<Real> map, BinaryReading<Real> reading, std::span<std::type_identity_t<Real>> conflict) {
  using Cell = cell::Open<Real>;
  update(map, conflict, reading, [](const Cell& a, const Cell& b) { return cell::conjunctive(a, b); });
}

template <std::floating_point Real>
std::size_t dempster(BinaryCells<Real> map, BinaryReading<Real> reading) {
  using Cell = cell::Open<Real>;
  std::size_t left = 0;
  update(map, reading, [&left](const Cell& a, const Cell& b) {
    const Cell open = cell::conjunctive(a, b);
    const Real kept = open.yes + open.no + open.unknown;
    const bool total_conflict = !(kept > 0);
    left += total_conflict;
    const Real divisor = total_conflict ? Real(1) : kept;
    return chosen(total_conflict, a, Cell{open.yes / divisor, open.no / divisor, open.unknown / divisor, 0});
  });
  return left;
}

template <std::floating_point Real>
void conflict_to_ignorance(BinaryCells<Real> map, BinaryReading<Real> reading) {
  using Cell = cell::Open<Real>;
  update(map, reading, [](const Cell& a, const Cell& b) { return cell::conflict_to_ignorance(a, b); });
}

template <std::floating_point Real>
void disjunctive(BinaryCells<Real> map, BinaryReading<Real> reading) {
  using Cell = cell::Open<Real>;
  update(map, reading, [](const Cell& a, const Cell& b) { return cell::disjunctive(a, b); });
}

template <std::floating_point Real>
void pcr2(BinaryCells<Real> map, BinaryReading<Real> reading) {
  using Cell = cell::Open<Real>;
  update(map, reading,
         [](const Cell& a, const Cell& b) { return cell::pcr2(cell::conjunctive(a, b), a.yes + b.yes, a.no + b.no); });
}

template <std::floating_point Real>
void pcr5(BinaryCells<Real> map, BinaryReading<Real> reading) {
  using Cell = cell::Open<Real>;
  update(map, reading, [](const Cell& a, const Cell& b) { return cell::pcr5(a, b); });
}

template <std::floating_point Real>
std::size_t cautious(BinaryCells<Real> map, BinaryReading<Real> reading,
                     std::span<std::type_identity_t<Real>> conflict) {
  using Cell = cell::Open<Real>;
  std::size_t left = 0;
  update(map, conflict, reading, [&left](const Cell& a, const Cell& b) {
    const bool dogmatic = !cell::has_weights(a) || !cell::has_weights(b);
    left += dogmatic;
    const Cell weighed = cell::recompose(cell::least(cell::weights(a), cell::weights(b)));
    return chosen(dogmatic, a, weighed);
  });
  return left;
}

template <std::floating_point Real>
void average(BinaryCells<Real> map, BinaryReading<Real> reading) {
  using Cell = cell::Open<Real>;
  update(map, reading, [](const Cell& a, const Cell& b) {
    const Real half = Real(0.5);
    return Cell{half * a.yes + half * b.yes, half * a.no + half * b.no, half * a.unknown + half * b.unknown, 0};
  });
}

template <std::floating_point Real>
void discount(BinaryCells<Real> cells, std::type_identity_t<Real> reliability) {
  check_reliability(reliability);
  check_sizes(cells, cells.size());
  for (Real& mass : cells.yes) mass *= reliability;
  for (Real& mass : cells.no) mass *= reliability;
  for (Real& mass : cells.unknown) mass = (1 - reliability) + reliability * mass;
}

template void conjunctive(BinaryCells<float>, BinaryReading<float>, std::span<float>);
template void conjunctive(BinaryCells<double>, BinaryReading<double>, std::span<double>);
template std::size_t dempster(BinaryCells<float>, BinaryReading<float>);
template std::size_t dempster(BinaryCells<double>, BinaryReading<double>);
template void conflict_to_ignorance(BinaryCells<float>, BinaryReading<float>);
template void conflict_to_ignorance(BinaryCells<double>, BinaryReading<double>);
template void disjunctive(BinaryCells<float>, BinaryReading<float>);
template void disjunctive(BinaryCells<double>, BinaryReading<double>);
template void pcr2(BinaryCells<float>, BinaryReading<float>);
template void pcr2(BinaryCells<double>, BinaryReading<double>);
template void pcr5(BinaryCells<float>, BinaryReading<float>);
template void pcr5(BinaryCells<double>, BinaryReading<double>);
template std::size_t cautious(BinaryCells<float>, BinaryReading<float>, std::span<float>);
template std::size_t cautious(BinaryCells<double>, BinaryReading<double>, std::span<double>);
template void average(BinaryCells<float>, BinaryReading<float>);
template void average(BinaryCells<double>, BinaryReading<double>);
template void discount(BinaryCells<float>, float);
template void discount(BinaryCells<double>, double);

}  // namespace credo::evidence
