#pragma once
#include <algorithm>
#include <string>
#include <variant>

#include "undine/core/catalogue.hpp"
#include "undine/materials/eos/isothermal.hpp"
#include "undine/materials/eos/linear.hpp"
#include "undine/materials/eos/polytropic.hpp"
#include "undine/materials/eos/tait.hpp"
#include "undine/materials/eos/tait_sound_speed.hpp"

namespace undine::materials {

/// The one list of equations of state: pressure, sound speed, inverse and elastic energy as functions of density.
using EquationsOfState = Catalogue<  //
    TaitSoundSpeed,                  //
    Tait,                            //
    Linear,                          //
    Isothermal,                      //
    Polytropic>;

template <class List>
struct VariantOf;
template <class... Entries>
struct VariantOf<Catalogue<Entries...>> {
  using type = std::variant<Entries...>;
};

/// Any one of them, with its parameters.
using EquationOfState = VariantOf<EquationsOfState>::type;

/// A substance: what its particles share.
///
/// One that bears no tension has p = 0 wherever its law would have p < 0: a liquid at a free surface opens instead of
/// being pulled, and air fills what opens. With a density that is carried, a particle that leaves its neighbours
/// becomes lighter without end; there its law would pull with up to rho_0 c_0^2/gamma, a hundred times the pressures of
/// the flow. That makes strings and heaps of thin jets, and breaks them.
struct Material {
  /// To what share of the density at p = 0 a liquid without tension may thin out. What opens beyond is void that need
  /// not be closed before it is pressed again. Lower values let spray sink into the water that it falls on, higher ones
  /// swell water that was torn (docs/decisions.md).
  static constexpr double thinnest = 0.9;

  std::string name = "water";
  double rho_0 = 1000;  ///< kg/m^3
  double mu = 0;        ///< dynamic viscosity, Pa s
  EquationOfState eos = TaitSoundSpeed{};
  bool tension = true;

  double pressure(double rho) const {
    const double p = std::visit([&](const auto& e) { return e.pressure(rho); }, eos);
    return tension ? p : std::max(p, 0.0);
  }
  double sound_speed(double rho) const {
    return std::visit([&](const auto& e) { return e.sound_speed(rho); }, eos);
  }
  double density(double p) const {
    return std::visit([&](const auto& e) { return e.density(p); }, eos);
  }
  /// The integral of p/rho^2 from rho_0.
  double energy(double rho) const {
    const double pressed = tension ? rho : std::max(rho, density(0));
    return std::visit([&](const auto& e) { return e.energy(pressed); }, eos);
  }
  /// The smallest density that particles may carry.
  double smallest_density() const { return tension ? 0.0 : thinnest * density(0); }
};

}  // namespace undine::materials
