#pragma once
#include <array>

#include "undine/core/catalogue.hpp"
#include "undine/core/parameter.hpp"

namespace undine::terms {

// A density that particles carry by continuity, summed anew now and then from what the neighbours carry:
//   rho_a <- sum_b m_b C_ab W_ab,  C_ab = c_a.p(x_b - x_a), such that polynomials up to `order` are reproduced.
// engine/reproducing_interpolation.hpp does it. Volumes are m_b/rho_b as carried: with those of the sum before,
// compression would never be seen, since any density that is uniform reproduces itself.

struct FilterShepard {
  static constexpr Info info{"shepard", "Density summed anew now and then, exact where it is uniform",
                             "rho_a <- sum_b m_b W_ab / sum_b (m_b/rho_b) W_ab, rho_b by continuity",
                             "Shepard (1968); Niedoba (2012), eq. 2.58"};
  static constexpr int order = 0;

  double every = 20;
  static constexpr auto parameters() {
    return std::array{
        Parameter<FilterShepard>{"every", &FilterShepard::every, "1", "steps from one sum to the next", 1, 1e6}};
  }
};

/// What is called MLS density elsewhere.
struct FilterRkpm {
  static constexpr Info info{"rkpm", "Density summed anew now and then by RKPM, exact where it is linear",
                             "rho_a <- sum_b m_b (c_0 + c.(x_b - x_a)) W_ab, c_0 and c by the moments of the kernel, "
                             "rho_b by continuity",
                             "Niedoba (2012), eq. 2.80-2.86; Dilts (1999); Colagrossi & Landrini (2003), eq. 20-22"};
  static constexpr int order = 1;

  double every = 20;
  static constexpr auto parameters() {
    return std::array{
        Parameter<FilterRkpm>{"every", &FilterRkpm::every, "1", "steps from one sum to the next", 1, 1e6}};
  }
};

using DensityFilters = Catalogue<FilterShepard, FilterRkpm>;

}  // namespace undine::terms
