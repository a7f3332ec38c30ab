// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "results/belief_tiff.hpp"

#include <bit>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

#include "datasets/little_endian.hpp"
#include "datasets/text_file.hpp"
#include "grids/readout.hpp"

namespace credo::results {
namespace {

constexpr int kChannels = 4;
constexpr std::size_t kHeaderBytes = 8;
constexpr std::size_t kPixelBytes = kChannels * sizeof(float);
constexpr std::string_view kDescription = "m(empty), m(occupied), contested or m(conflict), m(unknown)";

// TIFF revision 6.0: field types and tags.
constexpr std::uint16_t kAscii = 2, kShort = 3, kLong = 4;
constexpr std::uint16_t kWidth = 256, kHeight = 257, kBitsPerSample = 258, kCompression = 259, kPhotometric = 262,
                        kImageDescription = 270, kStripOffsets = 273, kSamplesPerPixel = 277, kRowsPerStrip = 278,
                        kStripByteCounts = 279, kPlanarConfiguration = 284, kExtraSamples = 338, kSampleFormat = 339;

using datasets::put_little_endian;

std::uint32_t get(std::string_view bytes, std::size_t at, int count) {
  return static_cast<std::uint32_t>(datasets::get_little_endian(bytes, at, count));
}

/// The directory of an image file: fields in the order of their tags, values of more than four bytes behind them.
class Directory {
 public:
  /// \param place  of the directory in the file
  explicit Directory(std::size_t place, int fields)
      : extra_place_(place + 2 + 12 * static_cast<std::size_t>(fields) + 4) {
    put_little_endian(fields_, static_cast<std::uint32_t>(fields), 2);
  }
  void number(std::uint16_t tag, std::uint16_t type, std::uint32_t value) {
    head(tag, type, 1);
    put_little_endian(fields_, value, 4);  // a short stands in the lower half
  }
  void shorts(std::uint16_t tag, std::initializer_list<std::uint16_t> values) {
    std::string bytes;
    for (const std::uint16_t value : values) put_little_endian(bytes, value, 2);
    head(tag, kShort, static_cast<std::uint32_t>(values.size()));
    put_behind(bytes);
  }
  void text(std::uint16_t tag, std::string_view value) {
    head(tag, kAscii, static_cast<std::uint32_t>(value.size() + 1));
    put_behind(std::string(value) + '\0');
  }
  [[nodiscard]] std::string bytes() const { return fields_ + std::string(4, '\0') + behind_; }

 private:
  void head(std::uint16_t tag, std::uint16_t type, std::uint32_t count) {
    put_little_endian(fields_, tag, 2);
    put_little_endian(fields_, type, 2);
    put_little_endian(fields_, count, 4);
  }
  void put_behind(std::string bytes) {
    if (bytes.size() % 2 != 0) bytes.push_back('\0');  // offsets are even
    put_little_endian(fields_, static_cast<std::uint32_t>(extra_place_ + behind_.size()), 4);
    behind_ += bytes;
  }

  std::size_t extra_place_;
  std::string fields_;
  std::string behind_;
};

std::string directory_of(const BeliefImage& image, std::size_t place) {
  const auto data_bytes = static_cast<std::uint32_t>(image.pixels.size() * kPixelBytes);
  Directory directory(place, 13);
  directory.number(kWidth, kLong, static_cast<std::uint32_t>(image.width));
  directory.number(kHeight, kLong, static_cast<std::uint32_t>(image.height));
  directory.shorts(kBitsPerSample, {32, 32, 32, 32});
  directory.number(kCompression, kShort, 1);  // none
  directory.number(kPhotometric, kShort, 1);  // black is zero: the first channel is a grey picture
  directory.text(kImageDescription, kDescription);
  directory.number(kStripOffsets, kLong, kHeaderBytes);
  directory.number(kSamplesPerPixel, kShort, kChannels);
  directory.number(kRowsPerStrip, kLong, static_cast<std::uint32_t>(image.height));
  directory.number(kStripByteCounts, kLong, data_bytes);
  directory.number(kPlanarConfiguration, kShort, 1);  // interleaved
  directory.shorts(kExtraSamples, {0, 0, 0});         // of no colour
  directory.shorts(kSampleFormat, {3, 3, 3, 3});      // IEEE float
  return directory.bytes();
}

/// The numeric fields of the first directory; of lists the first value.
std::map<std::uint16_t, std::uint32_t> read_fields(std::string_view bytes, const std::string& file) {
  const auto broken = [&file] { return std::runtime_error(file + ": is cut short or no little-endian TIFF file"); };
  if (bytes.size() < kHeaderBytes || bytes.substr(0, 4) != std::string_view("II*\0", 4)) throw broken();
  const std::size_t place = get(bytes, 4, 4);
  if (place + 2 > bytes.size()) throw broken();
  const std::size_t count = get(bytes, place, 2);
  if (place + 2 + 12 * count > bytes.size()) throw broken();
  std::map<std::uint16_t, std::uint32_t> fields;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = place + 2 + 12 * i;
    const std::uint32_t type = get(bytes, at + 2, 2), values = get(bytes, at + 4, 4);
    if (type != kShort && type != kLong) continue;
    const int size = type == kShort ? 2 : 4;
    std::size_t value = at + 8;
    const std::uint64_t list_bytes = std::uint64_t{values} * static_cast<std::uint64_t>(size);
    if (list_bytes > 4) value = get(bytes, value, 4);
    if (values == 0 || value + list_bytes > bytes.size()) throw broken();
    fields[static_cast<std::uint16_t>(get(bytes, at, 2))] = get(bytes, value, size);
  }
  return fields;
}

}  // namespace

