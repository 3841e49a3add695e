#pragma once
#include "undine/approximation/neighbourhood.hpp"
#include "undine/core/catalogue.hpp"

namespace undine::approximation {

/// How many monomials in N variables have at most this degree (0, 1 or 2).
constexpr int terms(int N, int degree) { return degree == 0 ? 1 : degree == 1 ? 1 + N : 1 + N + N * (N + 1) / 2; }

/// What a method is, where it does not say otherwise. A method adds
///   static constexpr Info info;
///   static constexpr int lowest_order, highest_order;
///   static constexpr Degrees reproduces(int order);             what is exact, a promise that tests check
///   static constexpr int least_points(int N, int order);        fewer neighbours are `too_few`
///   template <int N> static void weigh(const Neighbourhood<N>& around, int order, Stencil<N>& out);
/// `weigh` fills value, gradient, hessian and condition of a stencil, in units of H; it is not called with too few
/// points, and leaves it to the caller to judge the condition.
struct Method {
  static constexpr bool needs_volumes = false;
  static constexpr bool needs_positive_kernel = false;        ///< minimises squares, so weights must not be negative
  static constexpr bool about_a_point = false;                ///< expands about the nearest point, whose value is known
  static constexpr bool differentiates_kernel_twice = false;  ///< no Hessian with a kernel that has a kink at R = 0
};

}  // namespace undine::approximation
