#pragma once
#include "undine/core/catalogue.hpp"

namespace undine::integrators {

struct PredictorCorrector {
  static constexpr Info info{"predictor_corrector",
                             "Symplectic predictor-corrector; second order, two evaluations a step",
                             "to the middle with the old rates; then the whole step with the rates of the middle, x by "
                             "the mean of old and new v",
                             "Monaghan (1989), sec. 4; Dominguez et al. (2022), eq. 38-41"};
  static constexpr int order = 2;

  template <class Flow>
  static void step(Flow& flow, double dt) {
    flow.save();
    flow.drift(dt / 2);
    flow.kick(dt / 2);
    flow.compress(dt / 2);
    flow.evaluate();
    flow.restore();
    flow.book(dt);
    flow.kick(dt / 2);
    flow.drift(dt);
    flow.kick(dt / 2);
    flow.compress(dt);
    flow.evaluate();
    flow.smooth();
  }
};

}  // namespace undine::integrators
