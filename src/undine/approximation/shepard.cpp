#include "undine/approximation/shepard.hpp"

#include <cmath>

namespace undine::approximation {

template <int N>
void Shepard::weigh(const Neighbourhood<N>& around, int, Stencil<N>& out) {
  const auto& [s, V, W, dW, ddW, centre] = around;
  double S = 0, size = 0;
  Vec<N> dS{};
  Matrix<N> ddS{};
  for (std::size_t j = 0; j < around.size(); ++j) {
    S += V[j] * W[j];
    size += std::abs(V[j] * W[j]);
    dS += V[j] * dW[j];
    if (!ddW.empty()) ddS += V[j] * ddW[j];
  }
  out.condition = size / std::abs(S);  // above 1 only where the kernel is negative in places
  for (std::size_t j = 0; j < around.size(); ++j) {
    const double phi = V[j] * W[j] / S;
    const Vec<N> dphi = (V[j] * dW[j] - phi * dS) / S;
    out.value.push_back(phi);
    out.gradient.push_back(dphi);
    if (!ddW.empty()) out.hessian.push_back((V[j] * ddW[j] - outer(dphi, dS) - outer(dS, dphi) - phi * ddS) / S);
  }
}

template void Shepard::weigh(const Neighbourhood<1>&, int, Stencil<1>&);
template void Shepard::weigh(const Neighbourhood<2>&, int, Stencil<2>&);
template void Shepard::weigh(const Neighbourhood<3>&, int, Stencil<3>&);

}  // namespace undine::approximation
