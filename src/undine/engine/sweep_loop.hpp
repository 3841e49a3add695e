#pragma once
#include <algorithm>
#include <span>

#include "undine/core/flatten.hpp"
#include "undine/core/isa.hpp"
#include "undine/core/lanes.hpp"
#include "undine/core/shifted.hpp"
#include "undine/engine/pair_sweep.hpp"
#include "undine/engine/position_code.hpp"

namespace undine {
namespace detail {

template <class T>
inline constexpr int numbers_in = 1;
template <int N, class T>
inline constexpr int numbers_in<Vec<N, T>> = N* numbers_in<T>;

/// Calls f(index, number) for each number of a value, with the index, counted from `first`, as a constant: sums kept in
/// an array under constant indices stay in registers.
template <int first, class T, class F>
[[gnu::always_inline]] inline void for_each_indexed(T& value, F&& f) {
  if constexpr (is_vec<std::remove_const_t<T>>) {
    constexpr int count = static_cast<int>(sizeof(value.c) / sizeof(value.c[0]));
    constexpr int width = numbers_in<std::remove_cvref_t<decltype(value.c[0])>>;
    [&]<int... K>(std::integer_sequence<int, K...>) __attribute__((always_inline)) {
      (for_each_indexed<first + K * width>(value.c[K], f), ...);
    }
    (std::make_integer_sequence<int, count>{});
  } else {
    f(std::integral_constant<int, first>{}, value);
  }
}

/// The type in which a term sees a field: densities in float are kept as deviations.
template <int N, class Tag, class V>
using pair_value = std::conditional_t<std::is_same_v<Tag, field::rho> && std::is_same_v<scalar_of<V>, float>,
                                      Shifted<V>, typename Tag::template value<N, V>>;
template <int N, class V, class List>
struct PairRowOf;
template <int N, class V, class... F>
struct PairRowOf<N, V, Fields<F...>> {
  using type = typename Fields<F...>::template Made<pair_value<N, F, V>...>;
};

/// Where the numbers of one field begin among those of all fields of a list.
template <int N, class Tag, class... F>
constexpr int offset_of(Fields<F...>) {
  int at = 0;
  bool found = false;
  ((found = found || std::is_same_v<F, Tag>, at += found ? 0 : F::info.components(N)), ...);
  return at;
}

template <int N, class... F>
constexpr int components_of(Fields<F...>) {
  return (F::info.components(N) + ... + 0);
}

template <class U>
auto usual_reads() {
  if constexpr (U::presence == Presence::rare) {
    return Fields<>{};
  } else if constexpr (requires { typename U::Term::usual_reads; }) {
    return typename U::Term::usual_reads{};
  } else {
    return typename U::Term::reads{};
  }
}
template <class U>
using usual_reads_of = decltype(usual_reads<U>());

/// Power of a contribution to a rate: force times velocity for `acc` and `acc_wall`, m p / rho^2 times the rate for a
/// density rate (the work that compression stores), nothing for any other field.
template <class Tag, class Target, class Value>
double power_of(const Target& a, const Value& rate) {
  if constexpr (std::is_same_v<Tag, field::acc> || std::is_same_v<Tag, field::acc_wall>) {
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
  /// Fields that nearly every run needs come first in a record; the others are loaded where a term in use reads them.
  using UsualReads = Union<detail::usual_reads_of<Uses>...>;
  using Reads = Union<UsualReads, typename Uses::Term::reads...>;
  using Adds = Union<typename Uses::Term::adds...>;
  using Records = AlignedVector<scalar_of<V>>;

  SweepLoop(const SweepContext<N>& context, std::tuple<Uses...>& uses, Records& records)
      : context_(context), uses_(uses), records_(records), code_(context.domain, context.neighbours.list_radius()) {}

  void run(Group target, Booking booking) {
    fill_records();
    const IndexRange targets = context_.store.range(target);
    const std::size_t blocks = (targets.size() + targets_per_block - 1) / targets_per_block;
    std::vector<Powers> powers(booking == Booking::on ? blocks : 0);
#pragma omp parallel
    {
      std::vector<std::uint32_t> scratch;
#pragma omp for schedule(dynamic, 1)
      for (std::size_t block = 0; block < blocks; ++block) {
        const std::size_t first = block * targets_per_block;
        const IndexRange some{first, std::min(targets.size(), first + targets_per_block)};
        Powers power{};
        if (context_.support.per_particle) {
          sweep_targets<true>(target, some, booking, scratch, power);
        } else {
          sweep_targets<false>(target, some, booking, scratch, power);
        }
        if (booking == Booking::on) powers[block] = power;
      }
    }
    if (booking == Booking::on) add_up(powers, std::index_sequence_for<Uses...>{});
  }

 private:
  using Real = scalar_of<V>;
  static constexpr int lanes = lanes_of<V>;
  static constexpr std::size_t targets_per_block = 128;
  using Powers = std::array<Power, sizeof...(Uses)>;
  using SourceRow = typename detail::PairRowOf<N, V, Reads>::type;
  using TargetRow = typename detail::PairRowOf<N, Real, Reads>::type;
  using Totals = typename Adds::template Row<N, double>;
  using BookRow = Fields<field::m, field::v, field::p, field::rho>::Row<N, double>;
  template <std::size_t I>
  using UseAt = std::tuple_element_t<I, std::tuple<Uses...>>;

  /// The sums of all uses side by side; those of use I begin at `first_sum<I>`.
  template <std::size_t I>
  static constexpr int first_sum = []<std::size_t... J>(std::index_sequence<J...>) {
    return (detail::components_of<N>(typename UseAt<J>::Term::adds{}) + ... + 0);
  }
  (std::make_index_sequence<I>{});
  static constexpr int sum_count = first_sum<sizeof...(Uses)>;

  static constexpr int width = N + 1 + detail::components_of<N>(Reads{});  // position and support radius come first
  static constexpr int stride = (width + 3) / 4 * 4;
  static constexpr int usual = (N + 1 + detail::components_of<N>(UsualReads{}) + 3) / 4 * 4;

  /// Whether a term in use reads a field past the usual ones.
  bool reads_unusual() const {
    const FieldSet in_use =
        std::apply([](const auto&... use) { return (reads_in_use(use) | ... | FieldSet{}); }, uses_);
    bool found = false;
    Reads::for_each([&]<class F>(F) {
      constexpr int end = N + 1 + detail::offset_of<N, F>(Reads{}) + F::info.components(N);
      found = found || (end > usual && in_use[F::id]);
    });
    return found;
  }

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
        if (!store.fields()[F::id]) {  // no term in use reads it
          record += n;
          return;
        }
        const double* from = store.raw(F::id).data() + i * n;
        const double shift = is_shifted<detail::pair_value<N, F, V>> ? context_.rho_reference : 0;
        for (int k = 0; k < n; ++k) *record++ = static_cast<Real>(from[k] - shift);
      });
    }
  }

  /// Fills a row from a record's numbers, of one particle or of one per lane.
  template <class Row, class Number>
  [[gnu::always_inline]] static void load_row(Row& row, const Number* numbers, Real rho_reference) {
    Reads::for_each([&]<class F>(F) __attribute__((always_inline)) {
      constexpr int first = N + 1 + detail::offset_of<N, F>(Reads{});
      if constexpr (is_shifted<std::remove_cvref_t<decltype(F::of(row))>>) {
        F::of(row) = {numbers[first], Number(rho_reference)};
      } else {
        detail::for_each_indexed<first>(
            F::of(row), [&](auto k, auto& number) __attribute__((always_inline)) { number = numbers[k]; });
      }
    });
  }

  /// What stays the same over all pairs of a sweep, in registers or on the stack of the loop.
  struct Frame {
    const Real* records;
    detail::PositionCode<N, Real> code;
    std::tuple<Uses...> uses;
    std::array<KernelChoice, kernel_roles> kernels;
    Symmetrisation mean;
    Real H, inv_H, h_over_H, rho_reference;
    bool unusual;  ///< a term reads fields past the usual ones
  };

  /// Everything is inlined here and works on copies, so that sums and constants stay in registers.
  template <bool per_particle>
  UNDINE_FLATTEN void sweep_targets(Group group, IndexRange some, Booking booking, std::vector<std::uint32_t>& scratch,
                                    Powers& power) {
    auto& store = context_.store;
    const auto& support = context_.support;
    const Frame frame{records_.data(),
                      code_,
                      uses_,
                      context_.kernels,
                      support.mean,
                      static_cast<Real>(support.uniform),
                      static_cast<Real>(1 / support.uniform),
                      static_cast<Real>(1 / support.kappa),
                      static_cast<Real>(context_.rho_reference),
                      reads_unusual()};
    const std::size_t begin = store.range(group).begin;
    for (std::size_t target = some.begin; target < some.end; ++target) {
      const std::size_t a = begin + target;
      BookRow book{};
      if (booking == Booking::on) {
        book.m = store.template get<field::m>()[a];
        book.v = store.template get<field::v>()[a];
        book.p = store.template get<field::p>()[a];
        book.rho = store.template get<field::rho>()[a];
      }
      Totals total{};
      for (const Group source : all_groups) {
        if (!any_acts_on(source)) continue;
        const auto list = context_.neighbours.of(group, target, source, store, scratch);
        if (list.empty()) continue;
        V sums[sum_count]{};
        sum_over<per_particle>(frame, source, a, list, sums);
        collect(source, sums, total, booking, book, power, std::index_sequence_for<Uses...>{});
      }
      Adds::for_each([&]<class F>(F) { store.template get<F>()[a] = F::of(total); });
    }
  }

  bool any_acts_on(Group source) const {
    return context_.sources[static_cast<int>(source)] &&
           std::apply([&](const auto&... use) { return (use.acts_on(source) || ...); }, uses_);
  }

  template <bool per_particle>
  [[gnu::always_inline]] static void sum_over(const Frame& frame, Group source, std::size_t a,
                                              std::span<const std::uint32_t> list, V (&sums)[sum_count]) {
    const Real* record = frame.records + a * stride;
    Vec<N, Real> x_a;
    for (int k = 0; k < N; ++k) x_a[k] = record[k];
    TargetRow row_a;
    load_row(row_a, record, frame.rho_reference);
    // Lanes past the end of the list repeat its last entry at distance 2 H, where every kernel is zero.
    std::uint32_t tail[lanes];
    for (std::size_t at = 0; at < list.size(); at += lanes) {
      const std::uint32_t* block = list.data() + at;
      const int valid = static_cast<int>(std::min<std::size_t>(lanes, list.size() - at));
      if (valid < lanes) {
        for (int k = 0; k < lanes; ++k) tail[k] = block[std::min(k, valid - 1)];
        block = tail;
      }
      one_block<per_particle>(frame, source, x_a, record[N], row_a, block, valid, sums);
    }
  }

  /// `lanes` neighbours at once, of which the first `valid` count.
  template <bool per_particle>
  [[gnu::always_inline]] static void one_block(const Frame& frame, Group source, const Vec<N, Real>& x_a, Real h_a,
                                               const TargetRow& row_a, const std::uint32_t* block, int valid,
                                               V (&sums)[sum_count]) {
    V numbers[stride];
    detail::LoadLanes<V, stride>::template load<0, usual>(frame.records, block, numbers);
    if constexpr (usual < stride) {
      if (frame.unusual) [[unlikely]]
        detail::LoadLanes<V, stride>::template load<usual, stride>(frame.records, block, numbers);
    }
    Vec<N, V> x_b;
    for (int k = 0; k < N; ++k) x_b[k] = numbers[k];
    SourceRow row_b;
    load_row(row_b, numbers, frame.rho_reference);

    const Vec<N, V> dx = frame.code.template difference<V>(x_a, x_b);
    V H, inv_H;
    if constexpr (per_particle) {
      H = pair_support<V>(frame.mean, h_a, numbers[N]);
      inv_H = V(1) / H;
    } else {
      H = V(frame.H);
      inv_H = V(frame.inv_H);
    }
    V r_sq = norm_sq(dx);
    if (valid < lanes) r_sq = pad(r_sq, valid, H);
    const V r = sqrt(r_sq);
    const V h = H * V(frame.h_over_H);
    const PairBase<N, V> base{dx, r, r_sq, H, h, V(1) / (r_sq + V(0.01) * h * h), r_sq < H * H};
    evaluate(frame, source, row_a, row_b, base, inv_H, sums, std::index_sequence_for<Uses...>{});
  }

  [[gnu::always_inline]] static V pad(const V& r_sq, int valid, const V& H) {
    if constexpr (lanes == 1) {
      return r_sq;
    } else {
      return select(V::generate([](int k) { return static_cast<Real>(k); }) < V(valid), r_sq, V(4) * H * H);
    }
  }

  /// W and (dW/dr)/r of one kernel.
  struct KernelValues {
    V w, grad;
  };
  [[gnu::always_inline]] static KernelValues kernel_values(KernelChoice kernel, const V& R, const V& inv_H) {
    V inv_H_n = inv_H;
    for (int k = 1; k < N; ++k) inv_H_n = inv_H_n * inv_H;
    return kernel.visit([&]<class Kernel>(Kernel) __attribute__((always_inline)) {
      return KernelValues{Kernel::template w<N>(R) * inv_H_n,
                          Kernel::template slope_over_R<N>(R) * (inv_H_n * inv_H * inv_H)};
    });
  }

  template <std::size_t... I>
  [[gnu::always_inline]] static void evaluate(const Frame& frame, Group source, const TargetRow& a, const SourceRow& b,
                                              const PairBase<N, V>& base, const V& inv_H, V (&sums)[sum_count],
                                              std::index_sequence<I...>) {
    // Most schemes use one kernel for all roles: it is then evaluated once.
    const V R = base.r * inv_H;
    const auto& kernels = frame.kernels;
    constexpr int first_role = std::min({static_cast<int>(Uses::role)...});
    const KernelValues first = kernel_values(kernels[first_role], R, inv_H);
    const auto one = [&]<std::size_t J>(std::integral_constant<std::size_t, J>) __attribute__((always_inline)) {
      using U = UseAt<J>;
      const U& use = std::get<J>(frame.uses);
      if (!use.acts_on(source)) return;
      constexpr int role = static_cast<int>(U::role);
      KernelValues values = first;
      if constexpr (role != first_role) {
        if (kernels[role].index() != kernels[first_role].index()) values = kernel_values(kernels[role], R, inv_H);
      }
      const Pair<N, V> ab{base, values.w, base.dx * values.grad, &kernels[role]};
      add<J>(use.term(a, b, ab), base.inside, sums);
    };
    (one(std::integral_constant<std::size_t, I>{}), ...);
  }

  template <std::size_t I, class Row, class Mask>
  [[gnu::always_inline]] static void add(const Row& row, const Mask& inside, V (&sums)[sum_count]) {
    using Added = typename UseAt<I>::Term::adds;
    Added::for_each([&]<class F>(F) __attribute__((always_inline)) {
      constexpr int first = first_sum<I> + detail::offset_of<N, F>(Added{});
      detail::for_each_indexed<first>(
          F::of(row), [&](auto k, const auto& number) __attribute__((always_inline)) {
            if constexpr (F::info.join == Join::max) {
              sums[k] = max(sums[k], select(inside, V(number), V(0)));
            } else {
              sums[k] += number;
            }
          });
    });
  }

  /// Joins the lanes, adds to the totals, and books.
  template <std::size_t... I>
  [[gnu::always_inline]] void collect(Group source, const V (&sums)[sum_count], Totals& total, Booking booking,
                                      const BookRow& book, Powers& power, std::index_sequence<I...>) const {
    const auto one = [&]<std::size_t J>(std::integral_constant<std::size_t, J>) __attribute__((always_inline)) {
      if (!std::get<J>(uses_).acts_on(source)) return;
      using Added = typename UseAt<J>::Term::adds;
      Added::for_each([&]<class F>(F) __attribute__((always_inline)) {
        constexpr int first = first_sum<J> + detail::offset_of<N, F>(Added{});
        typename F::template value<N, double> joined{};
        detail::for_each_indexed<first>(
            joined, [&](auto k, double& number) __attribute__((always_inline)) {
              number = F::info.join == Join::max ? lane_max(sums[k]) : lane_sum(sums[k]);
            });
        if constexpr (F::info.join == Join::max) {
          F::of(total) = std::max(F::of(total), joined);
        } else {
          F::of(total) += joined;
          if (booking == Booking::on) power[J][static_cast<int>(source)] += detail::power_of<F>(book, joined);
        }
      });
    };
    (one(std::integral_constant<std::size_t, I>{}), ...);
  }

  template <std::size_t... I>
  void add_up(const std::vector<Powers>& powers, std::index_sequence<I...>) {
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

template <class Tag, int N, class... Uses>
void SweepEntry<Tag, N, Uses...>::mixed(const SweepContext<N>& context, std::tuple<Uses...>& uses,
                                        SweepRecords& records, Group target, Booking booking) {
  SweepLoop<N, Pack<float>, Uses...>(context, uses, records.single).run(target, booking);
}

template <class Tag, int N, class... Uses>
void SweepEntry<Tag, N, Uses...>::in_double(const SweepContext<N>& context, std::tuple<Uses...>& uses,
                                            SweepRecords& records, Group target, Booking booking) {
  SweepLoop<N, Pack<double>, Uses...>(context, uses, records.twice).run(target, booking);
}

template <class Tag, int N, class... Uses>
void SweepEntry<Tag, N, Uses...>::plain(const SweepContext<N>& context, std::tuple<Uses...>& uses,
                                        SweepRecords& records, Group target, Booking booking) {
  SweepLoop<N, double, Uses...>(context, uses, records.twice).run(target, booking);
}

/// Compiles the loops of a sweep where it is explicitly instantiated: in a file that is built for each instruction set.
template <class Sweep>
struct CompiledSweep;
template <int N, class... Uses>
struct CompiledSweep<PairSweep<N, Uses...>> {
  using Entry = SweepEntry<UNDINE_ISA::Tag, N, Uses...>;
  static constexpr std::array loops{&Entry::mixed, &Entry::in_double, &Entry::plain};
};

}  // namespace undine
