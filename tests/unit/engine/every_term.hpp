#pragma once
#include <string>
#include <string_view>
#include <tuple>

#include "undine/engine/pair_sweep.hpp"
#include "undine/terms/catalogue.hpp"

namespace undine::test {

/// The terms that are in no list: each does one fixed job.
using LoneTerms = terms::Measures;

/// The works of pressure that take one support for a pair. What takes both, or the target's, has sweeps of its own:
/// tests/unit/schemes/gas_sweeps_test.cpp.
using WorkForms = Catalogue<terms::EnergySymmetric, terms::EnergySum, terms::EnergyOwn, terms::EnergyOwnVolume>;

template <class List>
struct EveryTermOf;
template <class... Sum, class... Lone, class... Force>
struct EveryTermOf<std::tuple<Catalogue<Sum...>, Catalogue<Lone...>, Catalogue<Force...>>> {
  template <int N>
  using Sweep = PairSweep<N, Use<OneOf<terms::PressureForms>, KernelRole::pressure>,        //
                          Use<OneOf<terms::ContinuityForms>, KernelRole::pressure>,         //
                          Use<OneOf<terms::ViscosityForms>, KernelRole::viscosity>,         //
                          Use<OneOf<terms::ArtificialViscosities>, KernelRole::viscosity>,  //
                          Use<OneOf<terms::DiffusionForms>>,                                //
                          Use<OneOf<terms::VelocityCorrections>>,                           //
                          Use<OneOf<terms::NoSlipForms>, KernelRole::viscosity>,            //
                          Use<OneOf<WorkForms>, KernelRole::pressure>,                      //
                          Use<OneOf<terms::GasViscosities>, KernelRole::viscosity>,         //
                          Use<OneOf<terms::StressForms>, KernelRole::viscosity>,            //
                          Use<OneOf<terms::Conductivities>>,                                //
                          Use<Sum>..., Use<Lone>..., Use<Force>...>;
};

/// One sweep that holds every term of terms/catalogue.hpp, to be used one at a time.
template <int N>
using EveryTerm = EveryTermOf<std::tuple<terms::Sums, LoneTerms, terms::WallForces>>::Sweep<N>;

/// Calls f(Term{}) for every term.
template <class F>
void for_each_term(F&& f) {
  terms::PressureForms::for_each(f);
  terms::ContinuityForms::for_each(f);
  terms::ViscosityForms::for_each(f);
  terms::ArtificialViscosities::for_each(f);
  terms::DiffusionForms::for_each(f);
  terms::VelocityCorrections::for_each(f);
  terms::Sums::for_each(f);
  LoneTerms::for_each(f);
  terms::WallForces::for_each(f);
  terms::NoSlipForms::for_each(f);
  WorkForms::for_each(f);
  terms::GasViscosities::for_each(f);
  terms::StressForms::for_each(f);
  terms::Conductivities::for_each(f);
}

template <class Term, class Entry>
inline constexpr bool offers = std::is_same_v<Term, Entry>;
template <class Term, class... Entries>
inline constexpr bool offers<Term, OneOf<Catalogue<Entries...>>> = (std::is_same_v<Term, Entries> || ...);

/// Lets the sweep use that term alone, from these groups; its parameters are those of `term`.
template <class Term, int N>
void use_only(EveryTerm<N>& sweep, const Term& term, std::array<bool, group_count> sources = {true, true}) {
  const auto one = [&]<class U>(U& use) {
    use.active = false;
    if constexpr (offers<Term, typename U::Term>) {
      use.active = true;
      use.sources = sources;
      if constexpr (requires { use.term.index(); }) {
        use.term.choose(U::Term::List::template index<Term>());
        use.term.template get<Term>() = term;
      } else {
        use.term = term;
      }
    }
  };
  std::apply([&](auto&... uses) { (one(uses), ...); }, sweep.uses());
}

}  // namespace undine::test
