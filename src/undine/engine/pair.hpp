#pragma once
#include "undine/core/vec.hpp"
#include "undine/kernels/kernel.hpp"

namespace undine {

/// Which kernel a term uses; a case file may name a different one for each ([S] ch. 9, Mueller et al. 2003).
enum class KernelRole { density, pressure, viscosity };
inline constexpr int kernel_roles = 3;

/// What a term sees of the pair (a, b) itself.
template <int N, class V, class Mask>
struct Pair {
  static constexpr int dim = N;

  Vec<N, V> dx;      ///< x_a - x_b
  V r;               ///< |x_a - x_b|
  V r_sq;
  V support;         ///< support radius H of the pair
  V h;               ///< smoothing length h = H / kappa of the pair
  V w;               ///< W(r, H)
  Vec<N, V> grad_w;  ///< gradient of W with respect to x_a
  Mask inside;       ///< r < H; only maxima need it, sums vanish by themselves

  /// The Laplacian of W, evaluated where a term asks for it.
  V laplacian_w() const { return kernel->template laplacian<N>(r / support) * scale_laplacian(); }

  const KernelChoice* kernel;

 private:
  V scale_laplacian() const {
    V s = support * support;
    for (int k = 0; k < N; ++k) s = s * support;
    return V(1) / s;
  }
};

}  // namespace undine
