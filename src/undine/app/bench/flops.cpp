#include "undine/app/bench/flops.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "undine/app/bench/peak.hpp"
#include "undine/engine/pair.hpp"
#include "undine/terms/catalogue.hpp"

namespace undine {
namespace {

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A number that counts what is done with it. Every result of a term is one, whatever it began with.
struct Counting {
  double value = 0;
  inline static long count = 0;

  Counting() = default;
  template <class S>
  requires std::is_arithmetic_v<S> Counting(S s) : value(static_cast<double>(s)) {}

  static Counting counted(double result) {
    ++count;
    return result;
  }
  friend Counting operator+(const Counting& a, const Counting& b) { return counted(a.value + b.value); }
  friend Counting operator-(const Counting& a, const Counting& b) { return counted(a.value - b.value); }
  friend Counting operator*(const Counting& a, const Counting& b) { return counted(a.value * b.value); }
  friend Counting operator/(const Counting& a, const Counting& b) { return counted(a.value / b.value); }
  friend Counting operator-(const Counting& a) { return -a.value; }
  Counting& operator+=(const Counting& o) { return *this = *this + o; }
  friend bool operator<(const Counting& a, const Counting& b) { return a.value < b.value; }
  friend bool operator>(const Counting& a, const Counting& b) { return a.value > b.value; }
  friend bool operator<=(const Counting& a, const Counting& b) { return a.value <= b.value; }
  friend bool operator>=(const Counting& a, const Counting& b) { return a.value >= b.value; }
  friend Counting select(bool mask, const Counting& yes, const Counting& no) { return mask ? yes : no; }
  friend Counting max(const Counting& a, const Counting& b) { return std::max(a.value, b.value); }
  friend Counting min(const Counting& a, const Counting& b) { return std::min(a.value, b.value); }
  friend Counting positive_part(const Counting& a) { return std::max(a.value, 0.0); }
  friend Counting negative_part(const Counting& a) { return std::min(a.value, 0.0); }
  friend Counting abs(const Counting& a) { return std::abs(a.value); }
  friend Counting sqrt(const Counting& a) { return counted(std::sqrt(a.value)); }
};

using Row = Union<terms::PressureSymmetric::reads, terms::Continuity::reads, terms::ViscosityMonaghan::reads,
                  terms::DiffusionFourtakas::reads, terms::Xsph::reads>::Row<3, Counting>;

/// A term, and the additions that join what it gives to the sums.
template <class Term>
void count_term(const Term& term, const Row& a, const Row& b, const Pair<3, Counting>& ab) {
  const auto row = term(a, b, ab);
  Term::adds::for_each([&]<class F>(F) {
    if constexpr (F::info.join == Join::sum) {
      typename F::template value<3, Counting> sum{};
      sum += F::of(row);
    }
  });
}

}  // namespace

double flops_per_pair(Group source) {
  Counting::count = 0;
  const Counting H = 1, inv_h = 1;
  Row a, b;
  for (Row* row : {&a, &b}) {
    row->m = 1;
    row->rho = 1000;
    row->p = 1;
    row->c = 30;
  }
  const Vec<3, Counting> x_a{{0.1, 0.2, 0.3}}, x_b{{0, 0, 0}};
  // The pair itself, as the sweep makes it for a uniform support: difference, distance, kernel and its gradient.
  const Vec<3, Counting> dx = x_a - x_b;
  const Counting r_sq = norm_sq(dx), r = sqrt(r_sq), R = r * inv_h;
  using Kernel = NormedKernel<WendlandC2>;
  const Counting w = Kernel::w<3>(R) * 1.0, grad = Kernel::slope_over_R<3>(R) * 1.0;
  const PairBase<3, Counting> base{.dx = dx,
                                   .r = r,
                                   .r_sq = r_sq,
                                   .support = H,
                                   .h = 0.5,
                                   .inv_r_sq = Counting(1) / (r_sq + 0.25),
                                   .inv_rho = Counting(1) / (0.5 * (a.rho + b.rho)),
                                   .inside = r_sq < H};
  const Pair<3, Counting> ab{base, w, dx * grad, nullptr};

  count_term(terms::PressureSymmetric{}, a, b, ab);
  count_term(terms::Continuity{}, a, b, ab);
  count_term(terms::ViscosityMonaghan{}, a, b, ab);
  count_term(terms::ApproachSpeed{}, a, b, ab);
  if (source == Group::fluid) {
    count_term(terms::DiffusionFourtakas{}, a, b, ab);
    count_term(terms::Xsph{}, a, b, ab);
  }
  return static_cast<double>(Counting::count);
}

double measured_bandwidth(int threads) {
  constexpr std::ptrdiff_t n = 1 << 23;
  const auto a = std::make_unique_for_overwrite<double[]>(n), b = std::make_unique_for_overwrite<double[]>(n),
             c = std::make_unique_for_overwrite<double[]>(n);
  double *const to = a.get(), *const x = b.get(), *const y = c.get();
  // Pages lie near the thread that touches them first.
#pragma omp parallel for num_threads(threads) schedule(static)
  for (std::ptrdiff_t i = 0; i < n; ++i) to[i] = x[i] = y[i] = 1;
  double best = 0;
  for (int repeat = 0; repeat < 5; ++repeat) {
    const double factor = 1e-3 * repeat;
    const double start = seconds_now();
#pragma omp parallel for num_threads(threads) schedule(static)
    for (std::ptrdiff_t i = 0; i < n; ++i) to[i] = x[i] + factor * y[i];
    const double seconds = seconds_now() - start;
    if (to[n / 2] > 0) best = std::max(best, 24.0 * n / seconds);  // asking keeps the loop from being left out
  }
  return best;
}

double measured_fma_peak(PairPrecision precision, int threads) {
  return with_instructions(best_instructions(), [&]<class Tag>() { return fma_peak<Tag>(precision, threads); });
}

}  // namespace undine
