#pragma once
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "undine/core/vec.hpp"

namespace undine::approximation {

template <int N>
using Matrix = Vec<N, Vec<N>>;

/// Whether a point could be approximated at. Where it could not, its numbers are NaN and its stencil is empty.
enum class Status {
  ok,
  no_neighbours,  ///< no point lies within the support
  too_few,        ///< fewer points than the method has unknowns
  degenerate,     ///< points enough, but on one line, plane or conic: the system is singular, or nearly so
};
inline constexpr std::string_view status_words[]{"ok", "no_neighbours", "too_few", "degenerate"};
constexpr std::string_view word(Status status) { return status_words[static_cast<int>(status)]; }

/// The degree up to which polynomials come out exactly, whatever the arrangement of points.
struct Degrees {
  static constexpr int none = -1;       ///< not even constants
  static constexpr int not_given = -2;  ///< the method does not have this
  int value = none, gradient = not_given, hessian = not_given;
};

/// What every method comes down to, as all of them are linear in the data: weights of the points, the shape functions
/// of Niedoba (2012), eq. 1.1, and their derivatives with respect to x.
///   u(x) = sum_j phi_j u_j,  grad u = sum_j grad phi_j u_j,  grad grad u = sum_j grad grad phi_j u_j
template <int N>
struct Stencil {
  Status status = Status::ok;
  double condition = 1;                    ///< of the system that was solved: rounding errors may grow by this factor
  std::vector<std::uint32_t> points = {};  ///< j, ascending
  std::vector<double> value = {};          ///< phi_j
  std::vector<Vec<N>> gradient = {};       ///< grad phi_j, 1/m; empty where not given
  std::vector<Matrix<N>> hessian = {};     ///< grad grad phi_j, 1/m^2; empty where not given
};

/// A field at a point. What is not given is NaN.
template <int N>
struct Estimate {
  double value = std::numeric_limits<double>::quiet_NaN();
  Vec<N> gradient{};
  Matrix<N> hessian{};

  Estimate() {
    for (int a = 0; a < N; ++a) {
      gradient[a] = value;
      for (int b = 0; b < N; ++b) hessian[a][b] = value;
    }
  }
  double laplacian() const {
    double trace = 0;
    for (int a = 0; a < N; ++a) trace += hessian[a][a];
    return trace;
  }
};

}  // namespace undine::approximation
