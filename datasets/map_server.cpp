// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/map_server.hpp"

#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <optional>
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

/// Between 0 and the grey of one percent, and the same below 1: a scale's ends are read as 0 and 100, and no step is
/// lost.
constexpr double kScaleMargin = 0.002;

/// What a YAML says of the grey levels.
struct Levels {
  MapMode mode = MapMode::kTrinary;
  bool negate = false;
  double occupied_threshold = kOccupiedThreshold;
  double free_threshold = kFreeThreshold;
};

/// A pixel: the mean of its colours and its opacity, both 0..1.
struct Pixel {
  double shade = 0.0;
  double alpha = 1.0;
  bool has_alpha = false;
  double last = 1.0;  ///< channel of a pixel of several, in the order red, green, blue, opacity
};

/// Occupied, free, or nothing between the two.
std::optional<std::int8_t> beyond_thresholds(double occupied, const Levels& levels) {
  if (occupied > levels.occupied_threshold) return OccupancyMap::kOccupied;
  if (occupied < levels.free_threshold) return OccupancyMap::kFree;
  return std::nullopt;
}

/// Trinary mode averages the opacity in with the three colours.
double trinary_shade(const Pixel& pixel) {
  return pixel.has_alpha ? (3.0 * pixel.shade + pixel.alpha) / 4.0 : pixel.shade;
}

double occupied_share(double shade, const Levels& levels) { return levels.negate ? shade : 1.0 - shade; }

double between_thresholds(double occupied, const Levels& levels) {
  return (occupied - levels.free_threshold) / (levels.occupied_threshold - levels.free_threshold);
}

std::int8_t interpret_nav2(const Pixel& pixel, const Levels& levels) {
  switch (levels.mode) {
    case MapMode::kTrinary:
      return beyond_thresholds(occupied_share(trinary_shade(pixel), levels), levels).value_or(OccupancyMap::kUnknown);
    case MapMode::kScale: break;
    case MapMode::kRaw: {
      const double value = std::round(pixel.shade * 255.0);
      return value <= 100.0 ? static_cast<std::int8_t>(value) : OccupancyMap::kUnknown;
    }
  }
  if (pixel.has_alpha && pixel.alpha < 1.0) return OccupancyMap::kUnknown;
  const double occupied = occupied_share(pixel.shade, levels);
  if (const auto sure = beyond_thresholds(occupied, levels)) return *sure;
  return static_cast<std::int8_t>(std::rint(between_thresholds(occupied, levels) * 100.0));
}

std::int8_t interpret_ros1(const Pixel& pixel, const Levels& levels) {
  switch (levels.mode) {
    case MapMode::kTrinary:
      return beyond_thresholds(occupied_share(trinary_shade(pixel), levels), levels).value_or(OccupancyMap::kUnknown);
    case MapMode::kScale: break;
    case MapMode::kRaw: {
      const double shade = levels.negate ? 1.0 - pixel.shade : pixel.shade;
      // A byte and no percentage: those from 128 on come out negative, 255 as unknown. Rounding noise is not cut off.
      return static_cast<std::int8_t>(static_cast<std::uint8_t>(shade * 255.0 + 1e-6));
    }
  }
  const double occupied = occupied_share(pixel.shade, levels);
  if (const auto sure = beyond_thresholds(occupied, levels)) return *sure;
  if (pixel.last * 255.0 < 1.0) return OccupancyMap::kUnknown;
  return static_cast<std::int8_t>(1.0 + 98.0 * between_thresholds(occupied, levels));
}

template <typename Value>
Pixel pixel_of(const Value* channels, int count, double white) {
  const bool has_alpha = count == 2 || count == 4;
  const int colours = has_alpha ? count - 1 : count;
  double sum = 0.0;
  for (int c = 0; c < colours; ++c) sum += channels[c];
  const double alpha = has_alpha ? channels[colours] / white : 1.0;
  const double last = has_alpha ? alpha : count == 1 ? 1.0 : channels[0] / white;  // OpenCV has blue first
  return {.shade = sum / colours / white, .alpha = alpha, .has_alpha = has_alpha, .last = last};
}

