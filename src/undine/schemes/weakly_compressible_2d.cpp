#include "undine/schemes/weakly_compressible_impl.hpp"

namespace undine {

template class WeaklyCompressible<2>;

}  // namespace undine
