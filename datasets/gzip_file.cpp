// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/gzip_file.hpp"

#include <zlib.h>

#include <array>
#include <memory>

#include "datasets/format_error.hpp"

namespace credo::datasets {
namespace {

struct CloseGz {
  void operator()(gzFile file) const { gzclose(file); }
};

}  // namespace

std::string read_unpacked(const std::filesystem::path& file, std::size_t limit) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) throw FormatError(file, 0, "there is no such file");
  const std::unique_ptr<gzFile_s, CloseGz> in(gzopen(file.c_str(), "rb"));
  if (!in) throw FormatError(file, 0, "cannot be read; check its permissions");
  std::string content;
  std::array<char, 1 << 16> buffer{};
  while (content.size() < limit) {
    const int got = gzread(in.get(), buffer.data(), buffer.size());
    int code = Z_OK;
    (void)gzerror(in.get(), &code);
    if (got < 0 || (code != Z_OK && code != Z_STREAM_END))
      throw FormatError(file, 0, "is truncated or damaged; expected a whole file, plain or gzipped");
    if (got == 0) return content;
    content.append(buffer.data(), static_cast<std::size_t>(got));
  }
  return content;
}

}  // namespace credo::datasets
