#include "undine/approximation/corrected_gradient.hpp"

#include "undine/approximation/corrected.hpp"

namespace undine::approximation {

template <int N>
void CorrectedGradient::weigh(const Neighbourhood<N>& around, int, Stencil<N>& out) {
  corrected_gradient(around, out);
  out.value.assign(around.size(), 0);
  out.value[around.centre] = 1;
}

template void CorrectedGradient::weigh(const Neighbourhood<1>&, int, Stencil<1>&);
template void CorrectedGradient::weigh(const Neighbourhood<2>&, int, Stencil<2>&);
template void CorrectedGradient::weigh(const Neighbourhood<3>&, int, Stencil<3>&);

}  // namespace undine::approximation
