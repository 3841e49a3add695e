#pragma once
#include "undine/kernels/gaussian.hpp"

namespace undine {

/// The truncated Gaussian with alpha such that what is left has integral 1 exactly.
///   alpha = 3/(sqrt(pi) erf(3)),  9/(pi (1 - exp(-9))),  27/(pi^(3/2) (erf(3) - 6/sqrt(pi) exp(-9)))
struct GaussianCorrected : Gaussian {
  static constexpr Info info{"gaussian_corrected", "Gaussian, truncated at 3 h and normalised there",
                             "W = alpha exp(-9 R^2) for R < 1; alpha = 3/(sqrt(pi) erf(3) H), 9/(pi (1-exp(-9)) H^2), "
                             "27/(pi^(3/2) (erf(3) - 6/sqrt(pi) exp(-9)) H^3)",
                             "Niedoba (2012), eq. 2.43, normalised on its support"};
  static constexpr bool exactly_normalised = true;

  template <int N>
  static constexpr double alpha() {
    return Gaussian::alpha<N>() / (1 + Gaussian::norm_defect<N>());
  }
  template <int N>
  static constexpr double norm_defect() {
    return 0;
  }
};

}  // namespace undine
