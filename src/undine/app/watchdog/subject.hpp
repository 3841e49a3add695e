#pragma once
#include <algorithm>
#include <limits>

#include "undine/app/case_setup.hpp"
#include "undine/app/watchdog/watch.hpp"

namespace undine {

/// What the watchdog must know of a case.
template <int N>
typename Watch<N>::Subject watch_subject(const CaseSetup<N>& setup) {
  const auto& options = setup.options();
  const auto& limits = setup.choice.limits;
  const auto* liquid = std::get_if<WeaklyCompressibleOptions<N>>(&setup.scheme);
  const bool evolved = liquid && liquid->density == DensityForm::evolved;
  typename Watch<N>::Subject subject{
      .spacing = setup.spacing, .largest_step = limits.largest, .summed = !evolved, .audited = evolved};
  const double h = options.support.uniform / options.support.kappa;
  for (const auto& material : options.materials) {
    const double sound = liquid ? material.sound_speed(material.rho_0) : 0;
    if (sound > 0) subject.largest_step = std::min(subject.largest_step, limits.courant * h / sound);
    if (liquid && liquid->viscosity && material.mu > 0)
      subject.largest_step = std::min(subject.largest_step, limits.viscous * sq(h) * material.rho_0 / material.mu);
  }
  // The sound of a gas follows from its state; only a step that is none stops it.
  if (limits.fixed > 0 || !liquid) subject.largest_step = 0;
  return subject;
}

}  // namespace undine
