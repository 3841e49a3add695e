#pragma once
#include <algorithm>
#include <array>
#include <string>
#include <tuple>
#include <vector>

#include "undine/core/flatten.hpp"
#include "undine/core/pack.hpp"
#include "undine/engine/lanes.hpp"
#include "undine/engine/neighbours.hpp"
#include "undine/engine/pair.hpp"
#include "undine/engine/position_code.hpp"
#include "undine/engine/smoothing.hpp"

namespace undine {

/// Power of a rate, per source group: what a term does to the energy of the targets, in W.
using Power = std::array<double, group_count>;

/// A term at its place in a sweep: which kernel it takes, and from which groups it sums.
template <class TermType, KernelRole kernel_role = KernelRole::density>
struct Use {
  using Term = TermType;
  static constexpr KernelRole role = kernel_role;

  TermType term{};
  bool active = true;
  std::array<bool, group_count> sources{true, true};
  Power power{};  ///< filled by a booked sweep

  bool acts_on(Group source) const { return active && sources[static_cast<int>(source)]; }
};

/// The fields that a term reads of its target: all that it reads, unless it says otherwise.
template <class Term>
FieldSet target_reads_of() {
  if constexpr (requires { typename Term::target_reads; }) {
    return Term::target_reads::set();
  } else {
    return Term::reads::set();
  }
}

/// Everything a sweep needs to know of the run.
template <int N>
struct SweepContext {
  Store<N>& store;
  const Neighbours<N>& neighbours;
  const Domain<N>& domain;
  Support support;
  std::array<KernelChoice, kernel_roles> kernels;
};

/// Whether a sweep books the power of its terms (needs v, m, p, rho of the targets).
enum class Booking { off, on };

namespace detail {

/// Calls f(number) for each number of a scalar, vector or tensor value.
template <class T, class F>
void for_each_number(T& value, F&& f) {
  if constexpr (is_vec<std::remove_const_t<T>>) {
    for (auto& part : value.c) for_each_number(part, f);
  } else {
    f(value);
  }
}

/// Power of a contribution to a rate: force times velocity for `acc`, m p / rho^2 times the rate for a density rate
/// (the work that compression stores), nothing for any other field.
template <class Tag, class Target, class Value>
double power_of(const Target& a, const Value& rate) {
  if constexpr (std::is_same_v<Tag, field::acc>) {
    return a.m * dot(a.v, rate);
  } else if constexpr (std::is_same_v<Tag, field::drho> || std::is_same_v<Tag, field::drho_diff>) {
    return a.m * a.p / sq(a.rho) * rate;
  } else {
    return 0.0;
  }
}

}  // namespace detail

/// The pair loop: sums (or maxima) of all uses over the neighbours of each target of one group, written to the store.
/// `V` is the value type of the pair arithmetic: double (plain), or a pack. Targets are independent and each sums in
/// the order of its list, so the result does not depend on the number of threads.
template <int N, class V, class... Uses>
class SweepLoop {
 public:
  using Reads = Union<typename Uses::Term::reads...>;
  using Adds = Union<typename Uses::Term::adds...>;
  using Records = std::vector<scalar_of<V>>;

  SweepLoop(const SweepContext<N>& context, std::tuple<Uses...>& uses, Records& records)
      : context_(context), uses_(uses), records_(records), code_(context.domain, context.neighbours.list_radius()) {}

  void run(Group target, Booking booking) {
    fill_records();
    const IndexRange targets = context_.store.range(target);
    const std::size_t blocks = (targets.size() + targets_per_block - 1) / targets_per_block;
    std::vector<std::array<Power, sizeof...(Uses)>> powers(booking == Booking::on ? blocks : 0);
#pragma omp parallel
    {
      std::vector<std::uint32_t> scratch;
#pragma omp for schedule(dynamic, 1)
      for (std::size_t block = 0; block < blocks; ++block) {
        std::array<Power, sizeof...(Uses)> power{};
        const std::size_t last = std::min(targets.size(), (block + 1) * targets_per_block);
        for (std::size_t t = block * targets_per_block; t < last; ++t) one_target(target, t, booking, scratch, power);
        if (booking == Booking::on) powers[block] = power;
      }
    }
    if (booking == Booking::on) add_up(powers, std::index_sequence_for<Uses...>{});
  }

 private:
  using Real = scalar_of<V>;
  static constexpr int lanes = lanes_of<V>;
  static constexpr std::size_t targets_per_block = 128;
  static constexpr std::size_t use_count = sizeof...(Uses);
  using RowOfReads = typename Reads::template Row<N, V>;
  using TargetRow = typename Reads::template Row<N, Real>;
  template <class U, class T>
  using Sums = typename U::Term::adds::template Row<N, T>;
  using AllSums = std::tuple<Sums<Uses, V>...>;
  using BookRow = Fields<field::m, field::v, field::p, field::rho>::Row<N, double>;

