#pragma once
#include "undine/approximation/corrected_gradient.hpp"
#include "undine/approximation/cspm.hpp"
#include "undine/approximation/finite_differences.hpp"
#include "undine/approximation/finite_point.hpp"
#include "undine/approximation/moving_least_squares.hpp"
#include "undine/approximation/point_interpolation.hpp"
#include "undine/approximation/radial_point_interpolation.hpp"
#include "undine/approximation/rkpm.hpp"
#include "undine/approximation/shepard.hpp"
#include "undine/approximation/sph.hpp"

namespace undine::approximation {

/// Every method of approximation: one line each.
// clang-format off
using Methods = Catalogue<
    Sph,
    Shepard,
    Rkpm,
    CorrectedGradient,
    Cspm,
    MovingLeastSquares,
    PointInterpolation,
    RadialPointInterpolation,
    FinitePoint,
    FiniteDifferences>;
// clang-format on

}  // namespace undine::approximation
