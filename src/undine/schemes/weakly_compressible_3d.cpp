#include "undine/schemes/weakly_compressible.ipp"

namespace undine {

template class WeaklyCompressible<3>;

}  // namespace undine