  static constexpr int components() {
    int n = N + 1;  // position and support radius
    Reads::for_each([&]<class F>(F) { n += F::info.components(N); });
    return n;
  }
  static constexpr int width = components();
  /// Records start on vector boundaries as far as that costs little.
  static constexpr int stride = (width + 3) / 4 * 4;

  /// One compact record per particle: position code, support radius, then the fields that the terms read.
  void fill_records() {
    const auto& store = context_.store;
    records_.resize(store.size() * stride);
    const auto x = store.template get<field::x>();
    const auto h = store.template get<field::h>();
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < store.size(); ++i) {
      Real* record = records_.data() + i * stride;
      for (const Real part : code_.encode(x[i]).c) *record++ = part;
      *record++ = static_cast<Real>(context_.support.per_particle ? h[i] : context_.support.uniform);
      Reads::for_each([&]<class F>(F) {
        constexpr int n = F::info.components(N);
        const double* from = store.raw(F::id).data() + i * n;
        for (int k = 0; k < n; ++k) *record++ = static_cast<Real>(from[k]);
      });
    }
  }

  template <class T, class Load>
  static void load_row(T& row, Load&& load) {
    int at = N + 1;
    Reads::for_each(
        [&]<class F>(F) { detail::for_each_number(F::of(row), [&](auto& number) { number = load(at++); }); });
  }

  void one_target(Group group, std::size_t target, Booking booking, std::vector<std::uint32_t>& scratch,
                  std::array<Power, use_count>& power) {
    auto& store = context_.store;
    const std::size_t a = store.range(group).begin + target;
    const Real* record = records_.data() + a * stride;
    Vec<N, Real> x_a;
    for (int k = 0; k < N; ++k) x_a[k] = record[k];
    TargetRow row_a;
    load_row(row_a, [&](int k) { return record[k]; });
    BookRow book{};
    if (booking == Booking::on) {
      book.m = store.template get<field::m>()[a];
      book.v = store.template get<field::v>()[a];
      book.p = store.template get<field::p>()[a];
      book.rho = store.template get<field::rho>()[a];
    }

    typename Adds::template Row<N, double> total{};
    for (const Group source : all_groups) {
      if (!any_acts_on(source)) continue;
      const auto list = context_.neighbours.of(group, target, source, store, scratch);
      if (list.empty()) continue;
      const AllSums sums = sum_over(source, x_a, record[N], row_a, list);
      collect(source, sums, total, booking, book, power, std::index_sequence_for<Uses...>{});
    }
    Adds::for_each([&]<class F>(F) { store.template get<F>()[a] = F::of(total); });
  }

  bool any_acts_on(Group source) const {
    return std::apply([&](const auto&... use) { return (use.acts_on(source) || ...); }, uses_);
  }

  /// Sums of all uses over one list. Everything is inlined here, so that sums and constants stay in registers.
  UNDINE_FLATTEN AllSums sum_over(Group source, const Vec<N, Real>& x_a, Real h_a, const TargetRow& row_a,
                                  std::span<const std::uint32_t> list) {
    AllSums sums{};
    for (std::size_t at = 0; at < list.size(); at += lanes) one_block(source, x_a, h_a, row_a, list, at, sums);
    return sums;
  }

  /// `lanes` neighbours at once. Lanes past the end of the list repeat its last entry at distance 2 H, where every
  /// kernel is zero.
  void one_block(Group source, const Vec<N, Real>& x_a, Real h_a, const TargetRow& row_a,
                 std::span<const std::uint32_t> list, std::size_t at, AllSums& sums) {
    const Real* from[lanes];
    const int valid = static_cast<int>(std::min<std::size_t>(lanes, list.size() - at));
    const auto record_of = [&](int k) { return records_.data() + std::size_t{list[at + k]} * stride; };
    if (valid == lanes) {
      for (int k = 0; k < lanes; ++k) from[k] = record_of(k);
    } else {
      for (int k = 0; k < lanes; ++k) from[k] = record_of(std::min(k, valid - 1));
    }

    V numbers[stride];
    detail::LoadLanes<V, stride>::load(from, numbers);
    Vec<N, V> x_b;
    for (int k = 0; k < N; ++k) x_b[k] = numbers[k];
    RowOfReads row_b;
    load_row(row_b, [&](int k) { return numbers[k]; });

    const Vec<N, V> dx = code_.template difference<V>(x_a, x_b);
    const auto& support = context_.support;
    const V H =
        support.per_particle ? pair_support<V>(support.mean, h_a, numbers[N]) : V(static_cast<Real>(support.uniform));
    const V inv_h = support.per_particle ? V(1) / H : V(static_cast<Real>(1.0 / support.uniform));
    V r_sq = norm_sq(dx);
    if (valid < lanes) r_sq = pad(r_sq, valid, H);
    const V r = sqrt(r_sq);
    const PairBase<N, V> base{dx, r, r_sq, H, H * V(static_cast<Real>(1.0 / support.kappa)), r_sq < H * H};
    evaluate(source, row_a, row_b, base, inv_h, sums, std::index_sequence_for<Uses...>{});
  }

