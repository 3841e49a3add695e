#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "undine/approximation/approximation.hpp"

namespace undine::approximation {

/// Which points the study takes: cell centres of a lattice in the unit interval, square or cube, each moved at random.
struct StudyOptions {
  KernelChoice kernel = {};
  double support = 3.2;  ///< in spacings
  double jitter = 0.25;  ///< of the disordered points: largest displacement in each coordinate, in spacings
  int queries = 48;      ///< at each place
  std::uint64_t seed = 1;
};

enum class Arrangement { regular, disordered };
enum class Place {
  inside,    ///< no part of the support beyond the boundary
  boundary,  ///< on faces, edges and corners, and at the points nearest to those
};
inline constexpr std::string_view arrangement_words[]{"regular", "disordered"}, place_words[]{"inside", "boundary"};

/// One method in one setting. Errors are the largest over all queries, and over all monomials x^i y^j z^k of one degree
/// (0, 1, 2), whose values, like the side of the domain, are at most 1. NaN: not given.
struct StudyRow {
  int dimensions;
  std::string method;
  int order;
  Arrangement arrangement;
  Place place;
  Degrees promised;                                ///< what the method says of itself
  std::array<double, 3> value, gradient, hessian;  ///< errors by degree
  double value_order, gradient_order,
      laplacian_order;  ///< observed for a smooth function, from one spacing and half of it
  double condition;     ///< the worst
  int refused;          ///< queries whose status is not ok
};

/// One method in N dimensions: both arrangements, both places. Throws InputError if it has no such order.
template <int N>
std::vector<StudyRow> consistency_study(const StudyOptions& options, const std::string& method, int order);
/// All methods with all their orders.
template <int N>
std::vector<StudyRow> consistency_study(const StudyOptions& options);

/// Points of the coarse set of a study in N dimensions.
template <int N>
inline constexpr int study_points = N == 1   ? 32
                                    : N == 2 ? 400
                                             : 1728;

/// What a 1-D estimate makes of u = 1 and u = x near the end x = 0 of a regular row of points: Niedoba (2012),
/// figure 2.8, in numbers.
struct EndRow {
  double distance;                ///< from the end, in support radii
  double one, gradient_of_one;    ///< estimates of 1, and of its derivative, in 1/H
  double x_error, gradient_of_x;  ///< (<x> - x)/H, and the estimate of dx/dx = 1
};
std::vector<EndRow> end_of_support(const StudyOptions& options, const std::string& method, int order);

}  // namespace undine::approximation
