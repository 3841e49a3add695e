#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>

#include <omp.h>

#include "undine/backend/backend.hpp"
#include "undine/core/error.hpp"
#include "undine/engine/records.hpp"

namespace undine {

/// The loops of a sweep, compiled for the instruction set `Tag`; engine/sweep_loop.hpp defines them.
template <class Tag, int N, class... Uses>
struct SweepEntry {
  using Loop = void(const SweepContext<N>&, std::tuple<Uses...>&, const SweepTask&);
  static Loop mixed;      ///< packs of floats
  static Loop in_double;  ///< packs of doubles
  static Loop plain;      ///< one double after the other
};

/// A named sweep over pairs: its terms, the group it is for, and the backends it can run on.
template <int N, class... Uses>
class PairSweep {
 public:
  PairSweep(std::string name, Group target, Booking booking = Booking::off)
      : name_(std::move(name)), target_(target), booking_(booking) {}

  template <std::size_t k>
  auto& use() {
    return std::get<k>(uses_);
  }

  std::tuple<Uses...>& uses() { return uses_; }
  const std::tuple<Uses...>& uses() const { return uses_; }

  /// Takes from no group but these, whatever the uses say.
  void take_from(const std::array<bool, group_count>& sources) { sources_ = sources; }

  const std::string& name() const { return name_; }
  Group target() const { return target_; }
  /// What the terms read as they are set, so that fields of other alternatives need not exist.
  FieldSet reads() const {
    return std::apply([](const auto&... use) { return (reads_in_use(use) | ... | FieldSet{}); }, uses_);
  }
  /// What it reads of its targets, also to book.
  FieldSet target_reads() const {
    FieldSet fields = (target_reads_of<typename Uses::Term>() | ...) & reads();
    if (booking_ == Booking::on) fields |= Fields<field::m, field::v, field::p, field::rho>::set();
    return fields;
  }
  /// What the terms in use add.
  FieldSet adds() const { return adds_in_use(uses_); }

  /// Which loop runs: the narrowest that does what the sweep is set to.
  SweepPath path(const SweepContext<N>& context, const Backend& backend) const {
    if (takes_supports(context)) return SweepPath::supports;
    return unusual(context, backend).empty() ? SweepPath::usual : SweepPath::any;
  }
  /// Why it is not the usual one, for people; empty where it is.
  std::string unusual(const SweepContext<N>& context, const Backend& backend) const {
    if (backend.kind != BackendKind::threads) return "one pair at a time";
    if (backend.precision != PairPrecision::mixed) return "in double";
    if (backend.instructions == InstructionSet::basic) return "narrow vectors";
    if (takes_supports(context)) return "H of each pair";
    for (const KernelChoice kernel : context.kernels)
      if (kernel != KernelChoice{}) return "kernel " + std::string(kernel.info().name);
    std::string found;
    const auto note = [&]<class U>(const U& use) {
      if (!use.active || !found.empty()) return;
      bool usual = U::presence != Presence::rare;
      if constexpr (requires { use.term.index(); }) {
        usual = usual && use.term.index() == 0;
        if (!usual) found = std::string(use.term.info().name);
      } else if (!usual) {
        found = std::string(U::Term::info.name);
      }
    };
    std::apply([&](const auto&... use) { (note(use), ...); }, uses_);
    return found;
  }

  void run(SweepContext<N> context, const Backend& backend) {
    context.sources = sources_;
    switch (backend.kind) {
      case BackendKind::serial:
        run_serial(context);
        break;
      case BackendKind::checked:
        run_checked(context);
        break;
      case BackendKind::threads:
        with_instructions(backend.instructions, [&]<class Tag>() {
          using Loops = SweepEntry<Tag, N, Uses...>;
          const auto loop = backend.precision == PairPrecision::mixed ? &Loops::mixed : &Loops::in_double;
          loop(context, uses_, {target_, booking_, path(context, backend)});
        });
        break;
    }
  }

 private:
  static bool takes_supports(const SweepContext<N>& context) {
    return SupportWish<Uses...>::only_supports || context.support.per_particle;
  }
  static SweepPath plain_path(const SweepContext<N>& context) {
    return takes_supports(context) ? SweepPath::supports : SweepPath::any;
  }
  void run_serial(const SweepContext<N>& context) {
    const int threads = omp_get_max_threads();
    omp_set_num_threads(1);
    SweepEntry<BasicTag, N, Uses...>::plain(context, uses_, {target_, booking_, plain_path(context)});
    omp_set_num_threads(threads);
  }

  /// Serial, with every output poisoned beforehand, inputs that nothing wrote found by their poison, and results
  /// checked.
  void run_checked(const SweepContext<N>& context) {
    const IndexRange targets = context.store.range(target_);
    for_each_in(adds(), [&](int f) {
      const int n = all_fields[f].components(N);
      auto data = context.store.raw(f).subspan(targets.begin * n, targets.size() * n);
      for (std::size_t k = 0; k < data.size(); ++k)
        if (context.wants(k / n)) data[k] = std::numeric_limits<double>::quiet_NaN();
    });
    for (const Group group : all_groups)
      if (group == target_ || takes_from(group))
        check_finite(context, (takes_from(group) ? reads() : target_reads()) | Fields<field::x>::set(),
                     context.store.range(group), "reads a value that nothing wrote");
    run_serial(context);
    check_finite(context, adds(), targets, "gave a value that is not finite");
  }

  void check_finite(const SweepContext<N>& context, const FieldSet& fields, IndexRange range,
                    const char* complaint) const {
    for_each_in(fields, [&](int f) {
      const int n = all_fields[f].components(N);
      const auto data = context.store.raw(f);
      for (std::size_t i = range.begin; i < range.end; ++i)
        for (int k = 0; k < n; ++k)
          if (!std::isfinite(data[i * n + k]))
            throw RunError({.what = "sweep '" + name_ + "' " + complaint + ": field '" +
                                    std::string(all_fields[f].name) + "' of particle " +
                                    std::to_string(context.store.ids()[i])});
    });
  }

  bool takes_from(Group group) const {
    return sources_[static_cast<int>(group)] &&
           std::apply([&](const auto&... use) { return (use.acts_on(group) || ...); }, uses_);
  }

  template <class F>
  static void for_each_in(const FieldSet& fields, F&& f) {
    for (int k = 0; k < FieldId::count; ++k)
      if (fields[k]) f(k);
  }

  std::string name_;
  Group target_;
  Booking booking_;
  std::array<bool, group_count> sources_{true, true};
  std::tuple<Uses...> uses_;
};

}  // namespace undine
