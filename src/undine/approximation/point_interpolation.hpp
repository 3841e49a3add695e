#pragma once
#include "undine/approximation/method.hpp"

namespace undine::approximation {

/// Polynomial point interpolation. G.R. Liu & Gu (2001).
///   u(x) = p(x).c,  P c = u with as many points as terms: it passes through the data of those points
/// P is singular for many choices of points. Here the points are chosen from the whole support, by elimination with
/// column pivoting (approximate Fekete points; Sommariva & Vianello 2009), near ones preferred by the factor (1 -
/// s^2)^3. Derivatives are those of the polynomial. No kernel, no volumes; u(x) jumps where the choice changes.
struct PointInterpolation : Method {
  static constexpr Info info{"point_interpolation", "Point interpolation, polynomial",
                             "u = p(x).c, sum_k p_k(x_j) c_k = u_j for as many points as terms",
                             "Liu & Gu (2001); choice of points: Sommariva & Vianello (2009)"};
  static constexpr int lowest_order = 1, highest_order = 2;
  static constexpr Degrees reproduces(int order) { return {order, order, order == 2 ? 2 : Degrees::not_given}; }
  static constexpr int least_points(int N, int order) { return terms(N, order); }

  template <int N>
  static void weigh(const Neighbourhood<N>& around, int order, Stencil<N>& out);
};

}  // namespace undine::approximation