BeliefImage belief_image(const grids::EvidentialGrid& grid, BeliefChannels channels) {
  using grids::Layer;
  const grids::CellBox box = grids::picture_box(grid);
  const bool raw = channels == BeliefChannels::kRaw;
  const std::array<Layer, kChannels> layers =
      raw ? std::array{Layer::kRawEmpty, Layer::kRawOccupied, Layer::kRawConflict, Layer::kRawUnknown}
          : std::array{Layer::kEmpty, Layer::kOccupied, Layer::kContested, Layer::kUnknown};
  BeliefImage image{.width = box.width, .height = box.height, .pixels = {}};
  image.pixels.resize(static_cast<std::size_t>(box.width) * box.height);
  for (int channel = 0; channel < kChannels; ++channel) {
    const std::vector<float> values = grids::layer(grid, box, layers[channel]);
    for (int row = 0; row < box.height; ++row)
      for (int column = 0; column < box.width; ++column)
        image.pixels[static_cast<std::size_t>(box.height - 1 - row) * box.width + column][channel] =
            values[static_cast<std::size_t>(row) * box.width + column];
  }
  return image;
}

void write_belief_tiff(const BeliefImage& image, const std::filesystem::path& file) {
  if (image.width <= 0 || image.height <= 0 ||
      image.pixels.size() != static_cast<std::size_t>(image.width) * image.height)
    throw std::invalid_argument("a belief picture of " + std::to_string(image.width) + " x " +
                                std::to_string(image.height) + " pixels holds " + std::to_string(image.pixels.size()));
  if (image.pixels.size() * kPixelBytes > 0xFFFF'0000U)
    throw std::runtime_error(file.string() + ": the map is too large for a TIFF file; choose a coarser resolution");
  const std::size_t place = kHeaderBytes + image.pixels.size() * kPixelBytes;
  std::string bytes("II*\0", 4);
  bytes.reserve(place + 512);
  put_little_endian(bytes, static_cast<std::uint32_t>(place), 4);
  for (const std::array<float, kChannels>& pixel : image.pixels)
    for (const float value : pixel) put_little_endian(bytes, std::bit_cast<std::uint32_t>(value), 4);
  bytes += directory_of(image, place);
  datasets::write_file_whole(file, bytes);
}

BeliefImage read_belief_tiff(const std::filesystem::path& file) {
  const std::string bytes = datasets::read_binary_file(file);
  std::map<std::uint16_t, std::uint32_t> fields = read_fields(bytes, file.string());
  const bool ours = fields[kBitsPerSample] == 32 && fields[kCompression] == 1 &&
                    fields[kSamplesPerPixel] == kChannels && fields[kPlanarConfiguration] == 1 &&
                    fields[kSampleFormat] == 3 && fields[kRowsPerStrip] >= fields[kHeight] && fields[kWidth] > 0 &&
                    fields[kHeight] > 0;
  if (!ours)
    throw std::runtime_error(file.string() +
                             ": is a TIFF file of another kind; expected four interleaved 32-bit floats " +
                             "per pixel, one strip, not compressed");
  const std::uint64_t count = std::uint64_t{fields[kWidth]} * fields[kHeight];
  const std::uint64_t begin = fields[kStripOffsets];
  if (begin > bytes.size() || count > (bytes.size() - begin) / kPixelBytes)
    throw std::runtime_error(file.string() + ": is cut short: holds less than its " + std::to_string(count) +
                             " pixels");
  BeliefImage image{
      .width = static_cast<int>(fields[kWidth]), .height = static_cast<int>(fields[kHeight]), .pixels = {}};
  image.pixels.resize(count);
  std::size_t at = begin;
  for (std::array<float, kChannels>& pixel : image.pixels)
    for (float& value : pixel) {
      value = std::bit_cast<float>(get(bytes, at, 4));
      at += sizeof(float);
    }
  return image;
}

}  // namespace credo::results
