#pragma once
#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"

namespace undine::terms {
using namespace field;

/// Pair `ab` with another gradient of the kernel, and without the 0.01 h^2 beside r^2: that is there for kernels whose
/// slope does not vanish at r = 0, and takes 1 to 2 % off a viscosity. What is left keeps 0/0 away.
constexpr auto with_gradient(const auto& ab, const auto& gradient) {
  auto other = ab;
  other.grad_w = gradient;
  other.inv_r_sq = 1.0 / (ab.r_sq + 1e-6 * sq(ab.h));
  return other;
}

/// A form whose sum becomes exact for linear fields by the target's own matrix. Not symmetric in the pair.
template <class Form>
struct Corrected {
  static constexpr Info info{"corrected", "A form with the kernel gradient corrected by the target's matrix",
                             "grad_a W_ab -> M_a^-1 grad_a W_ab, M_a = sum_b V_b (x_b - x_a) (x) grad_a W_ab",
                             "Randles & Libersky (1996); Bonet & Lok (1999)"};
  using reads = Union<typename Form::reads, Fields<moment>>;
  using adds = typename Form::adds;

  Form form{};

  FieldSet chosen_reads() const { return form.chosen_reads() | Fields<moment>::set(); }

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    return form(a, b, with_gradient(ab, times(a.moment, ab.grad_w)));
  }
};

/// A form with the mean of both matrices, which leaves a symmetric force symmetric. On a lattice, sheared or not, the
/// second moment of a Laplacian by F = r.grad W/r^2 is M itself, so that this makes a viscosity exact to second order.
template <class Form>
struct MeanCorrected {
  static constexpr Info info{"corrected", "A form with the kernel gradient corrected by the mean matrix of the pair",
                             "grad_a W_ab -> (M_a^-1 + M_b^-1)/2 grad_a W_ab",
                             "Randles & Libersky (1996); Bonet & Lok (1999)"};
  using reads = Union<typename Form::reads, Fields<moment>>;
  using adds = typename Form::adds;

  Form form{};

  FieldSet chosen_reads() const { return form.chosen_reads() | Fields<moment>::set(); }

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    return form(a, b, with_gradient(ab, 0.5 * (times(a.moment, ab.grad_w) + times(b.moment, ab.grad_w))));
  }
};

}  // namespace undine::terms
