#include "undine/engine/list_codes.hpp"

#include <algorithm>

namespace undine {

template <int N>
void ListCodes<N>::choose_unit(const Box<N>& box, double list_radius, const Domain<N>& domain) {
  const double unit = list_radius / units_per_radius;
  per_unit_ = 1 / unit;
  // A difference of codes is off by at most one unit, and by half a unit more across a period.
  double off_sq = 0, far = 0;
  for (int k = 0; k < N; ++k) {
    const bool periodic = domain.periodic[k];
    const double low = periodic ? domain.low[k] : box.low[k], high = periodic ? domain.high[k] : box.high[k];
    origin_[k] = low;
    period_[k] = periodic ? std::max<std::int64_t>(1, std::llround((high - low) * per_unit_)) : 0;
    off_sq += sq(periodic ? 1.5 : 1.0);
    far = std::max({far, std::abs(low), std::abs(high)});
  }
  // Far from the origin positions themselves are rounded. Beyond 2^33 units that is no use any more.
  off_ = std::sqrt(off_sq) * (1 + 1e-6) + std::min(0x1p-50 * far * per_unit_, 0.125 * units_per_radius);
  const double radius = units_per_radius + off_;
  limit_ = limit_of(radius);
  search_radius_ = (radius + off_ + 1e-3) * unit;
  own_limits_.clear();
}

template <int N>
void ListCodes<N>::encode(std::span<const Vec<N>> points) {
  for (auto& lines : words_) lines.resize((points.size() + CodeLine::size - 1) / CodeLine::size);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < points.size(); ++i) {
    const CodeWords<N> codes = words(points[i]);
    for (int w = 0; w < code_words(N); ++w) words_[w][i / CodeLine::size].words[i % CodeLine::size] = codes[w];
  }
}

template <int N>
void ListCodes<N>::encode_radii(std::span<const double> radii) {
  own_limits_.resize((radii.size() + CodeLine::size - 1) / CodeLine::size);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < radii.size(); ++i)
    own_limits_[i / CodeLine::size].words[i % CodeLine::size] =
        static_cast<std::int32_t>(limit_of(units_of(radii[i]) + off_));
}

template <int N>
PairTest<N> ListCodes<N>::test(const Vec<N, bool>& short_period) const {
  PairTest<N> test{};
  for (int w = 0; w < code_words(N); ++w) test.codes[w] = words_[w].empty() ? nullptr : words_[w].front().words;
  test.limit = limit();
  test.limits = own_limits();
  for (int k = 0; k < 2 * code_words(N); ++k) {
    const bool is_short = k < N && short_period[std::min(k, N - 1)];
    test.short_period = test.short_period || is_short;
    put(test.periods, k, is_short ? period_[std::min(k, N - 1)] : 0xffff);
  }
  return test;
}

template class ListCodes<1>;
template class ListCodes<2>;
template class ListCodes<3>;

}  // namespace undine
