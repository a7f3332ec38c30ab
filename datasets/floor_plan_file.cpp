// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/floor_plan_file.hpp"

#include <stdexcept>

#include "datasets/checked_yaml.hpp"
#include "datasets/number_text.hpp"
#include "datasets/text_file.hpp"

namespace credo::datasets {
namespace {

constexpr int kPlanDecimals = 6;

void check_writable(const geometry::FloorPlan& plan) {
  if (plan.walls.empty()) throw std::invalid_argument("a floor plan needs at least one wall");
  bool finite = std::isfinite(plan.uncertainty_m);
  for (const geometry::Segment& wall : plan.walls) finite = finite && wall.a.allFinite() && wall.b.allFinite();
  for (const Eigen::Vector2d& mark : plan.verticals) finite = finite && mark.allFinite();
  if (!finite) throw std::invalid_argument("a floor plan to be written holds a value that is not finite");
}

std::string plan_list(std::initializer_list<double> values) {
  std::string text = "[";
  for (const double value : values) {
    if (text.size() > 1) text += ", ";
    append_fixed(text, value, kPlanDecimals);
  }
  return text + "]";
}

}  // namespace

geometry::FloorPlan read_floor_plan(const std::filesystem::path& file) {
  const CheckedMap keys = load_yaml(file).map({"format", "walls", "verticals", "uncertainty"});
  (void)keys.required("format").one_of({"credo-floor-plan/1"});
  geometry::FloorPlan plan;
  const CheckedValue walls = keys.required("walls");
  for (const CheckedValue& wall : walls.items()) {
    const std::vector<double> ends = wall.numbers(4, kAnyLength);
    plan.walls.push_back({{ends[0], ends[1]}, {ends[2], ends[3]}});
    if (plan.walls.back().a == plan.walls.back().b)
      wall.fail("a wall without length; expected [x1, y1, x2, y2] with two different ends");
  }
  if (plan.walls.empty())
    walls.fail("walls: the floor plan is empty; expected at least one wall (without any plan, leave the file out)");
  if (const auto verticals = keys.optional("verticals"))
    for (const CheckedValue& mark : verticals->items()) {
      const std::vector<double> xy = mark.numbers(2, kAnyLength);
      plan.verticals.emplace_back(xy[0], xy[1]);
    }
  if (const auto uncertainty = keys.optional("uncertainty")) plan.uncertainty_m = uncertainty->number(kSigma);
  return plan;
}

void write_floor_plan(const std::filesystem::path& file, const geometry::FloorPlan& plan) {
  check_writable(plan);
  std::string text = "format: credo-floor-plan/1\nwalls:\n";
  for (const geometry::Segment& wall : plan.walls)
    text += "  - " + plan_list({wall.a.x(), wall.a.y(), wall.b.x(), wall.b.y()}) + "\n";
  if (!plan.verticals.empty()) text += "verticals:\n";
  for (const Eigen::Vector2d& mark : plan.verticals) text += "  - " + plan_list({mark.x(), mark.y()}) + "\n";
  if (plan.uncertainty_m != 0.0) {
    text += "uncertainty: ";
    append_fixed(text, plan.uncertainty_m, kPlanDecimals);
    text += "\n";
  }
  write_file_whole(file, text);
}

}  // namespace credo::datasets
