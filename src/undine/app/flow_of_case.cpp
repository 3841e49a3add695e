#include "undine/app/flow_of_case.hpp"

#include "undine/app/checkpoints.hpp"
#include "undine/integrators/catalogue.hpp"
#include "undine/schemes/weakly_compressible.hpp"

namespace undine {

template <int N>
std::unique_ptr<Flow<N>> make_flow(CaseSetup<N>& setup, const OwnedCheckpoint* checkpoint) {
  std::unique_ptr<Flow<N>> flow;
  if (checkpoint) {
    flow = std::make_unique<WeaklyCompressible<N>>(store_from<N>(checkpoint->frame), setup.domain, setup.options,
                                                   checkpoint->state.lists.at("memory"));
  } else {
    flow = std::make_unique<WeaklyCompressible<N>>(std::move(setup.store), setup.domain, setup.options);
  }
  flow->set_potential_origin(setup.potential_origin);
  return flow;
}

template <int N>
void take_step(Flow<N>& flow, const SchemeChoice& choice, double dt) {
  using integrators::Integrators;
  Integrators::visit(Integrators::index_of(choice.integrator), [&]<class I>(I) { I::step(flow, dt); });
}

template std::unique_ptr<Flow<1>> make_flow(CaseSetup<1>&, const OwnedCheckpoint*);
template std::unique_ptr<Flow<2>> make_flow(CaseSetup<2>&, const OwnedCheckpoint*);
template std::unique_ptr<Flow<3>> make_flow(CaseSetup<3>&, const OwnedCheckpoint*);
template void take_step(Flow<1>&, const SchemeChoice&, double);
template void take_step(Flow<2>&, const SchemeChoice&, double);
template void take_step(Flow<3>&, const SchemeChoice&, double);

}  // namespace undine
