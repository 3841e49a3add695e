#pragma once
#include <array>
#include <cmath>

#include "undine/core/catalogue.hpp"
#include "undine/core/parameter.hpp"

namespace undine::materials {

struct Polytropic {
  static constexpr Info info{"polytropic", "Polytrope of index n, for stars and barotropic gas", "p = K rho^(1+1/n)",
                             "Chandrasekhar (1939), ch. IV"};
  double rho_0 = 1;
  double K = 1;
  double n = 1.5;
  static constexpr auto parameters() {
    using P = Parameter<Polytropic>;
    return std::array{P{"K", &Polytropic::K, "SI", "polytropic constant", 1e-300},
                      P{"index", &Polytropic::n, "1", "n", 1e-3}};
  }

  double pressure(double rho) const { return K * std::pow(rho, 1 + 1 / n); }
  double sound_speed(double rho) const { return std::sqrt((1 + 1 / n) * K * std::pow(rho, 1 / n)); }
  double density(double p) const { return std::pow(p / K, n / (n + 1)); }
  double energy(double rho) const { return n * K * (std::pow(rho, 1 / n) - std::pow(rho_0, 1 / n)); }
};

}  // namespace undine::materials
