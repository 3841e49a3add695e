#pragma once
#include <algorithm>
#include <limits>

#include "undine/app/case_setup.hpp"
#include "undine/app/watchdog/watch.hpp"

namespace undine {

/// What the watchdog must know of a case.
template <int N>
typename Watch<N>::Subject watch_subject(const CaseSetup<N>& setup) {
  const auto& options = setup.options;
  const auto& limits = setup.choice.limits;
  const double h = options.support.uniform / options.support.kappa;
  typename Watch<N>::Subject subject{.spacing = setup.spacing,
                                     .largest_step = limits.largest,
                                     .summed = options.density != DensityForm::evolved,
                                     .audited = options.density == DensityForm::evolved};
  for (const auto& material : options.materials) {
    const double sound = material.sound_speed(material.rho_0);
    if (sound > 0) subject.largest_step = std::min(subject.largest_step, limits.courant * h / sound);
    if (options.viscosity && material.mu > 0)
      subject.largest_step = std::min(subject.largest_step, limits.viscous * sq(h) * material.rho_0 / material.mu);
  }
  if (limits.fixed > 0) subject.largest_step = 0;
  return subject;
}

}  // namespace undine
