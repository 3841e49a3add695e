#include "undine/schemes/gas_impl.hpp"

namespace undine {

template class Gas<2>;

}  // namespace undine