bool read_negate(const CheckedValue& value) {
  switch (value.one_of({"0", "1", "false", "true"})) {
    case 0:
    case 2: return false;
    default: return true;
  }
}

Levels read_levels(const CheckedMap& keys) {
  Levels levels;
  if (const auto mode = keys.optional("mode"))
    levels.mode = static_cast<MapMode>(mode->one_of({"trinary", "scale", "raw"}));
  levels.negate = read_negate(keys.required("negate"));
  const CheckedValue occupied = keys.required("occupied_thresh"), free = keys.required("free_thresh");
  levels.occupied_threshold = occupied.number({.low = 0.0, .high = 1.0});
  levels.free_threshold = free.number({.low = 0.0, .high = 1.0});
  if (levels.free_threshold > levels.occupied_threshold)
    free.fail("free_thresh: is above occupied_thresh; expected at most " + std::to_string(levels.occupied_threshold));
  if (levels.mode == MapMode::kScale && levels.free_threshold == levels.occupied_threshold)
    free.fail("free_thresh: equals occupied_thresh; mode scale needs room between the two");
  return levels;
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

const char* name_of(MapMode mode) {
  switch (mode) {
    case MapMode::kTrinary: return "trinary";
    case MapMode::kScale: return "scale";
    case MapMode::kRaw: return "raw";
  }
  return "?";
}

std::string yaml_of(const OccupancyMap& map, const std::string& image, MapMode mode) {
  std::string text = "image: " + image + "\nmode: " + name_of(mode) + "\nresolution: ";
  append_fixed(text, map.resolution_m, kMapDecimals);
  text += "\norigin: [";
  append_fixed(text, map.origin_x_m, kMapDecimals);
  text += ", ";
  append_fixed(text, map.origin_y_m, kMapDecimals);
  text += ", ";
  append_fixed(text, map.origin_yaw_rad, kMapDecimals);
  text += "]\nnegate: 0\noccupied_thresh: ";
  append_shortest(text, mode == MapMode::kScale ? 1.0 - kScaleMargin : kOccupiedThreshold);
  text += "\nfree_thresh: ";
  append_shortest(text, mode == MapMode::kScale ? kScaleMargin : kFreeThreshold);
  return text + "\n";
}

void check_writable(const OccupancyMap& map) {
  if (map.width <= 0 || map.height <= 0 || map.cells.size() != static_cast<std::size_t>(map.width) * map.height)
    throw std::invalid_argument("an occupancy map of " + std::to_string(map.width) + " x " +
                                std::to_string(map.height) + " cells holds " + std::to_string(map.cells.size()));
  if (!(map.resolution_m > 0.0) || !std::isfinite(map.resolution_m) || !std::isfinite(map.origin_x_m) ||
      !std::isfinite(map.origin_y_m) || !std::isfinite(map.origin_yaw_rad))
    throw std::invalid_argument("an occupancy map to be written has a resolution or an origin that is none");
}

bool is_known(std::int8_t cell) { return cell >= 0 && cell <= 100; }

char trinary_grey(std::int8_t cell) {
  if (!is_known(cell)) return kUnknownGrey;
  if (cell <= std::lround(kFreeThreshold * 100.0)) return kFreeGrey;
  return cell >= std::lround(kOccupiedThreshold * 100.0) ? kOccupiedGrey : kUnknownGrey;
}

char raw_grey(std::int8_t cell) { return static_cast<char>(is_known(cell) ? cell : 255); }

/// Top row first.
template <typename Grey>
std::string to_pgm(const OccupancyMap& map, Grey grey) {
  std::string pgm = "P5\n# CREATOR: Credo\n" + std::to_string(map.width) + ' ' + std::to_string(map.height) + "\n255\n";
  pgm.reserve(pgm.size() + map.cells.size());
  for (int row = map.height - 1; row >= 0; --row)
    for (int column = 0; column < map.width; ++column) pgm.push_back(grey(map.at(column, row)));
  return pgm;
}

std::string to_scale_png(const OccupancyMap& map) {
  const cv::Vec4b transparent(127, 127, 127, 0);
  cv::Mat picture(map.height, map.width, CV_8UC4);
  for (int row = 0; row < map.height; ++row)
    for (int column = 0; column < map.width; ++column) {
      const std::int8_t cell = map.at(column, map.height - 1 - row);
      const auto grey = static_cast<std::uint8_t>(std::lround(2.55 * (100 - cell)));
      picture.at<cv::Vec4b>(row, column) = is_known(cell) ? cv::Vec4b(grey, grey, grey, 255) : transparent;
    }
  std::vector<std::uint8_t> png;
  cv::imencode(".png", picture, png);
  return {png.begin(), png.end()};
}

/// The rectangle of a grid as a map without cells.
OccupancyMap frame_of(const grids::EvidentialGrid& grid, const grids::CellBox& box) {
  const grids::Georeference& reference = grid.georeference();
  return {.width = box.width,
          .height = box.height,
          .resolution_m = reference.resolution_m,
          .origin_x_m = reference.origin_x_m + box.min.x * reference.resolution_m,
          .origin_y_m = reference.origin_y_m + box.min.y * reference.resolution_m,
          .origin_yaw_rad = 0.0,
          .cells = {}};
}

}  // namespace

