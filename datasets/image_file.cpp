// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/image_file.hpp"

#include <zlib.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "datasets/format_error.hpp"
#include "datasets/text_file.hpp"

namespace credo::datasets {
namespace {

using namespace std::string_view_literals;
constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1A\n"sv;
constexpr std::string_view kPngEnd = "\0\0\0\0IEND\xAE\x42\x60\x82"sv;
constexpr std::size_t kPngHeaderSize = 24;  ///< signature, length and name of IHDR, width, height

int big_endian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (const char byte : bytes.substr(0, 4)) value = value << 8 | static_cast<unsigned char>(byte);
  return static_cast<int>(value);
}

std::string size_text(int width, int height) { return std::to_string(width) + " x " + std::to_string(height); }

void check_size(const std::filesystem::path& file, int width, int height, int expected_width, int expected_height) {
  if ((expected_width != 0 && width != expected_width) || (expected_height != 0 && height != expected_height))
    throw FormatError(file, 0,
                      "the image is " + size_text(width, height) + " px; expected " +
                          size_text(expected_width, expected_height) + " px, the camera's resolution");
}

[[noreturn]] void fail_truncated(const std::filesystem::path& file) {
  throw FormatError(file, 0, "the image is truncated or damaged; expected a whole PNG");
}

/// \param head, tail  the first and last bytes of the file
void check_png(const std::filesystem::path& file, std::string_view head, std::string_view tail, int width, int height) {
  if (!head.starts_with(kPngSignature)) return;
  if (head.size() < kPngHeaderSize || !tail.ends_with(kPngEnd)) fail_truncated(file);
  check_size(file, big_endian(head.substr(16)), big_endian(head.substr(20)), width, height);
}

/// Walks through the chunks of a PNG, so that damage is found by their checksums and not complained about by libpng on
/// the standard error stream.
void check_png_chunks(const std::filesystem::path& file, std::string_view bytes) {
  if (!bytes.ends_with(kPngEnd)) fail_truncated(file);
  constexpr std::size_t kFrame = 12;  // length, name and checksum
  for (std::size_t at = kPngSignature.size(); at < bytes.size();) {
    const std::size_t left = bytes.size() - at;
    const auto length =
        static_cast<std::size_t>(static_cast<std::uint32_t>(left < 4 ? 0 : big_endian(bytes.substr(at))));
    if (left < kFrame || length > left - kFrame) fail_truncated(file);
    const auto* const data = reinterpret_cast<const Bytef*>(bytes.data() + at + 4);
    const auto checksum = static_cast<std::uint32_t>(crc32(crc32(0, nullptr, 0), data, static_cast<uInt>(length + 4)));
    if (checksum != static_cast<std::uint32_t>(big_endian(bytes.substr(at + 8 + length)))) fail_truncated(file);
    at += kFrame + length;
  }
}

/// The next number of the header of a PGM; comments are skipped. Zero where there is none.
std::uint64_t header_number(std::string_view& left) {
  while (!left.empty()) {
    if (left.front() == '#')
      left.remove_prefix(std::min(left.find('\n'), left.size()));
    else if (std::isspace(static_cast<unsigned char>(left.front())) != 0)
      left.remove_prefix(1);
    else
      break;
  }
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(left.data(), left.data() + left.size(), value);
  left.remove_prefix(static_cast<std::size_t>(end - left.data()));
  constexpr std::uint64_t kLargest = 1 << 24;
  return error == std::errc{} && value <= kLargest ? value : 0;
}

/// A binary PGM or PPM (P5, P6): "P5 width height largest", one space, and the pixels.
void check_pnm_size(const std::filesystem::path& file, std::string_view bytes) {
  std::string_view left = bytes.substr(2);
  const std::uint64_t width = header_number(left), height = header_number(left), largest = header_number(left);
  const std::uint64_t channels = bytes.starts_with("P6") ? 3 : 1;
  const std::uint64_t expected = width * height * channels * (largest > 255 ? 2 : 1);
  const std::uint64_t found = left.empty() ? 0 : left.size() - 1;
  if (expected == 0) throw FormatError(file, 0, "the header of this picture is damaged; expected a whole PGM or PPM");
  if (found < expected)
    throw FormatError(file, 0,
                      "the picture is cut short: it has " + std::to_string(found) + " of " + std::to_string(expected) +
                          " bytes; expected a whole PGM or PPM");
}

}  // namespace

void check_whole(const std::filesystem::path& file, std::string_view bytes) {
  if (bytes.starts_with(kPngSignature)) check_png_chunks(file, bytes);
  if (bytes.starts_with("P5") || bytes.starts_with("P6")) check_pnm_size(file, bytes);
}

void check_image_file(const std::filesystem::path& file, int width_px, int height_px) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw FormatError(file, 0, "there is no such image");
  std::ifstream in(file, std::ios::binary);
  std::string head(kPngHeaderSize, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  if (head.empty()) throw FormatError(file, 0, "is empty or cannot be read; expected an image");
  if (head.size() < kPngHeaderSize) fail_truncated(file);
  std::string tail(kPngEnd.size(), '\0');
  in.seekg(-static_cast<std::streamoff>(tail.size()), std::ios::end);
  in.read(tail.data(), static_cast<std::streamsize>(tail.size()));
  check_png(file, head, tail, width_px, height_px);
}

cv::Mat read_grey_image(const std::filesystem::path& file, int width_px, int height_px) {
  std::string bytes = read_binary_file(file);
  if (bytes.empty()) throw FormatError(file, 0, "is empty; expected an image");
  check_png(file, bytes, bytes, width_px, height_px);
  check_whole(file, bytes);
  const cv::Mat encoded(1, static_cast<int>(bytes.size()), CV_8UC1, bytes.data());
  cv::Mat image;
  try {
    image = cv::imdecode(encoded, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    image.release();
  }
  if (image.empty()) throw FormatError(file, 0, "cannot be decoded: truncated, damaged or no image");
  if (image.depth() != CV_8U)
    throw FormatError(file, 0, "the image is not 8 bits deep; expected 8-bit grey or 8-bit colour");
  check_size(file, image.cols, image.rows, width_px, height_px);
  cv::Mat grey;
  switch (image.channels()) {
    case 1: return image;
    case 3: cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY); return grey;
    case 4: cv::cvtColor(image, grey, cv::COLOR_BGRA2GRAY); return grey;
    default:
      throw FormatError(file, 0,
                        "the image has " + std::to_string(image.channels()) + " channels; expected grey or colour");
  }
}

}  // namespace credo::datasets
