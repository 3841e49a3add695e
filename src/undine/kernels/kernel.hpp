#pragma once
#include "undine/kernels/catalogue.hpp"

namespace undine {

/// What one kernel K gives in N dimensions, with its norm, as pure functions of R = r/H (H = support radius, metres).
/// All are free of units; a pair at distance r has, with rij = x_i - x_j,
///   W = w/H^N,  grad_i W = slope_over_R rij / H^(N+2),  laplacian W = laplacian/H^(N+2)
/// and all are exactly zero for R >= 1.
template <class K>
struct NormedKernel {
  using Shape = K;

  /// W H^N.
  template <int N, class V>
  static constexpr V w(const V& R) {
    return V(K::template alpha<N>()) * K::template shape<N>(R);
  }
  /// dW/dr H^(N+1).
  template <int N, class V>
  static constexpr V slope(const V& R) {
    return V(K::template alpha<N>()) * K::template slope<N>(R);
  }
  /// (dW/dr)/r H^(N+2), finite at R = 0.
  template <int N, class V>
  static constexpr V slope_over_R(const V& R) {
    return V(K::template alpha<N>()) * K::template slope_over_R<N>(R);
  }
  /// d^2W/dr^2 H^(N+2).
  template <int N, class V>
  static constexpr V curvature(const V& R) {
    return V(K::template alpha<N>()) * K::template curvature<N>(R);
  }
  /// (d^2W/dr^2 + (N-1)/r dW/dr) H^(N+2): the true Laplacian. Kernels with a kink at R = 0 (spiky, quadratic) have -1/R
  /// there.
  template <int N, class V>
  static constexpr V laplacian(const V& R) {
    if constexpr (N == 1)
      return curvature<N>(R);
    else
      return V(K::template alpha<N>()) * (K::template curvature<N>(R) + V(N - 1) * K::template slope_over_R<N>(R));
  }
};

/// A kernel chosen at run time, by its index in `Kernels`; the functions are those of NormedKernel. The choice is made
/// again in every call: a loop over many pairs makes it once, outside, by `visit`.
class KernelChoice {
 public:
  constexpr KernelChoice() = default;
  constexpr explicit KernelChoice(int index) : index_(index) {}

  /// The choice of a kernel type.
  template <class K>
  static constexpr KernelChoice of() {
    return KernelChoice(Kernels::index<K>());
  }

  constexpr int index() const { return index_; }
  constexpr Info info() const { return Kernels::info(index_); }
  /// kappa in H = kappa h, where the case does not say.
  constexpr double natural_kappa() const {
    return Kernels::visit(index_, []<class K>(K) { return K::natural_kappa; });
  }
  constexpr int smoothness() const {
    return Kernels::visit(index_, []<class K>(K) { return K::smoothness; });
  }

  /// Calls f(NormedKernel<K>{}) for the chosen kernel K.
  template <class F>
  constexpr decltype(auto) visit(F&& f) const {
    return Kernels::visit(index_, [&f]<class K>(K) -> decltype(auto) { return f(NormedKernel<K>{}); });
  }

  template <int N, class V>
  constexpr V w(const V& R) const {
    return visit([&R](auto kernel) { return kernel.template w<N>(R); });
  }
  template <int N, class V>
  constexpr V slope(const V& R) const {
    return visit([&R](auto kernel) { return kernel.template slope<N>(R); });
  }
  template <int N, class V>
  constexpr V slope_over_R(const V& R) const {
    return visit([&R](auto kernel) { return kernel.template slope_over_R<N>(R); });
  }
  template <int N, class V>
  constexpr V curvature(const V& R) const {
    return visit([&R](auto kernel) { return kernel.template curvature<N>(R); });
  }
  template <int N, class V>
  constexpr V laplacian(const V& R) const {
    return visit([&R](auto kernel) { return kernel.template laplacian<N>(R); });
  }

  friend constexpr bool operator==(KernelChoice, KernelChoice) = default;

 private:
  int index_ = Kernels::index<WendlandC2>();
};

}  // namespace undine
