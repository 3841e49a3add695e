#pragma once
#include "undine/core/catalogue.hpp"
#include "undine/core/value.hpp"

namespace undine {

/// How the support radius of a pair follows from those of its particles. Monaghan (1992); Niedoba (2012), eq. 2.69.
/// `gradients`: the mean of the kernels of both supports instead, Hernquist & Katz (1989), eq. 2.18; where a sweep does
/// not know both, the arithmetic mean of the supports.
enum class Symmetrisation { arithmetic, geometric, max, min, gradients };

/// The support radius H of a run: one number, or a value per particle with a rule for pairs.
struct Support {
  double uniform = 0;  ///< H where it is the same everywhere; the largest H otherwise
  double kappa = 2;    ///< H = kappa h
  bool per_particle = false;
  Symmetrisation mean = Symmetrisation::arithmetic;
};

/// H_ab from H_a and H_b.
template <class V, class A>
V pair_support(Symmetrisation mean, const A& h_a, const V& h_b) {
  switch (mean) {
    case Symmetrisation::geometric:
      return sqrt(V(h_a) * h_b);
    case Symmetrisation::max:
      return max(V(h_a), h_b);
    case Symmetrisation::min:
      return min(V(h_a), h_b);
    case Symmetrisation::arithmetic:
    case Symmetrisation::gradients:
      break;
  }
  return V(0.5) * (V(h_a) + h_b);
}

}  // namespace undine
