// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <functional>

#include "evidence/binary_batch.hpp"
#include "python/bindings.hpp"

namespace credo::python {
namespace {

using evidence::BinaryCells;
using evidence::BinaryReading;

// Python's arrays have the masses of a cell side by side, the loops want an array of each: a piece at a time is turned
// around, small enough to stay in the cache.
template <typename Real>
class Piece {
 public:
  static constexpr std::size_t kSize = 256;

  void read(const Real* cells, std::size_t count, std::size_t width) {
    count_ = count;
    for (std::size_t channel = 0; channel < width; ++channel) {
      for (std::size_t i = 0; i < count; ++i) channels_[channel][i] = cells[width * i + channel];
    }
    if (width < channels_.size()) channels_.back().fill(0);
  }
  void write(Real* cells, std::size_t width) const {
    for (std::size_t channel = 0; channel < width; ++channel) {
      for (std::size_t i = 0; i < count_; ++i) cells[width * i + channel] = channels_[channel][i];
    }
  }
  [[nodiscard]] BinaryCells<Real> masses() {
    return {.yes = {channels_[0].data(), count_},
            .no = {channels_[1].data(), count_},
            .unknown = {channels_[2].data(), count_}};
  }
  [[nodiscard]] std::span<Real> conflict() { return {channels_[3].data(), count_}; }

 private:
  std::array<std::array<Real, kSize>, 4> channels_;  // yes, no, unknown, conflict
  std::size_t count_ = 0;
};

// What becomes of a piece of the map, in place; how many cells kept their mass.
template <typename Real>
using Update = std::size_t (*)(BinaryCells<Real> map, BinaryReading<Real> reading, std::span<Real> conflict);

template <typename Rule>
constexpr bool kLeavesConflict = !std::is_invocable_v<Rule, BinaryCells<double>, BinaryReading<double>>;

template <typename Rule, typename Real>
auto applied(BinaryCells<Real> map, BinaryReading<Real> reading, std::span<Real> conflict) {
  if constexpr (kLeavesConflict<Rule>) return Rule{}(map, reading, conflict);
  if constexpr (!kLeavesConflict<Rule>) return Rule{}(map, reading);
}

template <typename Rule>
constexpr bool kCounts = !std::is_void_v<decltype(applied<Rule, double>({}, {}, {}))>;

template <typename Rule, typename Real>
std::size_t counted(BinaryCells<Real> map, BinaryReading<Real> reading, std::span<Real> conflict) {
  if constexpr (kCounts<Rule>) return applied<Rule, Real>(map, reading, conflict);
  applied<Rule, Real>(map, reading, conflict);
  return 0;
}

// A rule of binary_batch.hpp, as a function of map, reading and, where it leaves one, conflict.
struct BatchRule {
  template <typename Rule>
  constexpr BatchRule(Rule)
      : in_double(counted<Rule, double>),
        in_float(counted<Rule, float>),
        leaves_conflict(kLeavesConflict<Rule>),
        counts(kCounts<Rule>) {}

  template <typename Real>
  [[nodiscard]] Update<Real> update() const {
    if constexpr (std::is_same_v<Real, double>) return in_double;
    if constexpr (std::is_same_v<Real, float>) return in_float;
  }

