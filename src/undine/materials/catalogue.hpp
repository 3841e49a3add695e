#pragma once
#include <algorithm>
#include <string>
#include <variant>

#include "undine/core/catalogue.hpp"
#include "undine/materials/eos/ideal_gas.hpp"
#include "undine/materials/eos/isothermal.hpp"
#include "undine/materials/eos/linear.hpp"
#include "undine/materials/eos/polytropic.hpp"
#include "undine/materials/eos/tait.hpp"
#include "undine/materials/eos/tait_sound_speed.hpp"

namespace undine::materials {

/// The one list of equations of state: pressure, sound speed, inverse and elastic energy as functions of density; those
/// of gases also as functions of density and internal energy e.
using EquationsOfState = Catalogue<  //
    TaitSoundSpeed,                  //
    Tait,                            //
    Linear,                          //
    Isothermal,                      //
    Polytropic,                      //
    IdealGas>;

/// Whether pressure depends on internal energy. What does not is barotropic: its e is the work done on it.
template <class Eos>
concept Thermal = requires(const Eos& eos) {
  eos.pressure(1.0, 1.0);
};

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

  // With the internal energy e, of which only thermal equations take notice.
  bool is_thermal() const {
    return std::visit([]<class Eos>(const Eos&) { return Thermal<Eos>; }, eos);
  }
  double pressure(double rho, double e) const {
    return with_energy([&](const auto& gas) { return gas.pressure(rho, e); },
                       [&](const auto&) { return pressure(rho); });
  }
  double sound_speed(double rho, double e) const {
    return with_energy([&](const auto& gas) { return gas.sound_speed(rho, e); },
                       [&](const auto& law) { return law.sound_speed(rho); });
  }
  /// e at that density and pressure; where pressure does not tell, the elastic energy at that density.
  double internal_energy(double rho, double p) const {
    return with_energy([&](const auto& gas) { return gas.internal_energy(rho, p); },
                       [&](const auto&) { return energy(rho); });
  }

 private:
  template <class OfGas, class OfOthers>
  double with_energy(OfGas of_gas, OfOthers of_others) const {
    return std::visit(
        [&]<class Eos>(const Eos& law) {
          if constexpr (Thermal<Eos>) {
            return of_gas(law);
          } else {
            return of_others(law);
          }
        },
        eos);
  }
};

}  // namespace undine::materials
