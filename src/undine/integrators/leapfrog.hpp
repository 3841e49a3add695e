#pragma once
#include "undine/core/catalogue.hpp"

namespace undine::integrators {

/// Density takes its rate at the middle of the step, where x and v are both known: second order, and reversible without
/// friction. Forces that depend on velocity see the predicted velocity of the new time.
struct Leapfrog {
  static constexpr Info info{
      "leapfrog", "Kick-drift-kick leapfrog; second order, one force evaluation a step",
      "v += acc dt/2; x += v dt/2; rho += drho(x, v) dt; x += v dt/2; acc(x, v + acc dt/2); v += acc dt/2",
      "Saalfeld (2012), eq. 20; Springel (2005), kick-drift-kick"};
  static constexpr int order = 2;

  template <class Flow>
  static void step(Flow& flow, double dt) {
    flow.book(dt / 2);
    flow.kick(dt / 2);
    flow.drift(dt / 2);
    flow.continuity();
    flow.compress(dt);
    flow.drift(dt / 2);
    flow.predict_kick(dt / 2);
    flow.evaluate();
    flow.correct_kick(dt / 2);
    flow.book(dt / 2);
    flow.smooth();
  }
};

}  // namespace undine::integrators
