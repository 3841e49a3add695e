#include "undine/schemes/gas_impl.hpp"

namespace undine {

template class Gas<1>;

}  // namespace undine
