// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>
#include <string_view>

#include "datasets/format_error.hpp"

namespace credo::datasets {

/// Decodes an 8-bit image to grey levels (CV_8UC1); colours by the usual luminance weights.
/// \param width_px, height_px  expected size; 0 = any
/// \throws FormatError: missing, not an image, truncated, not 8 bits deep, of another size.
[[nodiscard]] cv::Mat read_grey_image(const std::filesystem::path& file, int width_px = 0, int height_px = 0);

/// Checks what can be known without decoding: the file is there and not empty; a PNG has its size in the header and its
/// end at the end.
/// \throws FormatError as read_grey_image().
void check_image_file(const std::filesystem::path& file, int width_px, int height_px);

/// Checks that an encoded picture is whole, so that the decoder finds nothing to complain about on the standard error
/// stream: a PNG by the checksums of its chunks, a binary PGM or PPM by its size. Of other formats nothing is known.
/// \throws FormatError
void check_whole(const std::filesystem::path& file, std::string_view bytes);

/// What `work` returns; where it complains of an image, the complaint begins with the row of the table that lists it.
template <typename Work>
auto with_row(const std::filesystem::path& table, int line, const Work& work) {
  try {
    return work();
  } catch (const FormatError& error) {
    throw FormatError(table, line, std::string("lists an image that cannot be used: ") + error.what());
  }
}

}  // namespace credo::datasets