OccupancyMap to_occupancy(const grids::EvidentialGrid& grid, const grids::DecisionParams& params) {
  const grids::CellBox box = grids::picture_box(grid);
  OccupancyMap map = frame_of(grid, box);
  const std::vector<grids::CellState> states = grids::decisions(grid, box, params);
  map.cells.reserve(states.size());
  for (const grids::CellState state : states)
    map.cells.push_back(state == grids::CellState::kEmpty      ? OccupancyMap::kFree
                        : state == grids::CellState::kOccupied ? OccupancyMap::kOccupied
                                                               : OccupancyMap::kUnknown);
  return map;
}

OccupancyMap to_probabilities(const grids::EvidentialGrid& grid, const grids::DecisionParams& params) {
  const grids::CellBox box = grids::picture_box(grid);
  OccupancyMap map = frame_of(grid, box);
  const std::vector<float> occupied = grids::layer(grid, box, grids::Layer::kProbabilityOccupied);
  const std::vector<float> unknown = grids::layer(grid, box, grids::Layer::kUnknown);
  map.cells.reserve(occupied.size());
  for (std::size_t i = 0; i < occupied.size(); ++i)
    map.cells.push_back(unknown[i] > params.unknown_above
                            ? OccupancyMap::kUnknown
                            : static_cast<std::int8_t>(std::lround(100.0F * occupied[i])));
  return map;
}

OccupancyMap read_map(const std::filesystem::path& yaml, MapRules rules) {
  const CheckedMap keys =
      load_yaml(yaml).map({"image", "resolution", "origin", "occupied_thresh", "free_thresh", "negate", "mode"});
  OccupancyMap map;
  map.resolution_m = keys.required("resolution").number(kPositiveLength);
  const geometry::Pose2 origin = keys.required("origin").pose();
  map.origin_x_m = origin.x;
  map.origin_y_m = origin.y;
  map.origin_yaw_rad = origin.theta;
  const Levels levels = read_levels(keys);
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
      map.cells.push_back(rules == MapRules::kNav2 ? interpret_nav2(pixel, levels) : interpret_ros1(pixel, levels));
    }
  }
  return map;
}

void write_map(const OccupancyMap& map, const std::filesystem::path& yaml, MapMode mode) {
  check_writable(map);
  const bool scale = mode == MapMode::kScale;
  const std::filesystem::path image = std::filesystem::path(yaml).replace_extension(scale ? ".png" : ".pgm");
  write_file_whole(image, scale ? to_scale_png(map) : to_pgm(map, mode == MapMode::kRaw ? raw_grey : trinary_grey));
  write_file_whole(yaml, yaml_of(map, image.filename().string(), mode));
}

}  // namespace credo::datasets
