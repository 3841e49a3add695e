#pragma once
#include "undine/core/vec.hpp"
#include "undine/kernels/kernel.hpp"

namespace undine {

/// Which kernel a term uses; a case file may name a different one for each ([S] ch. 9, Mueller et al. 2003).
enum class KernelRole { density, pressure, viscosity };
inline constexpr int kernel_roles = 3;

/// What is the same for every term of a pair (a, b).
template <int N, class V>
struct PairBase {
  static constexpr int dim = N;

  Vec<N, V> dx;  ///< x_a - x_b
  V r;           ///< |x_a - x_b|
  V r_sq;
  V support;                   ///< support radius H of the pair
  V h;                         ///< smoothing length h = H / kappa of the pair
  V inv_r_sq;                  ///< 1/(r^2 + 0.01 h^2), which is finite at r = 0; Monaghan (1992), eq. 4.2
  V inv_rho;                   ///< 1/rho_ab, rho_ab = (rho_a + rho_b)/2; only where a term of the sweep reads rho
  decltype(V() < V()) inside;  ///< r < H; only maxima need it, sums vanish by themselves
};

/// What a term sees of the pair: the above, and its own kernel.
template <int N, class V>
struct Pair : PairBase<N, V> {
  V w;               ///< W(r, H)
  Vec<N, V> grad_w;  ///< gradient of W with respect to x_a
  const KernelChoice* kernel;

  /// The Laplacian of W, evaluated where a term asks for it.
  constexpr V laplacian_w() const {
    V scale = sq(this->support);
    for (int k = 0; k < N; ++k) scale = scale * this->support;
    return laplacian_of(*kernel, this->r / this->support) / scale;
  }

 private:
  /// Not inlined: few terms ask for it, and every kernel stands in it.
  [[gnu::noinline]] static constexpr V laplacian_of(KernelChoice choice, V R) { return choice.laplacian<N>(R); }
};

/// A pair whose terms also see the gradients of W with the support of either particle.
template <int N, class V>
struct PairOfTwo : Pair<N, V> {
  Vec<N, V> grad_w_a, grad_w_b;
};

}  // namespace undine
