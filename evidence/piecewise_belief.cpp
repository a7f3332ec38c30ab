// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/piecewise_belief.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

#include "evidence/number_text.hpp"

namespace credo::evidence {
namespace {

std::string quoted(std::string_view text) { return "'" + std::string(text) + "'"; }

void expect(bool holds, const std::string& what, const std::string& found, const std::string& expected) {
  if (!holds) throw std::invalid_argument(what + ": found " + found + ", expected " + expected);
}

void check_line(std::string_view text, const char* what) {
  const bool is_line = !text.empty() && text.front() != ' ' && text.back() != ' ' &&
                       std::ranges::none_of(text, [](unsigned char c) { return c < ' ' || c == 0x7F; });
  expect(is_line, what, quoted(text), "one line of text with no space at an end");
}

std::string masses_text(const Breakpoint& point) {
  std::string text = "yes ";
  append_number(text, point.yes);
  append_number(text += ", no ", point.no);
  return text;
}

/// That `point` may follow the breakpoints that come before it.
void check_next(std::span<const Breakpoint> before, const Breakpoint& point) {
  check_line(point.name, "name of a breakpoint");
  const std::string who = "breakpoint " + quoted(point.name);
  std::string x = "x = ";
  append_number(x, point.x);
  expect(std::isfinite(point.x), who, x, "a finite number");
  expect(point.yes >= 0.0 && point.no >= 0.0 && point.yes + point.no <= 1.0 + kMassTolerance, who, masses_text(point),
         "both >= 0 and their sum <= 1");
  if (before.empty()) return;
  append_number(x += " after ", before.back().x);
  expect(point.x > before.back().x, who, x, "a larger x than that of the breakpoint before");
  expect(std::isfinite(point.x - before.front().x), who, x, "a range of x that is a finite number");
  expect(std::ranges::none_of(before, [&](const Breakpoint& other) { return other.name == point.name; }), who,
         "its name a second time", "another name for each breakpoint");
}

}  // namespace

PiecewiseBelief::PiecewiseBelief(ShapeTitle title, std::vector<Breakpoint> breakpoints)
    : title_(std::move(title)), breakpoints_(std::move(breakpoints)) {
  check_line(title_.name, "name of a shape");
  check_line(title_.quantity, "quantity of a shape");
  check_line(title_.unit, "unit of a shape");
  expect(!breakpoints_.empty(), "shape " + quoted(title_.name), "no breakpoint", "at least one");
  const std::span<Breakpoint> all = breakpoints_;
  for (std::size_t i = 0; i < all.size(); ++i) {
    check_next(all.first(i), all[i]);
    all[i].yes = std::min(all[i].yes, 1.0);
    all[i].no = std::min(all[i].no, 1.0 - all[i].yes);
  }
}

BinaryMass PiecewiseBelief::operator()(double x) const {
  if (std::isnan(x)) return BinaryMass::vacuous();
  const auto above = std::ranges::upper_bound(breakpoints_, x, {}, &Breakpoint::x);
  if (above == breakpoints_.begin()) return BinaryMass::from(above->yes, above->no);
  const Breakpoint& from = *std::prev(above);
  if (above == breakpoints_.end()) return BinaryMass::from(from.yes, from.no);
  const double share = (x - from.x) / (above->x - from.x);
  return BinaryMass::from(std::lerp(from.yes, above->yes, share), std::lerp(from.no, above->no, share));
}

PiecewiseBelief piecewise(const RampBelief& shape, ShapeTitle title) {
  check(shape, title.name.c_str());
  const auto after = [](double x, double step_at) {  // where a ramp that starts at `step_at` ends
    return x == step_at ? std::nextafter(x, std::numeric_limits<double>::infinity()) : x;
  };
  std::vector<Breakpoint> ends = {{.name = "yes_full_until", .x = shape.yes_full_until},
                                  {.name = "yes_zero_from", .x = after(shape.yes_zero_from, shape.yes_full_until)},
                                  {.name = "no_zero_until", .x = shape.no_zero_until},
                                  {.name = "no_full_from", .x = after(shape.no_full_from, shape.no_zero_until)}};
  std::ranges::stable_sort(ends, {}, &Breakpoint::x);
  std::vector<Breakpoint> breakpoints;
  for (const Breakpoint& end : ends) {
    if (!breakpoints.empty() && breakpoints.back().x == end.x) {
      breakpoints.back().name += " = " + end.name;
      continue;
    }
    const BinaryMass mass = shape(end.x);
    breakpoints.push_back({.name = end.name, .x = end.x, .yes = mass.yes, .no = mass.no});
  }
  return {std::move(title), std::move(breakpoints)};
}

std::string to_text(const PiecewiseBelief& shape) {
  const ShapeTitle& title = shape.title();
  std::string text = "shape " + title.name + "\nquantity " + title.quantity + "\nunit " + title.unit + '\n';
  for (const Breakpoint& point : shape.breakpoints()) {
    append_number(text += "at ", point.x);
    append_number(text += " yes ", point.yes);
    append_number(text += " no ", point.no);
    text += ' ' + point.name + '\n';
  }
  return text;
}

namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t begin = std::min(text.find_first_not_of(kBlank), text.size());
  return text.substr(begin, text.find_last_not_of(kBlank) + 1 - begin);
}

