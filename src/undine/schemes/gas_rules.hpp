#pragma once
#include <algorithm>
#include <vector>

#include "undine/core/fields.hpp"
#include "undine/materials/catalogue.hpp"
#include "undine/terms/viscosity/stress.hpp"
#include "undine/terms/viscosity/switches.hpp"

namespace undine::rules {
using namespace field;

/// p = p(rho, e), c = c(rho, e) of the particle's material.
struct ApplyThermalEquationOfState {
  using reads = Fields<rho, e>;
  using writes = Fields<p, c>;
  const std::vector<materials::Material>& materials;

  auto operator()(const auto& a, int material) const {
    const auto& substance = materials[static_cast<std::size_t>(material)];
    return writes::row(substance.pressure(a.rho, a.e), substance.sound_speed(a.rho, a.e));
  }
};

/// Viscosity fades where the flow shears rather than converges.
template <int N>
struct LimitViscosity {
  using reads = Fields<strain, c, h>;
  using writes = Fields<balsara>;
  double kappa;
  auto operator()(const auto& a, int) const {
    return writes::row(terms::balsara_factor<N>(a.strain, a.c, a.h / kappa));
  }
};

/// tau = mu (L + L^T - 2/3 tr(L) 1).
template <int N>
struct TakeViscousStress {
  using reads = Fields<strain, mu>;
  using writes = Fields<stress>;
  auto operator()(const auto& a, int) const {
    auto tau = terms::deviator<N>(a.strain);
    for (int i = 0; i < N; ++i) tau[i] = a.mu * tau[i];
    return writes::row(tau);
  }
};

}  // namespace undine::rules
