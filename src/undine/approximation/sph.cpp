#include "undine/approximation/sph.hpp"

namespace undine::approximation {

template <int N>
void Sph::weigh(const Neighbourhood<N>& around, int, Stencil<N>& out) {
  for (std::size_t j = 0; j < around.size(); ++j) {
    out.value.push_back(around.V[j] * around.W[j]);
    out.gradient.push_back(around.V[j] * around.dW[j]);
    if (!around.ddW.empty()) out.hessian.push_back(around.V[j] * around.ddW[j]);
  }
}

template void Sph::weigh(const Neighbourhood<1>&, int, Stencil<1>&);
template void Sph::weigh(const Neighbourhood<2>&, int, Stencil<2>&);
template void Sph::weigh(const Neighbourhood<3>&, int, Stencil<3>&);

}  // namespace undine::approximation
