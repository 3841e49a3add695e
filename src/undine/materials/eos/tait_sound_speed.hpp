#pragma once
#include "undine/materials/eos/tait.hpp"

namespace undine::materials {

struct TaitSoundSpeed {
  static constexpr Info info{"tait_sound_speed", "Stiff liquid, given by its speed of sound",
                             "p = rho_0 c_0^2/gamma ((rho/rho_0)^gamma - 1)",
                             "Monaghan (1994), eq. 6; Saalfeld (2012), eq. 33 (factor corrected)"};
  double rho_0 = 1000;
  double c_0 = 30;
  double gamma = 7;
  static constexpr auto parameters() {
    using P = Parameter<TaitSoundSpeed>;
    return std::array{
        P{"sound_speed", &TaitSoundSpeed::c_0, "m/s", "c_0, at least ten times the largest velocity", 1e-300},
        P{"gamma", &TaitSoundSpeed::gamma, "1", "exponent", 1}};
  }

  /// The same law as `tait`, with p_ref = rho_0 c_0^2 / gamma.
  Tait tait() const { return {rho_0, rho_0 * c_0 * c_0 / gamma, gamma}; }
  double pressure(double rho) const { return tait().pressure(rho); }
  double sound_speed(double rho) const { return tait().sound_speed(rho); }
  double density(double p) const { return tait().density(p); }
  double energy(double rho) const { return tait().energy(rho); }
};

}  // namespace undine::materials
