#include "undine/approximation/moving_least_squares.hpp"

#include "undine/approximation/moving_fit.hpp"

namespace undine::approximation {

template <int N>
void MovingLeastSquares::weigh(const Neighbourhood<N>& around, int order, Stencil<N>& out) {
  moving_fit(
      around, order, [](std::size_t) { return 1.0; }, out);
}

template void MovingLeastSquares::weigh(const Neighbourhood<1>&, int, Stencil<1>&);
template void MovingLeastSquares::weigh(const Neighbourhood<2>&, int, Stencil<2>&);
template void MovingLeastSquares::weigh(const Neighbourhood<3>&, int, Stencil<3>&);

}  // namespace undine::approximation