  static V pad(const V& r_sq, int valid, const V& h) {
    if constexpr (lanes == 1) {
      return r_sq;
    } else {
      return select(V::generate([](int k) { return static_cast<Real>(k); }) < V(valid), r_sq, V(4) * h * h);
    }
  }

  /// W and (dW/dr)/r of one kernel.
  struct KernelValues {
    V w, grad;
  };
  KernelValues kernel_values(int role, const V& R, const V& inv_h) const {
    V inv_h_n = inv_h;
    for (int k = 1; k < N; ++k) inv_h_n = inv_h_n * inv_h;
    return context_.kernels[role].visit([&]<class Kernel>(Kernel) {
      return KernelValues{Kernel::template w<N>(R) * inv_h_n,
                          Kernel::template slope_over_R<N>(R) * (inv_h_n * inv_h * inv_h)};
    });
  }

  template <std::size_t... I>
  void evaluate(Group source, const TargetRow& a, const RowOfReads& b, const PairBase<N, V>& base, const V& inv_h,
                AllSums& sums, std::index_sequence<I...>) {
    // Most schemes use one kernel for all roles: it is then evaluated once.
    const V R = base.r * inv_h;
    const auto& kernels = context_.kernels;
    constexpr int first_role = std::min({static_cast<int>(Uses::role)...});
    const KernelValues first = kernel_values(first_role, R, inv_h);
    const auto one = [&]<class U>(U& use, Sums<U, V>& sum) {
      if (!use.acts_on(source)) return;
      constexpr int role = static_cast<int>(U::role);
      KernelValues values = first;
      if constexpr (role != first_role) {
        if (kernels[role].index() != kernels[first_role].index()) values = kernel_values(role, R, inv_h);
      }
      const Pair<N, V> ab{base, values.w, base.dx * values.grad, &kernels[role]};
      const auto row = use.term(a, b, ab);
      U::Term::adds::for_each([&]<class F>(F) {
        if constexpr (F::info.join == Join::max) {
          F::of(sum) = max(F::of(sum), select(base.inside, V(F::of(row)), V(0)));
        } else {
          F::of(sum) += F::of(row);
        }
      });
    };
    (one(std::get<I>(uses_), std::get<I>(sums)), ...);
  }

  /// Joins the lanes, adds to the totals, and books.
  template <std::size_t... I>
  void collect(Group source, const AllSums& sums, typename Adds::template Row<N, double>& total, Booking booking,
               const BookRow& book, std::array<Power, use_count>& power, std::index_sequence<I...>) {
    const auto one = [&]<class U>(const U& use, const Sums<U, V>& sum, Power& booked) {
      if (!use.acts_on(source)) return;
      U::Term::adds::for_each([&]<class F>(F) {
        typename F::template value<N, double> joined{};
        join_lanes<F::info.join>(joined, F::of(sum));
        if constexpr (F::info.join == Join::max) {
          F::of(total) = std::max(F::of(total), joined);
        } else {
          F::of(total) += joined;
          if (booking == Booking::on) booked[static_cast<int>(source)] += detail::power_of<F>(book, joined);
        }
      });
    };
    (one(std::get<I>(uses_), std::get<I>(sums), power[I]), ...);
  }

  template <Join join, class To, class From>
  static void join_lanes(To& to, const From& from) {
    if constexpr (is_vec<From>) {
      for (int k = 0; k < N; ++k) join_lanes<join>(to[k], from[k]);
    } else if constexpr (join == Join::max) {
      to = lane_max(from);
    } else {
      to = lane_sum(from);
    }
  }

  template <std::size_t... I>
  void add_up(const std::vector<std::array<Power, use_count>>& powers, std::index_sequence<I...>) {
    const auto one = [&](Power& total, std::size_t k) {
      total = {};
      for (const auto& block : powers)
        for (int g = 0; g < group_count; ++g) total[g] += block[k][g];
    };
    (one(std::get<I>(uses_).power, I), ...);
  }

  const SweepContext<N>& context_;
  std::tuple<Uses...>& uses_;
  Records& records_;
  detail::PositionCode<N, Real> code_;
};

}  // namespace undine
