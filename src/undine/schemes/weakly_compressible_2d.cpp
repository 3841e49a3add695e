#include "undine/schemes/weakly_compressible.ipp"

namespace undine {

template class WeaklyCompressible<2>;

}  // namespace undine
