#pragma once
#include "undine/core/catalogue.hpp"
#include "undine/kernels/cubic_spline.hpp"
#include "undine/kernels/gaussian.hpp"
#include "undine/kernels/gaussian_corrected.hpp"
#include "undine/kernels/lucy.hpp"
#include "undine/kernels/poly6.hpp"
#include "undine/kernels/quadratic.hpp"
#include "undine/kernels/quartic.hpp"
#include "undine/kernels/quartic_spline.hpp"
#include "undine/kernels/quintic_spline.hpp"
#include "undine/kernels/spiky.hpp"
#include "undine/kernels/super_gaussian.hpp"
#include "undine/kernels/wendland_c2.hpp"
#include "undine/kernels/wendland_c4.hpp"
#include "undine/kernels/wendland_c6.hpp"

namespace undine {

/// Every smoothing kernel: one line each.
// clang-format off
using Kernels = Catalogue<
    CubicSpline,
    QuarticLiu,
    QuarticSpline,
    QuinticSpline,
    Gaussian,
    GaussianCorrected,
    SuperGaussian,
    Quadratic,
    Poly6,
    Spiky,
    Lucy,
    WendlandC2,
    WendlandC4,
    WendlandC6>;
// clang-format on

}  // namespace undine
