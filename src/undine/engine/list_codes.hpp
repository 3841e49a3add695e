#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "undine/engine/candidates.hpp"
#include "undine/search/cell_frame.hpp"

namespace undine {

/// Positions of all particles at the time of a list build as whole numbers of a unit, and the test that decides who is
/// on whose list: the sum of squared differences is below a limit. Whole numbers give the same lists on every machine,
/// by every search and in any order of arithmetic. Vector code sees the low 16 bits: candidates are never so far away
/// that they would come out wrong.
///
/// Points may have list radii of their own. Two are then tested by the larger of theirs, which is off by two units of
/// the largest.
template <int N>
class ListCodes {
 public:
  /// Units in the largest list radius: four radii fit into 16 bits with a sign, and half of all squares into 31.
  static constexpr double units_per_radius = 8192;

  /// Chooses the unit for points in a box. Every pair nearer than `list_radius` (in m) will pass the test, and none
  /// that is farther apart than `search_radius`. No point has a radius of its own until `encode_radii`.
  void choose_unit(const Box<N>& box, double list_radius, const Domain<N>& domain);
  void encode(std::span<const Vec<N>> points);
  /// Radii of the points' own, in m, none larger than that of the unit.
  void encode_radii(std::span<const double> radii);

  /// Not more than 1.001 list radii, but where double itself is coarser, in m.
  double search_radius() const { return search_radius_; }
  /// That of a point with a list radius of its own.
  double search_radius(double own) const { return (units_of(own) + 2 * off_ + 1e-3) / per_unit_; }

  /// The code words of a position.
  CodeWords<N> words(const Vec<N>& x) const {
    CodeWords<N> words;
    for (int k = 0; k < N; ++k) put(words, k, code(k, x[k]));
    return words;
  }
  /// What to add to codes that lie `image` periods away.
  CodeWords<N> image_words(const Vec<N, int>& image) const {
    CodeWords<N> words;
    for (int k = 0; k < N; ++k) put(words, k, image[k] * period_[k]);
    return words;
  }
  /// What the sum of squared differences must be less than: for the largest list radius, and for that of a point.
  std::int32_t limit() const { return static_cast<std::int32_t>(limit_); }
  std::int32_t limit(std::size_t point) const {
    return own_limits_.empty() ? limit() : own_limits_[point / CodeLine::size].words[point % CodeLine::size];
  }
  /// The limits of all points, where they have their own.
  const std::int32_t* own_limits() const { return own_limits_.empty() ? nullptr : own_limits_.front().words; }
  /// The test itself, for any two positions, by the nearest image.
  bool near(const Vec<N>& a, const Vec<N>& b, std::int32_t limit) const {
    std::int64_t sum = 0;
    for (int k = 0; k < N; ++k) {
      std::int64_t d = std::abs(code(k, a[k]) - code(k, b[k]));
      if (period_[k] > 0) d = std::min(d % period_[k], period_[k] - d % period_[k]);
      sum += sq(std::min(d, std::int64_t{1} << 20));
    }
    return sum < limit;
  }

  /// For vector code; `short_period` says along which axes either side may be the nearer one.
  PairTest<N> test(const Vec<N, bool>& short_period) const;
  std::size_t bytes() const {
    return (words_[0].capacity() * code_words(N) + own_limits_.capacity()) * sizeof(CodeLine);
  }

 private:
  std::int64_t code(int k, double x) const {
    const double units = (x - origin_[k]) * per_unit_;
    const double safe = units < 0x1p61 ? (units > -0x1p61 ? units : -0x1p61) : 0x1p61;
    return static_cast<std::int64_t>(std::nearbyint(safe));
  }
  /// A list radius in units; what is not a number counts as the largest.
  double units_of(double radius) const {
    const double units = radius * per_unit_;
    return units < units_per_radius ? std::max(units, 0.0) : units_per_radius;
  }
  static std::int64_t limit_of(double units) { return static_cast<std::int64_t>(sq(units)) + 1; }
  static void put(CodeWords<N>& words, int axis, std::int64_t number) {
    const auto low = static_cast<std::uint32_t>(static_cast<std::uint16_t>(number));
    words[axis / 2] |= static_cast<std::int32_t>(low << (axis % 2 * 16));
  }

  Vec<N> origin_;
  double per_unit_ = 0, search_radius_ = 0;
  double off_ = 0;            ///< how far differences of codes may be off, in units
  std::int64_t period_[N]{};  ///< 0 along an axis that is not periodic
  std::int64_t limit_ = 0;
  std::array<std::vector<CodeLine>, code_words(N)> words_;
  std::vector<CodeLine> own_limits_;
};

extern template class ListCodes<1>;
extern template class ListCodes<2>;
extern template class ListCodes<3>;

}  // namespace undine
