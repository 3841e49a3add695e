#include "unit/engine/every_term.hpp"

// The pair loops of every term, compiled once for all tests.

namespace undine {

template void test::EveryTerm<1>::run(const SweepContext<1>&, const Backend&);
template void test::EveryTerm<2>::run(const SweepContext<2>&, const Backend&);
template void test::EveryTerm<3>::run(const SweepContext<3>&, const Backend&);

}  // namespace undine
