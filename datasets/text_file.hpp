// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>

namespace credo::datasets {

/// The whole of a text file, in one read; a byte order mark at its start is left out.
/// \throws FormatError if it is missing, a folder, not readable, or holds a zero byte (then it is not text)
[[nodiscard]] std::string read_text_file(const std::filesystem::path& file);
/// The same for any file, as bytes.
[[nodiscard]] std::string read_binary_file(const std::filesystem::path& file);
/// Any file, to be read in parts.
/// \throws FormatError if it is missing, a folder, or not readable
[[nodiscard]] std::ifstream open_binary_file(const std::filesystem::path& file);

/// Writes a file whole: into a temporary one beside it, of a name that no other writer has, that is brought to the disk
/// and takes its name at the end. Of several that write the same file at once one stays, whole.
/// \throws std::runtime_error if that fails; `file` is then as it was
void write_file_whole(const std::filesystem::path& file, std::string_view content);
/// The same for what is not held as a whole: `write` puts it out, and may seek.
void write_file_whole(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write);

/// `text` without the spaces, tabs and carriage returns around it.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// 'text' for a message: its start where it is long, and a '?' for each byte that cannot be printed.
[[nodiscard]] std::string in_quotes(std::string_view text);

}  // namespace credo::datasets
