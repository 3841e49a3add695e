#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "undine/core/catalogue.hpp"
#include "undine/core/parameter.hpp"
#include "undine/core/vec.hpp"

/// Exact solutions. Each is a struct with
///   info, parameters()           as a term or an equation of state has them
///   frame, coordinates, fields   what a point is, and what there is at it
///   example                      where to look at it with the default parameters
///   at(t)                        the solution at the time t: a function of the point that gives one number per field;
///                                throws InputError if the parameters make no solution
/// and nothing else: a pure function of parameters, point and time.
namespace undine::exact {

/// What the point of a solution is, and how its vectors lie in space.
enum class Frame {
  line,    ///< x along an axis; `velocity` points along it
  radius,  ///< r, the distance from a point, a line or a plane; `velocity` points away from it
  shear,   ///< y across the flow; `velocity` points along the flow
  plane,   ///< x, y; `velocity_x`, `velocity_y`
  time     ///< no place at all
};

/// A point: x, r or y, or x and y. What a solution does not need is not read.
using Point = Vec<2>;

struct FieldLine {
  std::string_view name, unit;
};

template <std::size_t n>
using Values = std::array<double, n>;

/// A view of the solution with its default parameters: points between two of them, and a time.
struct Example {
  Point from, to;
  double time;
};

/// The field names that particles know.
namespace name {
inline constexpr FieldLine density{"density", "kg/m^3"};
inline constexpr FieldLine pressure{"pressure", "Pa"};
inline constexpr FieldLine velocity{"velocity", "m/s"};
inline constexpr FieldLine velocity_x{"velocity_x", "m/s"};
inline constexpr FieldLine velocity_y{"velocity_y", "m/s"};
inline constexpr FieldLine energy{"energy", "J/kg"};  ///< internal, per mass
}  // namespace name

inline constexpr double pi = 3.14159265358979323846;

/// The dimensions 1, 2 or 3 that a parameter holds; throws InputError unless it is a whole number from `low`.
int whole_dimensions(double value, int low = 1);
/// A whole number of at least `low` that a parameter holds. Throws InputError.
int whole(std::string_view name, double value, int low);
/// Throws InputError that says why these parameters have no solution.
[[noreturn]] void no_solution(std::string_view solution, const char* what, const char* why, const char* fix);

/// p/((gamma-1) rho); 0 in a vacuum.
inline double internal_energy(double rho, double p, double gamma) { return rho > 0 ? p / ((gamma - 1) * rho) : 0; }

}  // namespace undine::exact
