#pragma once
#include "undine/core/catalogue.hpp"

namespace undine::integrators {

// An integrator is a recipe over the moves of a flow. At entry and at exit the rates belong to the state:
//   drift(dt)    x += (v + XSPH) dt, walls and periods respected        kick(dt)    v += acc dt
//   compress(dt) rho += drho dt with the rates at hand                  continuity() drho from x and v as they are now
//   smooth()     v += XSPH, where a case wants that
//   evaluate()   all rates from the state                               book(dt)    adds the powers of the last
//   evaluation, times dt

struct Euler {
  static constexpr Info info{"euler", "Explicit Euler; first order, for comparison",
                             "x += v dt, v += acc dt, rho += drho dt, all from the old state",
                             "Saalfeld (2012), eq. 19"};
  static constexpr int order = 1;

  template <class Flow>
  static void step(Flow& flow, double dt) {
    flow.book(dt);
    flow.drift(dt);
    flow.kick(dt);
    flow.compress(dt);
    flow.evaluate();
    flow.smooth();
  }
};

}  // namespace undine::integrators
