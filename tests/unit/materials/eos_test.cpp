#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "undine/core/vec.hpp"
#include "undine/materials/catalogue.hpp"

// Every test runs over every equation of state of the list, with its defaults and with other parameters.

namespace undine::materials {
namespace {

/// Calls f(eos) for each equation of state, as it is and with every parameter changed, and at another reference
/// density.
template <class F>
void for_all(F f) {
  EquationsOfState::for_each([&]<class Eos>(Eos eos) {
    SCOPED_TRACE(std::string(Eos::info.name));
    f(eos);
    for_each_parameter<Eos>([&](const auto& parameter) {
      SCOPED_TRACE("another " + std::string(parameter.name));
      Eos other = eos;
      other.*parameter.member *= 1.3;
      f(other);
    });
    eos.rho_0 *= 0.8;
    f(eos);
    if constexpr (requires { eos.gamma; } && !Thermal<Eos>) {
      eos.gamma = 1;
      f(eos);
    }
  });
}

constexpr double ratios[] = {0.9, 0.99, 1.0, 1.003, 1.1};

/// Central difference of fourth order with steps that are small, but not against the rounding of rho^7.
template <class F>
double derivative(F f, double at) {
  const double d = 1e-3 * at;
  return (8 * (f(at + d) - f(at - d)) - (f(at + 2 * d) - f(at - 2 * d))) / (12 * d);
}

// Criterion: dp/drho = c^2 to 1e-8, relative.
TEST(EquationsOfState, SoundSpeedIsTheSlopeOfPressure) {
  for_all([](const auto& eos) {
    for (const double ratio : ratios) {
      const double rho = ratio * eos.rho_0;
      const double c = eos.sound_speed(rho);
      EXPECT_GT(c, 0);
      EXPECT_NEAR(derivative([&](double r) { return eos.pressure(r); }, rho) / (c * c), 1, 1e-8) << ratio;
    }
  });
}

// Criterion: density(pressure(rho)) = rho to 1e-14, relative.
TEST(EquationsOfState, DensityIsTheInverseOfPressure) {
  for_all([](const auto& eos) {
    for (const double ratio : ratios) {
      const double rho = ratio * eos.rho_0;
      EXPECT_NEAR(eos.density(eos.pressure(rho)) / rho, 1, 1e-14) << ratio;
    }
  });
}

// Criterion: d energy/d rho = p/rho^2 to 1e-8 of c^2/rho.
TEST(EquationsOfState, EnergyIsTheWorkOfPressure) {
  for_all([](const auto& eos) {
    for (const double ratio : ratios) {
      const double rho = ratio * eos.rho_0;
      const double scale = eos.sound_speed(rho) * eos.sound_speed(rho) / rho;
      EXPECT_NEAR(derivative([&](double r) { return eos.energy(r); }, rho) / scale,
                  eos.pressure(rho) / (rho * rho) / scale, 1e-8)
          << ratio;
    }
  });
}

// Criterion: exactly zero.
TEST(EquationsOfState, EnergyCountsFromTheReferenceDensity) {
  for_all([](const auto& eos) { EXPECT_EQ(eos.energy(eos.rho_0), 0); });
}

// Criterion: exactly zero pressure at the reference density, and tension below it; for gases, pressure above zero.
TEST(EquationsOfState, LiquidsAreFreeOfPressureAtTheReferenceDensity) {
  for_all([]<class Eos>(const Eos& eos) {
    constexpr bool gas = std::is_same_v<Eos, Isothermal> || std::is_same_v<Eos, Polytropic> || Thermal<Eos>;
    if constexpr (gas) {
      EXPECT_GT(eos.pressure(eos.rho_0), 0);
    } else {
      EXPECT_EQ(eos.pressure(eos.rho_0), 0);
      EXPECT_LT(eos.pressure(0.99 * eos.rho_0), 0);
    }
  });
}

// Criterion: the two forms of Tait's law are one (1e-14), and c(rho_0) = c_0.
TEST(EquationsOfState, TaitBySoundSpeedHasThatSoundSpeed) {
  const TaitSoundSpeed eos{.rho_0 = 800, .c_0 = 42, .gamma = 7.15};
  EXPECT_NEAR(eos.sound_speed(800) / 42, 1, 1e-14);
  EXPECT_NEAR(eos.pressure(810) / eos.tait().pressure(810), 1, 1e-14);
}

// Criterion: a material answers with the very numbers of its equation.
TEST(EquationsOfState, MaterialsAnswerForTheirEquation) {
  for_all([](const auto& eos) {
    const Material material{.name = "test", .rho_0 = eos.rho_0, .mu = 0, .eos = eos};
    const double rho = 1.01 * eos.rho_0;
    EXPECT_EQ(material.pressure(rho), eos.pressure(rho));
    EXPECT_EQ(material.sound_speed(rho), eos.sound_speed(rho));
    EXPECT_EQ(material.density(eos.pressure(rho)), eos.density(eos.pressure(rho)));
    EXPECT_EQ(material.energy(rho), eos.energy(rho));
  });
}

/// Calls f(eos) for each equation of state with internal energy, of a monatomic and of a diatomic gas.
template <class F>
void for_thermal(F f) {
  for_all([&]<class Eos>(const Eos& eos) {
    if constexpr (Thermal<Eos>) f(eos);
  });
}

// Criterion: c^2 = dp/drho + p/rho^2 dp/de, the slope of pressure at constant entropy, to 1e-8.
TEST(EquationsOfState, SoundSpeedOfGasesIsTheIsentropicSlope) {
  int seen = 0;
  for_thermal([&](const auto& eos) {
    for (const double rho : {0.2, 1.0, 3.0})
      for (const double e : {0.1, 2.5}) {
        const double by_rho = derivative([&](double r) { return eos.pressure(r, e); }, rho);
        const double by_e = derivative([&](double u) { return eos.pressure(rho, u); }, e);
        const double c = eos.sound_speed(rho, e);
        EXPECT_NEAR((by_rho + eos.pressure(rho, e) / (rho * rho) * by_e) / (c * c), 1, 1e-8);
        ++seen;
      }
  });
  EXPECT_GT(seen, 0);
}

// Criterion: e(rho, p(rho, e)) = e to 1e-14; and p = 0.4 rho e, c^2 = 0.56 e for gamma = 1.4.
TEST(EquationsOfState, InternalEnergyOfGasesIsTheInverseOfPressure) {
  for_thermal([](const auto& eos) { EXPECT_NEAR(eos.internal_energy(0.3, eos.pressure(0.3, 1.7)) / 1.7, 1, 1e-14); });
  const IdealGas air{.gamma = 1.4};
  EXPECT_NEAR(air.pressure(0.25, 1.795), 0.1795, 1e-15);  // right of the shock tube of Niedoba (2012), ch. 3
  EXPECT_NEAR(sq(air.sound_speed(1, 2.5)), 1.4, 1e-14);
}

// Criterion: a material answers with the numbers of its equation; where pressure knows no energy, whatever e is.
TEST(EquationsOfState, MaterialsPassTheInternalEnergyOn) {
  for_all([]<class Eos>(const Eos& eos) {
    const Material material{.name = "test", .rho_0 = eos.rho_0, .mu = 0, .eos = eos};
    const double rho = 1.01 * eos.rho_0;
    EXPECT_EQ(material.is_thermal(), Thermal<Eos>);
    if constexpr (Thermal<Eos>) {
      EXPECT_EQ(material.pressure(rho, 1.7), eos.pressure(rho, 1.7));
      EXPECT_EQ(material.sound_speed(rho, 1.7), eos.sound_speed(rho, 1.7));
      EXPECT_EQ(material.internal_energy(rho, 1.7), eos.internal_energy(rho, 1.7));
    } else {
      EXPECT_EQ(material.pressure(rho, 1.7), eos.pressure(rho));
      EXPECT_EQ(material.sound_speed(rho, 1.7), eos.sound_speed(rho));
      EXPECT_EQ(material.internal_energy(rho, 1.7), eos.energy(rho));
    }
  });
}

// Criterion: without tension p is that of the law where it presses and 0 elsewhere, energy is its work to 1e-8 of
// c^2/rho, and particles may thin out to 0.9 of the density at p = 0; with tension everything is the law's.
TEST(Materials, WithoutTensionPressureIsNeverNegative) {
  for_all([](const auto& eos) {
    Material with, without;
    with.rho_0 = without.rho_0 = eos.rho_0;
    with.eos = without.eos = eos;
    without.tension = false;
    EXPECT_EQ(with.smallest_density(), 0);
    EXPECT_EQ(without.smallest_density(), 0.9 * eos.density(0));
    for (const double ratio : {0.5, 0.9, 0.97, 1.02, 1.1}) {
      const double rho = ratio * eos.rho_0, p = eos.pressure(rho), c = eos.sound_speed(eos.rho_0);
      EXPECT_EQ(with.pressure(rho), p);
      EXPECT_EQ(with.energy(rho), eos.energy(rho));
      EXPECT_EQ(without.pressure(rho), p > 0 ? p : 0) << ratio;
      const double work = derivative([&](double r) { return without.energy(r); }, rho);
      EXPECT_NEAR(work * rho * rho, without.pressure(rho), 1e-8 * c * c * rho) << ratio;
    }
  });
}

}  // namespace
}  // namespace undine::materials
