// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <span>

namespace credo::evidence {

/// The masses that a closed rule combines: a list in braces, or any contiguous range. A view, for parameters only.
template <typename Mass>
class SourceList {
 public:
  SourceList(std::initializer_list<Mass> list) : masses_(list.begin(), list.size()) {}
  template <std::convertible_to<std::span<const Mass>> Range>
  SourceList(const Range& masses) : masses_(masses) {}

  [[nodiscard]] std::size_t size() const { return masses_.size(); }
  [[nodiscard]] auto begin() const { return masses_.begin(); }
  [[nodiscard]] auto end() const { return masses_.end(); }
  [[nodiscard]] const Mass& operator[](std::size_t i) const { return masses_[i]; }
  [[nodiscard]] std::span<const Mass> span() const { return masses_; }

 private:
  std::span<const Mass> masses_;
};

}  // namespace credo::evidence
