// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/map_server.hpp"

#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "datasets/checked_yaml.hpp"
#include "datasets/format_error.hpp"
#include "datasets/image_file.hpp"
#include "datasets/number_text.hpp"
#include "datasets/text_file.hpp"

namespace credo::datasets {
namespace {

constexpr double kOccupiedThreshold = 0.65;
// Grey 205 is (255 - 205) / 255 = 0.19608, which is not below 0.196: it stays unknown. It would read as free with
// nav2's own default of 0.25.
constexpr double kFreeThreshold = 0.196;
constexpr char kFreeGrey = static_cast<char>(254);
constexpr char kOccupiedGrey = static_cast<char>(0);
constexpr char kUnknownGrey = static_cast<char>(205);
constexpr int kMapDecimals = 9;

enum class Mode { kTrinary, kScale, kRaw };

struct Rules {
  Mode mode = Mode::kTrinary;
  bool negate = false;
  double occupied_threshold = kOccupiedThreshold;
  double free_threshold = kFreeThreshold;
};

/// A pixel: the mean of its colours and its opacity, both 0..1.
struct Pixel {
  double shade = 0.0;
  double alpha = 1.0;
  bool has_alpha = false;
};

/// nav2's map_server, with strict inequalities on both thresholds.
std::int8_t interpret(const Pixel& pixel, const Rules& rules) {
  if (rules.mode == Mode::kRaw) {
    const double value = std::round(pixel.shade * 255.0);
    return value <= 100.0 ? static_cast<std::int8_t>(value) : OccupancyMap::kUnknown;
  }
  if (rules.mode == Mode::kScale && pixel.has_alpha && pixel.alpha < 1.0) return OccupancyMap::kUnknown;
  // Trinary mode averages the opacity in with the three colours.
  const double shade =
      rules.mode == Mode::kTrinary && pixel.has_alpha ? (3.0 * pixel.shade + pixel.alpha) / 4.0 : pixel.shade;
  const double occupied = rules.negate ? shade : 1.0 - shade;
  if (occupied > rules.occupied_threshold) return OccupancyMap::kOccupied;
  if (occupied < rules.free_threshold) return OccupancyMap::kFree;
  if (rules.mode == Mode::kTrinary) return OccupancyMap::kUnknown;
  return static_cast<std::int8_t>(
      std::rint((occupied - rules.free_threshold) / (rules.occupied_threshold - rules.free_threshold) * 100.0));
}

template <typename Value>
Pixel pixel_of(const Value* channels, int count, double white) {
  const bool has_alpha = count == 2 || count == 4;
  const int colours = has_alpha ? count - 1 : count;
  double sum = 0.0;
  for (int c = 0; c < colours; ++c) sum += channels[c];
  return {.shade = sum / colours / white, .alpha = has_alpha ? channels[colours] / white : 1.0, .has_alpha = has_alpha};
}

bool read_negate(const CheckedValue& value) {
  switch (value.one_of({"0", "1", "false", "true"})) {
    case 0:
    case 2: return false;
    default: return true;
  }
}

Rules read_rules(const CheckedMap& keys) {
  Rules rules;
  if (const auto mode = keys.optional("mode"))
    rules.mode = static_cast<Mode>(mode->one_of({"trinary", "scale", "raw"}));
  rules.negate = read_negate(keys.required("negate"));
  const CheckedValue occupied = keys.required("occupied_thresh"), free = keys.required("free_thresh");
  rules.occupied_threshold = occupied.number({.low = 0.0, .high = 1.0});
  rules.free_threshold = free.number({.low = 0.0, .high = 1.0});
  if (rules.free_threshold > rules.occupied_threshold)
    free.fail("free_thresh: is above occupied_thresh; expected at most " + std::to_string(rules.occupied_threshold));
  return rules;
}

cv::Mat read_picture(const std::filesystem::path& file) {
  const std::string bytes = read_binary_file(file);
  check_whole(file, bytes);
  cv::Mat picture;
  if (!bytes.empty()) {
    const cv::Mat raw(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data()));
    try {
      picture = cv::imdecode(raw, cv::IMREAD_UNCHANGED);
    } catch (const cv::Exception&) {
      picture.release();
    }
  }
  if (picture.empty())
    throw FormatError(file, 0, "is no picture that can be read, or is cut short; expected PGM or PNG");
  if (picture.depth() != CV_8U && picture.depth() != CV_16U)
    throw FormatError(file, 0, "has neither 8 nor 16 bits per channel");
  return picture;
}

std::string yaml_of(const OccupancyMap& map, const std::string& image) {
  std::string text = "image: " + image + "\nmode: trinary\nresolution: ";
  append_fixed(text, map.resolution_m, kMapDecimals);
  text += "\norigin: [";
  append_fixed(text, map.origin_x_m, kMapDecimals);
  text += ", ";
  append_fixed(text, map.origin_y_m, kMapDecimals);
  text += ", ";
  append_fixed(text, map.origin_yaw_rad, kMapDecimals);
  return text + "]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
}

void check_writable(const OccupancyMap& map) {
  if (map.width <= 0 || map.height <= 0 || map.cells.size() != static_cast<std::size_t>(map.width) * map.height)
    throw std::invalid_argument("an occupancy map of " + std::to_string(map.width) + " x " +
                                std::to_string(map.height) + " cells holds " + std::to_string(map.cells.size()));
  if (!(map.resolution_m > 0.0) || !std::isfinite(map.resolution_m) || !std::isfinite(map.origin_x_m) ||
      !std::isfinite(map.origin_y_m) || !std::isfinite(map.origin_yaw_rad))
    throw std::invalid_argument("an occupancy map to be written has a resolution or an origin that is none");
}

char grey_of(std::int8_t cell) {
  if (cell < 0 || cell > 100) return kUnknownGrey;
  if (cell <= std::lround(kFreeThreshold * 100.0)) return kFreeGrey;
  return cell >= std::lround(kOccupiedThreshold * 100.0) ? kOccupiedGrey : kUnknownGrey;
}

}  // namespace

