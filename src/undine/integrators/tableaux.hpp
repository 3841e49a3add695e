#pragma once
#include <array>

#include "undine/core/catalogue.hpp"

namespace undine::integrators {

// Explicit Runge-Kutta schemes by their coefficients (Butcher's tableau): stage k is the state of the start plus
// dt sum_j a[k][j] slope_j, the new state the one of the start plus dt sum_k b[k] slope_k. In embedded pairs the rates
// of the new state are slope number `stages`, and `error` are the weights of the difference of both results.

struct Heun {
  static constexpr Info info{"runge_kutta_2", "Heun's Runge-Kutta; second order, two evaluations a step",
                             "x_1 = x + dt x'; x += dt/2 (x' + x_1')", "Shu & Osher (1988), eq. 2.16"};
  static constexpr int order = 2, stages = 2;
  static constexpr double a[stages][stages] = {{}, {1}};
  static constexpr double b[stages] = {1.0 / 2, 1.0 / 2};
};

struct ShuOsher {
  static constexpr Info info{
      "runge_kutta_3", "Shu and Osher's Runge-Kutta, kind to shocks; third order, three evaluations",
      "x_1 = x + dt x'; x_2 = x + dt/4 (x' + x_1'); x += dt/6 (x' + x_1' + 4 x_2')", "Shu & Osher (1988), eq. 2.18"};
  static constexpr int order = 3, stages = 3;
  static constexpr double a[stages][stages] = {{}, {1}, {1.0 / 4, 1.0 / 4}};
  static constexpr double b[stages] = {1.0 / 6, 1.0 / 6, 2.0 / 3};
};

struct Classical {
  static constexpr Info info{"runge_kutta_4", "The classical Runge-Kutta; fourth order, four evaluations a step",
                             "x_1 = x + dt/2 x'; x_2 = x + dt/2 x_1'; x_3 = x + dt x_2'; x += dt/6 (x' + 2 x_1' + 2 "
                             "x_2' + x_3')",
                             "Kutta (1901); Hairer, Norsett & Wanner (1993), table II.1.2"};
  static constexpr int order = 4, stages = 4;
  static constexpr double a[stages][stages] = {{}, {1.0 / 2}, {0, 1.0 / 2}, {0, 0, 1}};
  static constexpr double b[stages] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
};

struct BogackiShampine {
  static constexpr Info info{
      "bogacki_shampine", "Embedded Runge-Kutta 3(2) with steps by the error; three evaluations a step",
      "x += dt (2 x' + 3 x_1' + 4 x_2')/9, steps such that the difference to order 2 meets `tolerance`",
      "Bogacki & Shampine (1989)"};
  static constexpr int order = 3, stages = 3;
  static constexpr double a[stages][stages] = {{}, {1.0 / 2}, {0, 3.0 / 4}};
  static constexpr double b[stages] = {2.0 / 9, 1.0 / 3, 4.0 / 9};
  static constexpr double error[stages + 1] = {-5.0 / 72, 1.0 / 12, 1.0 / 9, -1.0 / 8};
};

struct DormandPrince {
  static constexpr Info info{"dormand_prince",
                             "Embedded Runge-Kutta 5(4) with steps by the error; six evaluations a step",
                             "the fifth-order result, steps such that the difference to order 4 meets `tolerance`",
                             "Dormand & Prince (1980); Hairer, Norsett & Wanner (1993), table II.5.2"};
  static constexpr int order = 5, stages = 6;
  static constexpr double a[stages][stages] = {
      {},
      {1.0 / 5},
      {3.0 / 40, 9.0 / 40},
      {44.0 / 45, -56.0 / 15, 32.0 / 9},
      {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
      {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656}};
  static constexpr double b[stages] = {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84};
  static constexpr double error[stages + 1] = {71.0 / 57600,      0,          -71.0 / 16695, 71.0 / 1920,
                                               -17253.0 / 339200, 22.0 / 525, -1.0 / 40};
};

}  // namespace undine::integrators
