#pragma once
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
struct Material {
  std::string name = "water";
  double rho_0 = 1000;  ///< kg/m^3
  double mu = 0;        ///< dynamic viscosity, Pa s
  EquationOfState eos = TaitSoundSpeed{};

  double pressure(double rho) const {
    return std::visit([&](const auto& e) { return e.pressure(rho); }, eos);
  }
  double sound_speed(double rho) const {
    return std::visit([&](const auto& e) { return e.sound_speed(rho); }, eos);
  }
  double density(double p) const {
    return std::visit([&](const auto& e) { return e.density(p); }, eos);
  }
  double energy(double rho) const {
    return std::visit([&](const auto& e) { return e.energy(rho); }, eos);
  }

  // With the internal energy e, of which only thermal equations take notice.
  bool is_thermal() const {
    return std::visit([]<class Eos>(const Eos&) { return Thermal<Eos>; }, eos);
  }
  double pressure(double rho, double e) const {
    return with_energy([&](const auto& gas) { return gas.pressure(rho, e); },
                       [&](const auto& law) { return law.pressure(rho); });
  }
  double sound_speed(double rho, double e) const {
    return with_energy([&](const auto& gas) { return gas.sound_speed(rho, e); },
                       [&](const auto& law) { return law.sound_speed(rho); });
  }
  /// e at that density and pressure; where pressure does not tell, the elastic energy at that density.
  double internal_energy(double rho, double p) const {
    return with_energy([&](const auto& gas) { return gas.internal_energy(rho, p); },
                       [&](const auto& law) { return law.energy(rho); });
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
