#pragma once
#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"

namespace undine::terms {
using namespace field;

struct AccelerationDivergence {
  static constexpr Info info{"acceleration_divergence", "Divergence of the acceleration, which foretells compression",
                             "div acc_a = sum_b (m_b/rho_b) (acc_b - acc_a).grad_a W_ab",
                             "Cullen & Dehnen (2010), appendix B: -d(div v)/dt; Price et al. (2018)"};
  using reads = Fields<m, rho, acc>;
  using adds = Fields<div_acc>;

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    return adds::row(b.m / b.rho * dot(b.acc - a.acc, ab.grad_w));
  }
};

}  // namespace undine::terms
