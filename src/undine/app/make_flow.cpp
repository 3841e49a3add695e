#include "undine/app/case_setup.hpp"
#include "undine/schemes/gas.hpp"
#include "undine/schemes/weakly_compressible.hpp"

namespace undine {

template <int N>
std::unique_ptr<Flow<N>> make_flow(Store<N> store, const Domain<N>& domain, const SchemeOptions<N>& options) {
  if (const auto* gas = std::get_if<GasOptions<N>>(&options))
    return std::make_unique<Gas<N>>(std::move(store), domain, *gas, unstarted);
  return std::make_unique<WeaklyCompressible<N>>(std::move(store), domain,
                                                 std::get<WeaklyCompressibleOptions<N>>(options), unstarted);
}

template std::unique_ptr<Flow<1>> make_flow<1>(Store<1>, const Domain<1>&, const SchemeOptions<1>&);
template std::unique_ptr<Flow<2>> make_flow<2>(Store<2>, const Domain<2>&, const SchemeOptions<2>&);
template std::unique_ptr<Flow<3>> make_flow<3>(Store<3>, const Domain<3>&, const SchemeOptions<3>&);

}  // namespace undine
