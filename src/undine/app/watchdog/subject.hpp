#pragma once
#include <algorithm>

#include "undine/app/case_setup.hpp"
#include "undine/app/watchdog/watch.hpp"

namespace undine {

/// What the watchdog must know of a case.
template <int N>
typename Watch<N>::Subject watch_subject(const CaseSetup<N>& setup) {
  const auto& options = setup.options();
  const auto& limits = setup.choice.limits;
  const auto* liquid = std::get_if<WeaklyCompressibleOptions<N>>(&setup.scheme);
  const double h = options.support.uniform / options.support.kappa;
  if (!liquid) {
    // The sound of a gas follows from its state, and so does the step.
    return {.spacing = setup.spacing, .courant_h = limits.fixed > 0 ? 0 : limits.courant * h, .summed = true};
  }
  const bool evolved = liquid->density == DensityForm::evolved;
  typename Watch<N>::Subject subject{
      .spacing = setup.spacing, .largest_step = limits.largest, .summed = !evolved, .audited = evolved};
  for (const auto& material : options.materials) {
    const double sound = material.sound_speed(material.rho_0);
    if (sound > 0) subject.largest_step = std::min(subject.largest_step, limits.courant * h / sound);
    if (liquid->viscosity) subject.largest_step = std::min(subject.largest_step, viscous_step(limits, h, material));
  }
  if (limits.fixed > 0) subject.largest_step = 0;
  return subject;
}

}  // namespace undine
