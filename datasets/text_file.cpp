// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/text_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <stdexcept>
#include <string>

#include "datasets/format_error.hpp"

namespace credo::datasets {
namespace {

[[noreturn]] void fail_to_write(const std::filesystem::path& file) {
  throw std::runtime_error(file.string() +
                           ": cannot be written; check that its folder exists, may be written to and has space left");
}

/// An empty file beside it, `file`.0.partial or with the next number that is free: of this writer alone.
std::filesystem::path make_file_beside(const std::filesystem::path& file) {
  constexpr int kMostWriters = 1000;
  for (int i = 0; i < kMostWriters; ++i) {
    std::filesystem::path name = file;
    name += "." + std::to_string(i) + ".partial";
    const int descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) {
      ::close(descriptor);
      return name;
    }
    if (errno != EEXIST) break;
  }
  fail_to_write(file);
}

/// Has the kernel bring a file to the disk: else a crash after the rename may leave the new name and no content.
bool is_on_disk(const std::filesystem::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool done = ::fsync(descriptor) == 0;
  ::close(descriptor);
  return done;
}

}  // namespace

std::ifstream open_binary_file(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw FormatError(file, 0, "there is no such file");
  if (std::filesystem::is_directory(status)) throw FormatError(file, 0, "is a folder; expected a file");
  std::ifstream in(file, std::ios::binary);
  if (!in) throw FormatError(file, 0, "cannot be read; check its permissions");
  return in;
}

std::string read_binary_file(const std::filesystem::path& file) {
  std::ifstream in = open_binary_file(file);
  in.seekg(0, std::ios::end);
  const std::streamoff size = static_cast<std::streamoff>(in.tellg());
  if (size < 0) throw FormatError(file, 0, "cannot be read; check its permissions");
  std::string content(static_cast<std::size_t>(size), '\0');
  in.seekg(0);
  in.read(content.data(), static_cast<std::streamsize>(size));
  if (in.gcount() != size) throw FormatError(file, 0, "could not be read to its end");
  return content;
}

std::string read_text_file(const std::filesystem::path& file) {
  std::string content = read_binary_file(file);
  if (content.starts_with("\xEF\xBB\xBF")) content.erase(0, 3);
  if (const auto zero = content.find('\0'); zero != std::string::npos) {
    const auto line = 1 + std::count(content.begin(), content.begin() + static_cast<std::ptrdiff_t>(zero), '\n');
    throw FormatError(file, static_cast<int>(line), "holds a zero byte: this is no text file");
  }
  return content;
}

void write_file_whole(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write) {
  const std::filesystem::path temporary = make_file_beside(file);
  try {
    std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
    if (out) write(out);
    out.close();
    if (!out || !is_on_disk(temporary)) fail_to_write(file);
    std::error_code error;
    std::filesystem::rename(temporary, file, error);
    if (error) fail_to_write(file);
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw;
  }
}

void write_file_whole(const std::filesystem::path& file, std::string_view content) {
  write_file_whole(
      file, [content](std::ostream& out) { out.write(content.data(), static_cast<std::streamsize>(content.size())); });
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  std::string quote(text.substr(0, kLongest));
  std::replace_if(
      quote.begin(), quote.end(), [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 127; }, '?');
  return "'" + quote + (text.size() > kLongest ? "..." : "") + "'";
}

}  // namespace credo::datasets