OccupancyMap to_occupancy(const grids::EvidentialGrid& grid, const grids::DecisionParams& params) {
  const grids::CellBox box = grids::picture_box(grid);
  const grids::Georeference& reference = grid.georeference();
  OccupancyMap map{.width = box.width,
                   .height = box.height,
                   .resolution_m = reference.resolution_m,
                   .origin_x_m = reference.origin_x_m + box.min.x * reference.resolution_m,
                   .origin_y_m = reference.origin_y_m + box.min.y * reference.resolution_m,
                   .origin_yaw_rad = 0.0,
                   .cells = {}};
  const std::vector<grids::CellState> states = grids::decisions(grid, box, params);
  map.cells.reserve(states.size());
  for (const grids::CellState state : states)
    map.cells.push_back(state == grids::CellState::kEmpty      ? OccupancyMap::kFree
                        : state == grids::CellState::kOccupied ? OccupancyMap::kOccupied
                                                               : OccupancyMap::kUnknown);
  return map;
}

OccupancyMap read_map(const std::filesystem::path& yaml) {
  const CheckedMap keys =
      load_yaml(yaml).map({"image", "resolution", "origin", "occupied_thresh", "free_thresh", "negate", "mode"});
  OccupancyMap map;
  map.resolution_m = keys.required("resolution").number(kPositiveLength);
  const geometry::Pose2 origin = keys.required("origin").pose();
  map.origin_x_m = origin.x;
  map.origin_y_m = origin.y;
  map.origin_yaw_rad = origin.theta;
  const Rules rules = read_rules(keys);
  const CheckedValue image = keys.required("image");
  const std::string name = image.text();
  if (name.empty()) image.fail("image: is empty; expected the name of a picture");
  const cv::Mat picture = read_picture(yaml.parent_path() / name);
  map.width = picture.cols;
  map.height = picture.rows;
  map.cells.reserve(picture.total());
  for (int row = picture.rows - 1; row >= 0; --row) {  // the top row of the picture is the last of the map
    for (int column = 0; column < picture.cols; ++column) {
      const int offset = column * picture.channels();
      const Pixel pixel = picture.depth() == CV_8U
                              ? pixel_of(picture.ptr<std::uint8_t>(row) + offset, picture.channels(), 255.0)
                              : pixel_of(picture.ptr<std::uint16_t>(row) + offset, picture.channels(), 65535.0);
      map.cells.push_back(interpret(pixel, rules));
    }
  }
  return map;
}

void write_map(const OccupancyMap& map, const std::filesystem::path& yaml) {
  check_writable(map);
  const std::filesystem::path image = std::filesystem::path(yaml).replace_extension(".pgm");
  std::string pgm = "P5\n# CREATOR: Credo\n" + std::to_string(map.width) + ' ' + std::to_string(map.height) + "\n255\n";
  pgm.reserve(pgm.size() + map.cells.size());
  for (int row = map.height - 1; row >= 0; --row)
    for (int column = 0; column < map.width; ++column) pgm.push_back(grey_of(map.at(column, row)));
  write_file_whole(image, pgm);
  write_file_whole(yaml, yaml_of(map, image.filename().string()));
}

}  // namespace credo::datasets
