#pragma once
#include <algorithm>
#include <span>

#include "undine/core/flatten.hpp"
#include "undine/core/isa.hpp"
#include "undine/core/lanes.hpp"
#include "undine/engine/pair_sweep.hpp"

namespace undine {
namespace detail {

/// Power of a contribution to a rate: force times velocity for `acc` and `acc_wall`, m p / rho^2 times the rate for a
/// density rate (the work that compression stores), m times a rate of internal energy, nothing for any other field.
template <class Tag, class Target, class Value>
double power_of(const Target& a, const Value& rate) {
  if constexpr (std::is_same_v<Tag, field::acc> || std::is_same_v<Tag, field::acc_wall>) {
    return a.m * dot(a.v, rate);
  } else if constexpr (std::is_same_v<Tag, field::drho> || std::is_same_v<Tag, field::drho_diff>) {
    return a.m * a.p / sq(a.rho) * rate;
  } else if constexpr (std::is_same_v<Tag, field::de>) {
    return a.m * rate;
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
  using Layout = RecordLayout<N, V, Uses...>;
  using Adds = Union<typename Uses::Term::adds...>;

  SweepLoop(const SweepContext<N>& context, std::tuple<Uses...>& uses)
      : context_(context), uses_(uses), code_(context.domain, context.neighbours.list_radius()) {}

  void run(const SweepTask& task) {
    const bool with_extra = reads_extra();
    records_ = Layout::fill(context_, code_, with_extra);
    const IndexRange targets = context_.store.range(task.target);
    const std::size_t blocks = (targets.size() + targets_per_block - 1) / targets_per_block;
    std::vector<Powers> powers(task.booking == Booking::on ? blocks : 0);
#pragma omp parallel
    {
      typename Neighbours<N>::Scratch scratch;
#pragma omp for schedule(dynamic, 1)
      for (std::size_t block = 0; block < blocks; ++block) {
        const std::size_t first = block * targets_per_block;
        const IndexRange some{first, std::min(targets.size(), first + targets_per_block)};
        Powers power{};
        sweep_targets(task, some, with_extra, scratch, power);
        if (task.booking == Booking::on) powers[block] = power;
      }
    }
    if (task.booking == Booking::on) add_up(powers, std::index_sequence_for<Uses...>{});
  }

 private:
  using Real = scalar_of<V>;
  static constexpr int lanes = lanes_of<V>;
  static constexpr std::size_t targets_per_block = 128;
  using Powers = std::array<Power, sizeof...(Uses)>;
  using SourceRow = typename Layout::SourceRow;
  using TargetRow = typename Layout::TargetRow;
  using Totals = typename Adds::template Row<N, double>;
  using BookRow = Fields<field::m, field::v, field::p, field::rho>::Row<N, double>;
  template <std::size_t I>
  using UseAt = std::tuple_element_t<I, std::tuple<Uses...>>;

  /// The sums of all uses side by side; those of use I begin at `first_sum<I>`.
  template <std::size_t I>
  static constexpr int first_sum = []<std::size_t... J>(std::index_sequence<J...>) {
    return (detail::record_numbers_of<N, double>(typename UseAt<J>::Term::adds{}) + ... + 0);
  }
  (std::make_index_sequence<I>{});
  static constexpr int sum_count = detail::whole_groups(first_sum<sizeof...(Uses)>);

  static constexpr int usual = Layout::usual, extra = Layout::extra;
  /// Wide float packs have a loop of their own for the usual choices; each such loop takes a minute to compile.
  static constexpr bool has_usual_path = std::is_same_v<Real, float> && lanes >= 8;

  using Wish = SupportWish<Uses...>;

  /// Whether a term in use reads a field of the extra records, or each particle has its own H.
  bool reads_extra() const {
    const FieldSet in_use =
        std::apply([](const auto&... use) { return (reads_in_use(use) | ... | FieldSet{}); }, uses_);
    bool found = Wish::only_supports || context_.support.per_particle;
    for (int f = 0; f < FieldId::count; ++f) found = found || (in_use[f] && Layout::is_extra(f));
    return found;
  }

  void sweep_targets(const SweepTask& task, IndexRange some, bool with_extra, typename Neighbours<N>::Scratch& scratch,
                     Powers& power) {
    if constexpr (Wish::only_supports) {
      sweep_on<SweepPath::supports>(task, some, true, scratch, power);
      return;
    }
    if constexpr (has_usual_path && !Wish::only_supports) {
      if (task.path == SweepPath::usual) {
        sweep_on<SweepPath::usual>(task, some, false, scratch, power);
        return;
      }
    }
    if constexpr (!Wish::only_supports) {
      if (task.path == SweepPath::supports) {
        sweep_on<SweepPath::supports>(task, some, true, scratch, power);
      } else {
        sweep_on<SweepPath::any>(task, some, with_extra, scratch, power);
      }
    }
  }

  /// What stays the same over all pairs of a sweep, in registers or on the stack of the loop.
  struct Frame {
    const Real *records, *extras;
    detail::PositionCode<N, Real> code;
    std::tuple<Uses...> uses;
    std::array<KernelChoice, kernel_roles> kernels;
    Symmetrisation mean;
    Real H, inv_H, h_over_H, rho_reference;
    bool with_extra;
    std::array<unsigned, group_count> acting;  ///< for each source group, a bit for each use that acts
  };

  /// Everything is inlined here and works on copies, so that sums and constants stay in registers.
  template <SweepPath path>
  UNDINE_FLATTEN void sweep_on(const SweepTask& task, IndexRange some, bool with_extra,
                               typename Neighbours<N>::Scratch& scratch, Powers& power) {
    auto& store = context_.store;
    const auto& support = context_.support;
    const Frame frame{records_.usual.data(),
                      records_.extra.data(),
                      code_,
                      uses_,
                      context_.kernels,
                      support.mean,
                      static_cast<Real>(support.uniform),
                      static_cast<Real>(1 / support.uniform),
                      static_cast<Real>(1 / support.kappa),
                      static_cast<Real>(context_.rho_reference),
                      with_extra,
                      {acting_on(Group::fluid), acting_on(Group::wall)}};
    const FieldSet added = adds_in_use(uses_);
    const std::size_t begin = store.range(task.target).begin;
    for (std::size_t target = some.begin; target < some.end; ++target) {
      if (!context_.wants(target)) continue;
      const std::size_t a = begin + target;
      BookRow book{};
      if (task.booking == Booking::on) {
        book.m = store.template get<field::m>()[a];
        book.v = store.template get<field::v>()[a];
        book.p = store.template get<field::p>()[a];
        book.rho = store.template get<field::rho>()[a];
      }
      Totals total{};
      for (const Group source : all_groups) {
        if (!any_acts_on(source)) continue;
        const auto list = context_.neighbours.of(task.target, target, source, store, scratch);
        if (list.empty()) continue;
        V sums[sum_count]{};
        sum_over<path>(frame, source, a, list, sums);
        collect(source, sums, total, task.booking, book, power, std::index_sequence_for<Uses...>{});
      }
      Adds::for_each([&]<class F>(F) {
        if (added[F::id]) store.template get<F>()[a] = F::of(total);
      });
    }
  }

  unsigned acting_on(Group source) const {
    unsigned bits = 0, bit = 1;
    const auto note = [&](const auto& use) {
      if (use.acts_on(source)) bits |= bit;
      bit <<= 1;
    };
    std::apply([&](const auto&... use) { (note(use), ...); }, uses_);
    return bits;
  }
  bool any_acts_on(Group source) const {
    return context_.sources[static_cast<int>(source)] &&
           std::apply([&](const auto&... use) { return (use.acts_on(source) || ...); }, uses_);
  }

  template <SweepPath path>
  [[gnu::always_inline]] static void sum_over(const Frame& frame, Group source, std::size_t a,
                                              std::span<const std::uint32_t> list, V (&sums)[sum_count]) {
    Real numbers[usual + extra]{};
    std::copy_n(frame.records + a * usual, usual, numbers);
    if (path != SweepPath::usual && frame.with_extra) std::copy_n(frame.extras + a * extra, extra, numbers + usual);
    Vec<N, Real> x_a;
    for (int k = 0; k < N; ++k) x_a[k] = numbers[k];
    TargetRow row_a;
    Layout::load(row_a, numbers, frame.rho_reference);
    const Real h_a = numbers[Layout::support_at];
    static_assert(lanes <= list_padding);
    const unsigned acting = frame.acting[static_cast<int>(source)];
    for (std::size_t at = 0; at < list.size(); at += lanes) {
      const int valid = static_cast<int>(std::min<std::size_t>(lanes, list.size() - at));
      one_block<path>(frame, acting, x_a, h_a, row_a, list.data() + at, valid, sums);
    }
  }

  /// `lanes` neighbours at once, of which the first `valid` count. The others, whoever they are, are put at distance
  /// 2 H, where every kernel is zero.
  template <SweepPath path>
  [[gnu::always_inline]] static void one_block(const Frame& frame, unsigned acting, const Vec<N, Real>& x_a, Real h_a,
                                               const TargetRow& row_a, const std::uint32_t* block, int valid,
                                               V (&sums)[sum_count]) {
    V numbers[usual + extra];
    detail::load_lanes<usual>(frame.records, block, numbers);
    if constexpr (path != SweepPath::usual) {
      if (path == SweepPath::supports || frame.with_extra)
        detail::load_lanes<extra>(frame.extras, block, numbers + usual);
    }
    Vec<N, V> x_b;
    for (int k = 0; k < N; ++k) x_b[k] = numbers[k];
    SourceRow row_b;
    Layout::load(row_b, numbers, frame.rho_reference);

    const Vec<N, V> dx = frame.code.template difference<V>(x_a, x_b);
    V H, inv_H;
    if constexpr (Wish::target) {
      H = V(h_a);
      inv_H = V(1) / H;
    } else if constexpr (path == SweepPath::supports) {
      H = pair_support<V>(frame.mean, h_a, numbers[Layout::support_at]);
      inv_H = V(1) / H;
    } else {
      H = V(frame.H);
      inv_H = V(frame.inv_H);
    }
    BothSupports both;
    if constexpr (Wish::both) both = {V(h_a), numbers[Layout::support_at]};
    V r_sq = norm_sq(dx);
    if (valid < lanes) r_sq = pad(r_sq, valid, Wish::both ? max(both.of_a, both.of_b) : H);
    const V r = sqrt(r_sq);
    const V h = H * V(frame.h_over_H);
    V inv_r_sq, inv_rho{};
    const V near = r_sq + V(0.01) * h * h;
    if constexpr (Layout::UsualReads::template has<field::rho>) {  // both quotients from one division
      const V rho = V(0.5) * (row_a.rho + row_b.rho), inverse = V(1) / (near * rho);
      inv_r_sq = inverse * rho;
      inv_rho = inverse * near;
    } else {
      inv_r_sq = V(1) / near;
      if constexpr (Layout::Reads::template has<field::rho>) inv_rho = V(2) / (row_a.rho + row_b.rho);
    }
    const PairBase<N, V> base{dx, r, r_sq, H, h, inv_r_sq, inv_rho, r_sq < H * H};
    evaluate<path>(frame, acting, row_a, row_b, base, inv_H, both, sums, std::index_sequence_for<Uses...>{});
  }

  struct BothSupports {
    V of_a, of_b;
  };

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
  template <SweepPath path>
  [[gnu::always_inline]] static KernelValues kernel_values(KernelChoice kernel, const V& R, const V& inv_H) {
    V inv_H_n = inv_H;
    for (int k = 1; k < N; ++k) inv_H_n = inv_H_n * inv_H;
    const auto values = [&]<class Kernel>(Kernel) __attribute__((always_inline)) {
      using Shape = typename Kernel::Shape;
      const V alpha = V(Shape::template alpha<N>()) * inv_H_n;
      return KernelValues{Shape::template shape<N>(R) * alpha,
                          Shape::template slope_over_R<N>(R) * (alpha * inv_H * inv_H)};
    };
    if constexpr (path == SweepPath::usual) {
      constexpr KernelChoice usual_kernel;
      return usual_kernel.visit(values);
    } else {
      return kernel.visit(values);
    }
  }

  /// Not inlined where it is needed for three supports: every kernel stands in it.
  [[gnu::noinline]] static KernelValues kernel_values_apart(KernelChoice kernel, const V& r, const V& H) {
    const V inv_H = V(1) / H;
    return kernel_values<SweepPath::supports>(kernel, r * inv_H, inv_H);
  }
  static KernelValues mean_of(const KernelValues& a, const KernelValues& b) {
    return {V(0.5) * (a.w + b.w), V(0.5) * (a.grad + b.grad)};
  }

  template <SweepPath path, std::size_t... I>
  [[gnu::always_inline]] static void evaluate(const Frame& frame, unsigned acting, const TargetRow& a,
                                              const SourceRow& b, const PairBase<N, V>& base, const V& inv_H,
                                              [[maybe_unused]] const BothSupports& both, V (&sums)[sum_count],
                                              std::index_sequence<I...>) {
    // Most schemes use one kernel for all roles: it is then evaluated once.
    [[maybe_unused]] const V R = base.r * inv_H;
    const auto& kernels = frame.kernels;
    constexpr int first_role = std::min({static_cast<int>(Uses::role)...});
    KernelValues first;
    [[maybe_unused]] KernelValues of_a, of_b;
    if constexpr (Wish::both) {
      static_assert(((static_cast<int>(Uses::role) == first_role) && ...),
                    "one kernel for all terms of a sweep that knows both supports");
      of_a = kernel_values_apart(kernels[first_role], base.r, both.of_a);
      of_b = kernel_values_apart(kernels[first_role], base.r, both.of_b);
      first = frame.mean == Symmetrisation::gradients ? mean_of(of_a, of_b)
                                                      : kernel_values_apart(kernels[first_role], base.r, base.support);
    } else {
      first = kernel_values<path>(kernels[first_role], R, inv_H);
    }
    const auto one = [&]<std::size_t J>(std::integral_constant<std::size_t, J>) __attribute__((always_inline)) {
      using U = UseAt<J>;
      const U& use = std::get<J>(frame.uses);
      if constexpr (path == SweepPath::usual && U::presence == Presence::rare) return;
      if (U::presence != Presence::always && (acting >> J & 1) == 0) return;
      constexpr int role = static_cast<int>(U::role);
      KernelValues values = first;
      if constexpr (!Wish::both && role != first_role && path != SweepPath::usual) {
        if (kernels[role].index() != kernels[first_role].index()) values = kernel_values<path>(kernels[role], R, inv_H);
      }
      const Pair<N, V> ab{base, values.w, base.dx * values.grad, &kernels[role]};
      if constexpr (Wish::both) {
        const PairOfTwo<N, V> ab_of_two{ab, base.dx * of_a.grad, base.dx * of_b.grad};
        add<J>(use.term(a, b, ab_of_two), reaches(base, both), sums);
      } else if constexpr (path == SweepPath::usual && requires { use.term.first(); }) {
        add<J>(use.term.first()(a, b, ab), base.inside, sums);
      } else {
        add<J>(use.term(a, b, ab), base.inside, sums);
      }
    };
    (one(std::integral_constant<std::size_t, I>{}), ...);
  }

  /// Whether the particles are within the support of either.
  [[gnu::always_inline]] static auto reaches(const PairBase<N, V>& base, const BothSupports& both) {
    const V H = max(both.of_a, both.of_b);
    return base.r_sq < H * H;
  }

  template <std::size_t I, class Row, class Mask>
  [[gnu::always_inline]] static void add(const Row& row, const Mask& inside, V (&sums)[sum_count]) {
    using Added = typename UseAt<I>::Term::adds;
    Added::for_each([&]<class F>(F) __attribute__((always_inline)) {
      constexpr int first = first_sum<I> + detail::record_offset_of<N, F, double>(Added{});
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
    Real joined_sums[sum_count];
    for (int k = 0; k < sum_count; k += 4)
      detail::sum_lanes(sums[k], sums[k + 1], sums[k + 2], sums[k + 3], joined_sums + k);
    const auto one = [&]<std::size_t J>(std::integral_constant<std::size_t, J>) __attribute__((always_inline)) {
      if (!std::get<J>(uses_).acts_on(source)) return;
      using Added = typename UseAt<J>::Term::adds;
      Added::for_each([&]<class F>(F) __attribute__((always_inline)) {
        constexpr int first = first_sum<J> + detail::record_offset_of<N, F, double>(Added{});
        typename F::template value<N, double> joined{};
        detail::for_each_indexed<first>(
            joined, [&](auto k, double& number) __attribute__((always_inline)) {
              number = F::info.join == Join::max ? lane_max(sums[k]) : joined_sums[k];
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
  Records<scalar_of<V>> records_;
  detail::PositionCode<N, Real> code_;
};

template <class Tag, int N, class... Uses>
void SweepEntry<Tag, N, Uses...>::mixed(const SweepContext<N>& context, std::tuple<Uses...>& uses,
                                        const SweepTask& task) {
  SweepLoop<N, Pack<float>, Uses...>(context, uses).run(task);
}

template <class Tag, int N, class... Uses>
void SweepEntry<Tag, N, Uses...>::in_double(const SweepContext<N>& context, std::tuple<Uses...>& uses,
                                            const SweepTask& task) {
  SweepLoop<N, Pack<double>, Uses...>(context, uses).run(task);
}

template <class Tag, int N, class... Uses>
void SweepEntry<Tag, N, Uses...>::plain(const SweepContext<N>& context, std::tuple<Uses...>& uses,
                                        const SweepTask& task) {
  SweepLoop<N, double, Uses...>(context, uses).run(task);
}

/// Compiles the loops of a sweep where it is explicitly instantiated: in a file that is built for each instruction set.
template <class Sweep>
struct CompiledSweep;
template <int N, class... Uses>
struct CompiledSweep<PairSweep<N, Uses...>> {
  using Entry = SweepEntry<UNDINE_ISA::Tag, N, Uses...>;
  static constexpr auto loops = [] {
    if constexpr (UNDINE_ISA::is_basic) {
      return std::array{&Entry::mixed, &Entry::in_double, &Entry::plain};
    } else {
      return std::array{&Entry::mixed, &Entry::in_double};
    }
  }();
};

}  // namespace undine
