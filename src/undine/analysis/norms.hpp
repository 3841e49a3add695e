#pragma once
#include <cmath>
#include <limits>
#include <span>

namespace undine {

/// The distance between a computed field f and a reference g, over particles of volume V:
///   L1 = sum V |f - g| / sum V,   L2 = sqrt(sum V |f - g|^2 / sum V),   Linf = max |f - g|.
/// `relative` is of L2: sqrt(sum V |f - g|^2 / sum V |g|^2), infinite where the reference is zero everywhere.
struct Norms {
  double l1 = 0, l2 = 0, linf = 0;
  double relative = 0;
};

/// Gathers norms particle by particle; sums of parts can be added. Vectors enter by their lengths |f - g| and |g|.
class NormSums {
 public:
  void add(double volume, double difference, double reference) {
    const double d = std::abs(difference);
    volume_ += volume;
    first_ += volume * d;
    second_ += volume * d * d;
    reference_ += volume * reference * reference;
    largest_ = larger(largest_, d);
  }
  NormSums& operator+=(const NormSums& o) {
    volume_ += o.volume_;
    first_ += o.first_;
    second_ += o.second_;
    reference_ += o.reference_;
    largest_ = larger(largest_, o.largest_);
    return *this;
  }
  /// NaN where nothing was added.
  Norms norms() const {
    if (!(volume_ > 0)) {
      constexpr double nan = std::numeric_limits<double>::quiet_NaN();
      return {nan, nan, nan, nan};
    }
    const double relative = second_ == 0 ? 0 : std::sqrt(second_ / reference_);
    return {first_ / volume_, std::sqrt(second_ / volume_), largest_, relative};
  }

 private:
  /// The larger of two; NaN if one is.
  static double larger(double a, double b) { return b > a || std::isnan(b) ? b : a; }

  double volume_ = 0, first_ = 0, second_ = 0, reference_ = 0, largest_ = 0;
};

/// Norms of f - g with the given volumes; the three spans are of one length.
inline Norms error_norms(std::span<const double> volumes, std::span<const double> f, std::span<const double> g) {
  NormSums sums;
  for (std::size_t i = 0; i < f.size(); ++i) sums.add(volumes[i], f[i] - g[i], g[i]);
  return sums.norms();
}

}  // namespace undine