  Update<double> in_double;
  Update<float> in_float;
  bool leaves_conflict;  // as the fourth mass of a cell
  bool counts;           // cells that kept their mass
};

using Shape = std::vector<py::ssize_t>;

Shape shape_of(const py::array& array) { return {array.shape(), array.shape() + array.ndim()}; }
std::string text_of(const Shape& shape) { return py::str(py::tuple(py::cast(shape))); }
std::string text_of(const py::dtype& type) { return py::str(static_cast<const py::object&>(type)); }
std::string text_of(const py::array& array) { return text_of(array.dtype()) + " of " + shape_text(array); }

// Of arrays of masses, which have the shape (..., width).
std::size_t width_of(const py::array& cells) { return static_cast<std::size_t>(cells.shape(cells.ndim() - 1)); }
std::size_t count_of(const py::array& cells) { return static_cast<std::size_t>(cells.size()) / width_of(cells); }
Shape shape_with(const py::array& cells, py::ssize_t width) {
  Shape shape = shape_of(cells);
  shape.back() = width;
  return shape;
}

// Masses with their cells one after the other; copied only where they are not. \throws std::invalid_argument
py::array cells_in(const py::object& given, const char* name, bool may_hold_conflict = false) {
  const auto cells = py::array::ensure(given, py::array::c_style);
  const std::string begin = std::string(name) + " must be an array of ";
  if (!cells) throw std::invalid_argument(begin + "numbers; got " + std::string(py::repr(given)));
  if (!py::isinstance<py::array_t<double>>(cells) && !py::isinstance<py::array_t<float>>(cells)) {
    throw std::invalid_argument(begin + "float64 or float32; got " + text_of(cells.dtype()));
  }
  const bool fits = cells.ndim() > 0 && (width_of(cells) == 3 || (may_hold_conflict && width_of(cells) == 4));
  if (!fits) {
    throw std::invalid_argument(begin + "the shape (..., 3), yes, no and unknown of every cell" +
                                (may_hold_conflict ? ", or (..., 4), with conflict" : "") + "; got " + text_of(cells));
  }
  return cells;
}

py::array reading_for(const py::array& map, const py::object& given) {
  const py::array reading = cells_in(given, "the reading");
  if (shape_of(reading) != shape_with(map, 3) || !reading.dtype().equal(map.dtype())) {
    throw std::invalid_argument("the reading must have a mass for each cell of the map, in its type; got " +
                                text_of(reading) + " for a map " + text_of(map));
  }
  return reading;
}

// Apart, or the very same: a piece is written where it has been read.
bool overlap_in_part(const py::array& a, const py::array& b) {
  const auto* const begin_a = static_cast<const char*>(a.data());
  const auto* const begin_b = static_cast<const char*>(b.data());
  const std::less<> before;
  const bool apart = !before(begin_a, begin_b + b.nbytes()) || !before(begin_b, begin_a + a.nbytes());
  return !apart && !(begin_a == begin_b && a.nbytes() == b.nbytes());
}

// A new array, or the one that is given for it. \throws std::invalid_argument unless that has the shape and type
template <typename Real>
py::array_t<Real> result_in(const py::object& out, const Shape& shape) {
  if (out.is_none()) return py::array_t<Real>(shape);
  const bool is_array = py::isinstance<py::array_t<Real, py::array::c_style>>(out);
  const auto array = is_array ? py::reinterpret_borrow<py::array_t<Real>>(out) : py::array_t<Real>();
  if (!is_array || shape_of(array) != shape || !array.writeable()) {
    throw std::invalid_argument("out must be a writeable array in C order, " + text_of(py::dtype::of<Real>()) + " of " +
                                text_of(shape) + "; got " + std::string(py::repr(out)));
  }
  return array;
}

void check_apart(const py::array& result, std::initializer_list<const py::array*> sources) {
  for (const py::array* source : sources) {
    if (overlap_in_part(result, *source)) {
      throw std::invalid_argument("out must be the map, the reading or apart from both; it overlaps one in part");
    }
  }
}

// change(piece of the cells, where it begins) for all; the sum of what it returns.
template <typename Real, typename Change>
std::size_t in_pieces(const py::array& cells, py::array_t<Real>& result, Change change) {
  const auto* const from = static_cast<const Real*>(cells.data());
  Real* const to = result.mutable_data();
  const std::size_t count = count_of(cells), width = width_of(cells), result_width = width_of(result);
  return without_gil([&] {
    Piece<Real> piece;
    std::size_t sum = 0;
    for (std::size_t first = 0; first < count; first += piece.kSize) {
      piece.read(from + width * first, std::min(piece.kSize, count - first), width);
      sum += change(piece, first);
      piece.write(to + result_width * first, result_width);
    }
    return sum;
  });
}

template <typename Real>
py::object updated(const BatchRule& rule, const py::array& map, const py::array& reading, const py::object& out) {
  py::array_t<Real> result = result_in<Real>(out, shape_with(map, rule.leaves_conflict ? 4 : 3));
  check_apart(result, {&map, &reading});
  const auto* const said = static_cast<const Real*>(reading.data());
  const std::size_t count = count_of(map);
  Piece<Real> other;
  const std::size_t kept = in_pieces<Real>(map, result, [&](Piece<Real>& piece, std::size_t first) {
    other.read(said + 3 * first, std::min(other.kSize, count - first), 3);
    return rule.update<Real>()(piece.masses(), other.masses(), piece.conflict());
  });
  return rule.counts ? py::object(py::make_tuple(result, kept)) : py::object(result);
}

py::object combined_cells(const BatchRule& rule, const py::object& map, const py::object& reading,
                          const py::object& out) {
  const py::array cells = cells_in(map, "the map", rule.leaves_conflict);
  const py::array said = reading_for(cells, reading);
  return py::isinstance<py::array_t<float>>(cells) ? updated<float>(rule, cells, said, out)
                                                   : updated<double>(rule, cells, said, out);
}

template <typename Real>
py::object discounted_by(double reliability, const py::array& cells, const py::object& out) {
  py::array_t<Real> result = result_in<Real>(out, shape_with(cells, 3));
  check_apart(result, {&cells});
  in_pieces<Real>(cells, result, [reliability](Piece<Real>& piece, std::size_t) {
    evidence::discount(piece.masses(), static_cast<Real>(reliability));
    return std::size_t{0};
  });
  return result;
}

py::object discounted_cells(const py::object& masses, double reliability, const py::object& out) {
  const py::array cells = cells_in(masses, "masses");
  const double checked = checked_reliability(reliability);
  return py::isinstance<py::array_t<float>>(cells) ? discounted_by<float>(checked, cells, out)
                                                   : discounted_by<double>(checked, cells, out);
}

struct DocumentedBatchRule {
  const char* name;
  BatchRule rule;
  const char* doc;
};

const std::array<DocumentedBatchRule, 8> kBatchRules{{
    {"conjunctive", [](auto map, auto reading, auto conflict) { evidence::conjunctive(map, reading, conflict); },
     R"(conjunctive(map, reading, out=None)
--

Conjunctive rule (TBM). The result has the shape (..., 4), conflict last; so may the map, to take in more.)"},
    {"dempster", [](auto map, auto reading) { return evidence::dempster(map, reading); },
     R"(dempster(map, reading, out=None)
--

Dempster's rule. Returns the masses, and how many cells kept their old one because of total conflict.)"},
    {"yager", [](auto map, auto reading) { evidence::conflict_to_ignorance(map, reading); },
     R"(yager(map, reading, out=None)
--

Conflict to ignorance, each reading by itself. Total conflict makes a cell vacuous.)"},
    {"disjunctive", [](auto map, auto reading) { evidence::disjunctive(map, reading); },
     "disjunctive(map, reading, out=None)\n--\n\nDisjunctive rule."},
    {"pcr2", [](auto map, auto reading) { evidence::pcr2(map, reading); }, "pcr2(map, reading, out=None)\n--\n\nPCR2."},
    {"pcr5", [](auto map, auto reading) { evidence::pcr5(map, reading); },
     "pcr5(map, reading, out=None)\n--\n\nPCR5; of two sources PCR6, PCR5+ and PCR6+ are the same."},
    {"cautious", [](auto map, auto reading, auto conflict) { return evidence::cautious(map, reading, conflict); },
     R"(cautious(map, reading, out=None)
--

Cautious rule, shapes as conjunctive. Returns the masses, and how many cells kept their old one because it or the
reading is dogmatic (unknown = 0) and has no weights.)"},
    {"average", [](auto map, auto reading) { evidence::average(map, reading); },
     "average(map, reading, out=None)\n--\n\nMean of both."},
}};

}  // namespace

void bind_batch(py::module_& module) {
  py::module_ batch = module.def_submodule("batch", R"(The rules on numpy arrays of masses: a map takes in a reading.

Masses have the shape (..., 3): yes, no and unknown of every cell, in float64 or float32. The reading has the shape and
type of the map; the result too, in a new array, or in `out`, which may be the map itself. Results are those of the
functions of BinaryMass for two sources. Only the conjunctive, the disjunctive, Dempster's and the cautious rule are
associative: with the others a map is a recursive filter, for which the order of its readings counts.

>>> import numpy
>>> grid = numpy.full((400, 400, 3), [0.0, 0.0, 1.0])
>>> reading = numpy.full((400, 400, 3), [0.5, 0.25, 0.25])
>>> grid, kept = dempster(grid, reading)
>>> grid, kept = dempster(grid, discount(reading, 0.5), out=grid)
>>> grid[7, 9].round(3), kept
(array([0.571, 0.25 , 0.179]), 0)

That the masses of a cell are >= 0 and sum to 1 is not checked. ValueError for other shapes and types.)");
  for (const DocumentedBatchRule& each : kBatchRules) {
    batch.def(
        each.name,
        [&rule = each.rule](const py::object& map, const py::object& reading, const py::object& out) {
          return combined_cells(rule, map, reading, out);
        },
        py::arg("map"), py::arg("reading"), py::arg("out") = py::none(), each.doc);
  }
  batch.def("discount", discounted_cells, py::arg("masses"), py::arg("reliability"), py::arg("out") = py::none(),
            R"(discount(masses, reliability, out=None)
--

Committed masses times the reliability in [0, 1], the rest is ignorance: temporal decay of a map, or a source that is
not quite to be believed.)");
}

}  // namespace credo::python
