#include "undine/app/flow_of_case.hpp"

#include "undine/app/run/checkpoints.hpp"
#include "undine/integrators/catalogue.hpp"

namespace undine {

template <int N>
std::unique_ptr<Flow<N>> flow_of_case(CaseSetup<N>& setup, const OwnedCheckpoint* checkpoint) {
  auto flow =
      make_flow<N>(checkpoint ? store_from<N>(checkpoint->frame) : std::move(setup.store), setup.domain, setup.scheme);
  flow->set_potential_origin(setup.potential_origin);
  flow->step_control().tolerance = setup.choice.tolerance;
  if (checkpoint) flow->start(checkpoint->state.lists.at("memory"));
  return flow;
}

template <int N>
Step next_step(Flow<N>& flow, const SchemeChoice& choice) {
  const Step step = flow.stable_step(choice.limits);
  const auto& control = flow.step_control();
  if (control.adapts() && control.proposed > 0 && control.proposed < step.dt) return {control.proposed, "tolerance"};
  return step;
}

template <int N>
void take_step(Flow<N>& flow, const SchemeChoice& choice, double dt) {
  using integrators::Integrators;
  Integrators::visit(Integrators::index_of(choice.integrator), [&]<class I>(I) { I::step(flow, dt); });
}

template std::unique_ptr<Flow<1>> flow_of_case(CaseSetup<1>&, const OwnedCheckpoint*);
template std::unique_ptr<Flow<2>> flow_of_case(CaseSetup<2>&, const OwnedCheckpoint*);
template std::unique_ptr<Flow<3>> flow_of_case(CaseSetup<3>&, const OwnedCheckpoint*);
template Step next_step(Flow<1>&, const SchemeChoice&);
template Step next_step(Flow<2>&, const SchemeChoice&);
template Step next_step(Flow<3>&, const SchemeChoice&);
template void take_step(Flow<1>&, const SchemeChoice&, double);
template void take_step(Flow<2>&, const SchemeChoice&, double);
template void take_step(Flow<3>&, const SchemeChoice&, double);

}  // namespace undine
