// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <array>
#include <bit>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace credo::evidence {

/// An element of a power set or hyper-power set: a set of Venn regions of a frame, one bit each. Intersection is &,
/// union is |. Which regions there are, and which of them exist, the Frame knows. A trivial value of 32 bytes.
class Proposition {
 public:
  static constexpr std::size_t kMaxRegions = 256;

  constexpr Proposition() = default;  ///< the empty set

  /// The region alone. Precondition: index < kMaxRegions.
  [[nodiscard]] static constexpr Proposition region(std::size_t index) {
    Proposition result;
    result.words_[index / 64] = std::uint64_t{1} << (index % 64);
    return result;
  }
  /// The regions 0 .. count - 1. Precondition: count <= kMaxRegions.
  [[nodiscard]] static constexpr Proposition first(std::size_t count) {
    Proposition result;
    for (std::size_t word = 0; word < kWords && count > 64 * word; ++word) {
      const std::size_t here = count - 64 * word;
      result.words_[word] = here >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << here) - 1;
    }
    return result;
  }
  /// The regions 0 .. 63 from the bits of a number: on a power set of up to 64 elements, the subset of that index.
  [[nodiscard]] static constexpr Proposition from_bits(std::uint64_t bits) { return Proposition({bits, 0, 0, 0}); }

  [[nodiscard]] constexpr std::uint64_t low_bits() const { return words_[0]; }  ///< inverse of from_bits
  [[nodiscard]] constexpr bool empty() const { return (words_[0] | words_[1] | words_[2] | words_[3]) == 0; }
  [[nodiscard]] constexpr std::size_t count() const {
    std::size_t bits = 0;
    for (const std::uint64_t word : words_) bits += static_cast<std::size_t>(std::popcount(word));
    return bits;
  }
  /// Precondition: region < kMaxRegions.
  [[nodiscard]] constexpr bool contains(std::size_t region) const {
    return (words_[region / 64] >> (region % 64) & 1) != 0;
  }
  [[nodiscard]] constexpr bool subset_of(const Proposition& other) const { return (*this - other).empty(); }
  [[nodiscard]] constexpr bool meets(const Proposition& other) const { return !(*this & other).empty(); }

  friend constexpr Proposition operator&(Proposition a, const Proposition& b) {
    for (std::size_t i = 0; i < kWords; ++i) a.words_[i] &= b.words_[i];
    return a;
  }
  friend constexpr Proposition operator|(Proposition a, const Proposition& b) {
    for (std::size_t i = 0; i < kWords; ++i) a.words_[i] |= b.words_[i];
    return a;
  }
  /// The regions of a that are not in b.
  friend constexpr Proposition operator-(Proposition a, const Proposition& b) {
    for (std::size_t i = 0; i < kWords; ++i) a.words_[i] &= ~b.words_[i];
    return a;
  }
  constexpr Proposition& operator&=(const Proposition& other) { return *this = *this & other; }
  constexpr Proposition& operator|=(const Proposition& other) { return *this = *this | other; }

  friend constexpr bool operator==(const Proposition&, const Proposition&) = default;
  /// As the numbers whose bits are the regions.
  friend constexpr std::strong_ordering operator<=>(const Proposition& a, const Proposition& b) {
    for (std::size_t i = kWords; i-- > 1;) {
      if (a.words_[i] != b.words_[i]) return a.words_[i] <=> b.words_[i];
    }
    return a.words_[0] <=> b.words_[0];
  }

  [[nodiscard]] constexpr std::size_t hash() const {
    std::uint64_t mixed = 0;
    for (const std::uint64_t word : words_) {
      mixed = (mixed ^ word) * 0x9E3779B97F4A7C15u;  // 2^64 / golden ratio: spreads neighbouring sets
      mixed ^= mixed >> 32;
    }
    return mixed;
  }

 private:
  static constexpr std::size_t kWords = kMaxRegions / 64;
  explicit constexpr Proposition(const std::array<std::uint64_t, kWords>& words) : words_(words) {}

  std::array<std::uint64_t, kWords> words_{};
};

}  // namespace credo::evidence

template <>
struct std::hash<credo::evidence::Proposition> {
  std::size_t operator()(const credo::evidence::Proposition& set) const noexcept { return set.hash(); }
};
