#pragma once
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "undine/core/one_of.hpp"
#include "undine/core/pack.hpp"
#include "undine/engine/neighbours.hpp"
#include "undine/engine/pair.hpp"
#include "undine/engine/smoothing.hpp"

namespace undine {

/// Power of a rate, per source group: what a term does to the energy of the targets, in W.
using Power = std::array<double, group_count>;

/// How often a term acts in the runs that a sweep is made for; only speed depends on it. `always`: in every run and
/// from every group, no flag is asked. `rare`: fields that only such terms read are loaded where one acts.
enum class Presence { always, common, rare };

/// A term at its place in a sweep: which kernel it takes, and from which groups it sums.
template <class TermType, KernelRole kernel_role = KernelRole::density, Presence how_often = Presence::common>
struct Use {
  using Term = TermType;
  static constexpr KernelRole role = kernel_role;
  static constexpr Presence presence = how_often;

  TermType term{};
  bool active = true;
  std::array<bool, group_count> sources{true, true};
  Power power{};  ///< filled by a booked sweep

  bool acts_on(Group source) const {
    if constexpr (presence == Presence::always) return true;
    return active && sources[static_cast<int>(source)];
  }
};

/// The fields that a use reads as it is set: of the alternative that is chosen, none where it does not act.
template <class U>
FieldSet reads_in_use(const U& use) {
  if (!use.active) return {};
  if constexpr (requires { use.term.chosen_reads(); }) {
    return use.term.chosen_reads();
  } else {
    return U::Term::reads::set();
  }
}

/// The fields that the uses in action add to.
template <class... U>
FieldSet adds_in_use(const std::tuple<U...>& uses) {
  return std::apply(
      [](const U&... use) { return ((use.active ? U::Term::adds::set() : FieldSet{}) | ... | FieldSet{}); }, uses);
}

/// The fields that a term reads of its target: all that it reads, unless it says otherwise.
template <class Term>
FieldSet target_reads_of() {
  if constexpr (requires { typename Term::target_reads; }) {
    return Term::target_reads::set();
  } else {
    return Term::reads::set();
  }
}

/// Whether a term, or an alternative of it, takes gradients with the supports of both particles of a pair.
template <class Term>
inline constexpr bool wants_both_supports = requires {
  requires Term::needs_both_supports;
};
template <class... Terms>
inline constexpr bool wants_both_supports<OneOf<Catalogue<Terms...>>> = (wants_both_supports<Terms> || ...);
/// Whether a term sums with the support of its target, whatever the rule for pairs.
template <class Term>
inline constexpr bool wants_target_support = requires {
  requires Term::takes_target_support;
};
template <class... Terms>
inline constexpr bool wants_target_support<OneOf<Catalogue<Terms...>>> = (wants_target_support<Terms> || ...);

/// What the terms of a sweep together want of the supports of a pair.
template <class... Uses>
struct SupportWish {
  static constexpr bool both = (wants_both_supports<typename Uses::Term> || ...);
  static constexpr bool target = (wants_target_support<typename Uses::Term> || ...);
  static_assert(!target || (wants_target_support<typename Uses::Term> && ...), "one support for all terms of a sweep");
  /// Whether no loop but that with an H of each pair is compiled.
  static constexpr bool only_supports = both || target;
};

/// Everything a sweep needs to know of the run.
template <int N>
struct SweepContext {
  Store<N>& store;
  const Neighbours<N>& neighbours;
  const Domain<N>& domain;
  Support support;
  std::array<KernelChoice, kernel_roles> kernels;
  double rho_reference = 0;  ///< kg/m^3; pair arithmetic in float carries densities as deviations from it
  std::array<bool, group_count> sources{true, true};  ///< groups that the sweep takes from, whatever its uses say
  std::span<const char> wanted{};  ///< by target: whether it is summed for, or keeps what it has; empty: all are

  bool wants(std::size_t target) const { return wanted.empty() || wanted[target]; }
};

/// How much a loop over pairs knows when it is compiled. What it does not know is looked up once for each packet of
/// pairs.
enum class SweepPath {
  usual,    ///< every term is the first of its list, none is rare, kernels are the default, H is the same everywhere
  any,      ///< any terms and kernels
  supports  ///< any, and H of each pair
};
inline constexpr std::array<std::string_view, 3> sweep_path_names{"usual", "any", "supports"};

/// Whether a sweep books the power of its terms (needs v, m, p, rho of the targets).
enum class Booking { off, on };

/// What the loops of a sweep are asked to do.
struct SweepTask {
  Group target;
  Booking booking = Booking::off;
  SweepPath path = SweepPath::any;
};

}  // namespace undine
