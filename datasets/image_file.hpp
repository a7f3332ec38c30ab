// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>

namespace credo::datasets {

/// Decodes an 8-bit image to grey levels (CV_8UC1); colours by the usual luminance weights.
/// \param width_px, height_px  expected size; 0 = any
/// \throws FormatError: missing, not an image, truncated, not 8 bits deep, of another size.
[[nodiscard]] cv::Mat read_grey_image(const std::filesystem::path& file, int width_px = 0, int height_px = 0);

/// Checks what can be known without decoding: the file is there and not empty; a PNG has its size in the header and its
/// end at the end.
/// \throws FormatError as read_grey_image().
void check_image_file(const std::filesystem::path& file, int width_px, int height_px);

}  // namespace credo::datasets
