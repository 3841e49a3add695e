#pragma once
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
};

}  // namespace undine::materials
