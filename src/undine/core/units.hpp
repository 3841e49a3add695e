#pragma once
#include <string>
#include <string_view>

namespace undine {

/// Exponents of the SI base units metre, kilogram, second and kelvin. Angles count as plain numbers (radians).
struct Dimension {
  int m = 0, kg = 0, s = 0, K = 0;

  friend constexpr bool operator==(const Dimension&, const Dimension&) = default;
  friend constexpr Dimension operator*(Dimension a, Dimension b) {
    return {a.m + b.m, a.kg + b.kg, a.s + b.s, a.K + b.K};
  }
  friend constexpr Dimension operator/(Dimension a, Dimension b) {
    return {a.m - b.m, a.kg - b.kg, a.s - b.s, a.K - b.K};
  }
};

constexpr Dimension power(Dimension a, int n) { return {a.m * n, a.kg * n, a.s * n, a.K * n}; }

/// The dimensions that case files use.
namespace unit {
inline constexpr Dimension one{};
inline constexpr Dimension angle{};
inline constexpr Dimension length{1, 0, 0};
inline constexpr Dimension mass{0, 1, 0};
inline constexpr Dimension time{0, 0, 1};
inline constexpr Dimension temperature{0, 0, 0, 1};
inline constexpr Dimension area{2, 0, 0};
inline constexpr Dimension volume{3, 0, 0};
inline constexpr Dimension per_length{-1, 0, 0};
inline constexpr Dimension per_time{0, 0, -1};
inline constexpr Dimension frequency = per_time;
inline constexpr Dimension angular_velocity = per_time;
inline constexpr Dimension velocity = length / time;
inline constexpr Dimension acceleration = velocity / time;
inline constexpr Dimension density = mass / volume;
inline constexpr Dimension force = mass * acceleration;
inline constexpr Dimension pressure = force / area;
inline constexpr Dimension energy = force * length;
inline constexpr Dimension moment = energy;
inline constexpr Dimension power = energy / time;
inline constexpr Dimension specific_energy = energy / mass;
inline constexpr Dimension dynamic_viscosity = pressure * time;
inline constexpr Dimension kinematic_viscosity = area / time;
inline constexpr Dimension diffusivity = kinematic_viscosity;
inline constexpr Dimension surface_tension = force / length;
inline constexpr Dimension stiffness = force / length;
inline constexpr Dimension momentum = mass * velocity;
inline constexpr Dimension moment_of_inertia = mass * area;
inline constexpr Dimension flow_rate = volume / time;
inline constexpr Dimension mass_flow_rate = mass / time;
inline constexpr Dimension specific_heat = specific_energy / temperature;
inline constexpr Dimension thermal_conductivity = power / length / temperature;
inline constexpr Dimension gravitational = volume / mass / time / time;
}  // namespace unit

/// A value in SI units with its dimension.
struct Quantity {
  double value = 0;
  Dimension dimension = {};
};

/// The SI unit, in the form that parse_quantity reads: "kg/m^3", "Pa", "1/s"; "1" for a plain number.
std::string text(Dimension dimension);

/// Shortest decimal form that parses back to the same value, and the unit: "0.5 m", "2" (no unit).
std::string text(const Quantity& quantity);

/// For messages, with article and unit: "a length (m)", "a plain number"; the bare unit where the dimension has no name
/// here.
std::string described(Dimension dimension);

/// Reads a number and a unit: "0.5 m", "20 ms", "1000 kg/m^3", "1e-3 Pa s", "3 mm/s^2", "90 deg", "5". Units: m g kg t
/// s min h day N Pa bar J W Hz K L rad deg, with the prefixes n u µ m c d k M G on those that take them. Product: a
/// space, * or ·; quotient: /; integer power: ^ or **. After a quotient a product needs brackets, kg/(m s). A number
/// with only a prefix to apply is rounded once, so that "5 mm" is exactly 5e-3.
/// @throws InputError (no location) if the text is not understood or the value is not finite.
Quantity parse_quantity(std::string_view source);

}  // namespace undine
