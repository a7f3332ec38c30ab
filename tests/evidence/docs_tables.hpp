// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "evidence/mass_function.hpp"

/// Tables of docs/evidence as the library computes them. On a page a table stands under `<!-- table: NAME -->`.
namespace credo::evidence::docs {

using Row = std::vector<std::string>;

inline std::string markdown(const Row& header, const std::vector<Row>& rows) {
  const auto line = [](const Row& cells) {
    std::string text = "|";
    for (const std::string& cell : cells) text += " " + cell + " |";
    return text + "\n";
  };
  std::string text = line(header) + "|---";
  for (std::size_t i = 1; i < header.size(); ++i) text += "|---:";
  text += "|\n";
  for (const Row& row : rows) text += line(row);
  return text;
}

/// Three decimals, or two digits and a power of ten where these would show nothing; 0 is exactly that.
inline std::string number(double value) {
  if (value == 0.0) return "0";
  char text[32];
  std::snprintf(text, sizeof text, std::abs(value) < 5e-4 ? "%.1e" : "%.3f", value);
  return text;
}

struct NamedMass {
  std::string name;
  MassFunction mass;
};

/// A row for each mass function, a column for each set.
inline std::string masses(const std::vector<std::string>& sets, const std::vector<NamedMass>& rows) {
  Row header{""};
  header.insert(header.end(), sets.begin(), sets.end());
  std::vector<Row> cells;
  for (const NamedMass& row : rows) {
    cells.push_back({row.name});
    for (const std::string& set : sets) cells.back().push_back(number(row.mass.mass(set)));
  }
  return markdown(header, cells);
}

/// A page of docs/evidence.
class Page {
 public:
  explicit Page(const std::string& name) : path_(std::string(CREDO_SOURCE_DIR) + "/docs/evidence/" + name) {
    std::ifstream file(path_);
    if (!file) throw std::runtime_error("cannot read " + path_);
    text_.assign(std::istreambuf_iterator<char>(file), {});
  }

  /// The names of the tables, in their order.
  std::vector<std::string> tables() const {
    std::vector<std::string> names;
    for (std::size_t at = text_.find(kMark); at != std::string::npos; at = text_.find(kMark, at + 1)) {
      const std::size_t begin = at + kMark.size();
      names.push_back(text_.substr(begin, text_.find(" -->", begin) - begin));
    }
    return names;
  }
  /// The lines under the mark that begin with |. \throws std::runtime_error if there is no such mark
  std::string table(const std::string& name) const { return text_.substr(begin_of(name), size_of(name)); }
  /// Writes the page.
  void replace(const std::string& name, const std::string& table) {
    text_.replace(begin_of(name), size_of(name), table);
    std::ofstream(path_) << text_;
  }

 private:
  std::size_t begin_of(const std::string& name) const {
    const std::string mark = kMark + name + " -->\n";
    const std::size_t at = text_.find(mark);
    if (at == std::string::npos) throw std::runtime_error(path_ + " has no table '" + name + "'");
    return at + mark.size();
  }
  std::size_t size_of(const std::string& name) const {
    const std::size_t begin = begin_of(name);
    std::size_t end = begin;
    while (end < text_.size() && text_[end] == '|') end = text_.find('\n', end) + 1;
    return end - begin;
  }

  inline static const std::string kMark = "<!-- table: ";
  std::string path_, text_;
};

}  // namespace credo::evidence::docs