/// Takes the first word off a line, and the spaces after it.
std::string_view take_word(std::string_view& line) {
  const std::string_view word = line.substr(0, line.find(' '));
  line = trimmed(line.substr(word.size()));
  return word;
}

std::optional<double> take_number_after(std::string_view keyword, std::string_view& line) {
  if (take_word(line) != keyword) return std::nullopt;
  const std::string_view word = take_word(line);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

std::optional<Breakpoint> breakpoint_in(std::string_view line) {
  const std::optional<double> x = take_number_after("at", line);
  const std::optional<double> yes = take_number_after("yes", line);
  const std::optional<double> no = take_number_after("no", line);
  if (!x || !yes || !no) return std::nullopt;
  return Breakpoint{.name = std::string(line), .x = *x, .yes = *yes, .no = *no};
}

/// A shape as far as it is read.
class ShapeDraft {
 public:
  void take(std::string_view line) {
    std::string_view rest = line;
    if (const TitleLine next = next_title_line(); next.field != nullptr) {
      expect(take_word(rest) == next.keyword && !rest.empty(), "a shape", quoted(line), expected_line());
      check_line(rest, "a title");
      *next.field = rest;
      return;
    }
    std::optional<Breakpoint> point = breakpoint_in(line);
    expect(point && !point->name.empty(), "a shape", quoted(line), expected_line());
    check_next(breakpoints_, *point);
    breakpoints_.push_back(std::move(*point));
  }
  PiecewiseBelief finished() {
    expect(!breakpoints_.empty(), "a shape", "the end of the text", expected_line());
    return {std::move(title_), std::move(breakpoints_)};
  }

 private:
  struct TitleLine {
    std::string_view keyword;
    std::string* field = nullptr;  // none: the title is complete
  };
  TitleLine next_title_line() {
    if (title_.name.empty()) return {"shape", &title_.name};
    if (title_.quantity.empty()) return {"quantity", &title_.quantity};
    if (title_.unit.empty()) return {"unit", &title_.unit};
    return {};
  }
  std::string expected_line() {
    const TitleLine next = next_title_line();
    return next.field != nullptr ? quoted(std::string(next.keyword) + " TEXT")
                                 : "'at NUMBER yes NUMBER no NUMBER NAME'";
  }

  ShapeTitle title_;
  std::vector<Breakpoint> breakpoints_;
};

}  // namespace

PiecewiseBelief read_piecewise_belief(std::string_view text) {
  ShapeDraft draft;
  std::size_t number = 1;
  try {
    for (; !text.empty(); ++number) {
      const std::string_view raw = text.substr(0, text.find('\n'));
      text.remove_prefix(std::min(raw.size() + 1, text.size()));
      const std::string_view line = trimmed(raw);
      if (!line.empty() && line.front() != '#') draft.take(line);
    }
    return draft.finished();
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument("line " + std::to_string(number) + ": " + error.what());
  }
}

}  // namespace credo::evidence
