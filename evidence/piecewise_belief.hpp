// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "evidence/belief_shapes.hpp"
#include "evidence/binary_mass.hpp"

namespace credo::evidence {

/// A place of a shape where its slope may change, and the two committed masses there.
struct Breakpoint {
  std::string name;
  double x = 0.0;  ///< in the unit of the quantity
  double yes = 0.0;
  double no = 0.0;

  friend bool operator==(const Breakpoint&, const Breakpoint&) = default;
};

/// What a shape is called and what it is a function of. Each is one line of text: not empty, no control characters, no
/// space at an end.
struct ShapeTitle {
  std::string name;
  std::string quantity;  ///< what was measured
  std::string unit;      ///< "1" for a pure number

  friend bool operator==(const ShapeTitle&, const ShapeTitle&) = default;
};

/// Belief as any piecewise linear function of one measured quantity, as data: written, read, fitted
/// (shape_fitting.hpp). YES and NO are linear between the breakpoints and constant outside. The two ramps of Clerentin
/// et al. are RampBelief; it converts to this form.
class PiecewiseBelief {
 public:
  /// \param breakpoints  at least one; x ascending, each yes >= 0, no >= 0 and yes + no <= 1 (what exceeds 1 by 1e-9 or
  ///                     less is cut off)
  /// \throws std::invalid_argument, naming the breakpoint or part of the title, what was found and what is expected:
  ///         also for a name given twice, a number that is not finite and a range of x that exceeds all doubles
  PiecewiseBelief(ShapeTitle title, std::vector<Breakpoint> breakpoints);

  [[nodiscard]] const ShapeTitle& title() const { return title_; }
  [[nodiscard]] const std::vector<Breakpoint>& breakpoints() const { return breakpoints_; }  ///< ascending in x

  /// The mass at `x`, by binary search. At a breakpoint exactly its masses; nan, a quantity that could not be measured,
  /// gives the vacuous mass.
  [[nodiscard]] BinaryMass operator()(double x) const;

  friend bool operator==(const PiecewiseBelief&, const PiecewiseBelief&) = default;

 private:
  ShapeTitle title_;
  std::vector<Breakpoint> breakpoints_;
};

/// The same function of x, but for rounding, with the parameters of the ramps as names of the breakpoints; what falls
/// together has a name joined by " = ". A step, which two breakpoints at one place would make, becomes a slope from
/// there to the next double: no number lies on it.
/// \throws std::invalid_argument as check(shape), or if YES and NO exceed 1 beyond a step
[[nodiscard]] PiecewiseBelief piecewise(const RampBelief& shape, ShapeTitle title);

/// The shape as lines of text, with the shortest numbers that read back as the same doubles:
///
///     shape alignment
///     quantity mean residual
///     unit standard deviations
///     at 1 yes 0.9 no 0 good until
///     at 3 yes 0 no 0.8 bad from
///
/// read_piecewise_belief(to_text(shape)) == shape.
[[nodiscard]] std::string to_text(const PiecewiseBelief& shape);

/// Reads that text. Empty lines and lines that begin with # are skipped; fields are separated by one space or more, and
/// the name of a breakpoint is the rest of its line.
/// \throws std::invalid_argument: "line 4: found …, expected …"
[[nodiscard]] PiecewiseBelief read_piecewise_belief(std::string_view text);

}  // namespace credo::evidence
