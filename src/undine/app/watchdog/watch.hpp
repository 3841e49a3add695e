#pragma once
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "undine/app/watchdog/evidence.hpp"
#include "undine/app/watchdog/limits.hpp"
#include "undine/core/error.hpp"
#include "undine/schemes/flow.hpp"

namespace undine {

/// What the watchdog hit on.
struct AlarmHit {
  Alarm alarm = Alarm::not_finite;
  std::int64_t particle = -1;  ///< id; -1: all together
};

class AlarmError : public RunError {
 public:
  AlarmError(const AlarmHit& hit, Parts parts) : RunError(std::move(parts)), hit_(hit) {}
  const AlarmHit& hit() const { return hit_; }

 private:
  AlarmHit hit_;
};

/// Looks after a run and changes nothing in it. Throws AlarmError.
template <int N>
class Watch {
 public:
  struct Subject {
    double spacing = 0;       ///< m
    double largest_step = 0;  ///< s, that sound and viscosity allow at rest; 0: steps are fixed
    double courant_h = 0;     ///< m, Courant number times h of a gas; 0: of a liquid, or steps are fixed
    bool summed = false;      ///< whether density is a sum, which is low where neighbours lack
    bool audited = true;      ///< whether the audit closes but for the step
  };
  Watch(const WatchLimits& limits, const Subject& subject, const std::vector<materials::Material>& materials);

  /// Before the first step, or when a run goes on.
  void begin(const Flow<N>& flow) { audit(flow); }
  /// After each step, at less than a hundredth of its cost: density beyond bounds or not a number.
  void quickly(const Flow<N>& flow) const;
  /// What the next step is to be.
  void step(const Flow<N>& flow, const Step& next) const;
  /// Before anything of the state is kept: all values finite, all particles in the domain and apart, and the audit.
  void fully(const Flow<N>& flow);

 private:
  bool within(double density, std::int32_t material) const {
    const auto k = static_cast<std::size_t>(material);
    return density >= lowest_[k] && density <= highest_[k];  // false for NaN
  }
  void check_places(const Flow<N>& flow) const;
  void check_energies(const Flow<N>& flow) const;
  void check_pairs(const Flow<N>& flow) const;
  void audit(const Flow<N>& flow);

  WatchLimits limits_;
  Subject subject_;
  std::vector<double> lowest_, highest_, rest_;              ///< kg/m^3, by material
  double scale_ = 0;                                         ///< J, the largest energy so far
  double total_ = std::numeric_limits<double>::quiet_NaN();  ///< J, at the last audit
};

/// Whether an equation of state is meant for densities near rho_0 only.
bool is_stiff(const materials::Material& material);

/// What a RunError of the moves themselves is about: what a StateError says, or by the state that they left; nothing
/// where that is sound.
template <int N>
std::optional<AlarmHit> hit_of(const RunError& error, const Flow<N>& flow);

extern template class Watch<1>;
extern template class Watch<2>;
extern template class Watch<3>;

}  // namespace undine
